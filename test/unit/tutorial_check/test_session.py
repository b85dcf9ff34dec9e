"""A student's setup.bash and first program run as the student's; a second look; planted links."""

import contextlib
import itertools
import os
import re
import tempfile
from pathlib import Path
from types import SimpleNamespace

import pytest

from tutorial_check import environment, place, session
from tutorial_check.box import Box
from tutorial_check.model import CannotCheck

as_root = pytest.mark.skipif(os.geteuid() != 0, reason="only root can run programs as another user")


@pytest.fixture
def one(stranger):
    """A Session whose programs run under another uid."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder).chmod(0o755)
        environment.prepare(folder, stranger)
        box = Box(environment.variables(Path(folder), {"PATH": "/usr/bin:/bin"}), stranger)
        made = session.Session(folder, None, [], box, underlay="", can_have_devices=False)
        yield made
        made.box.clear()


@pytest.fixture
def sourced(one):
    """sourced(text): the variables after a setup.bash with this text."""

    def source(text):
        (one.folder / "setup.bash").write_text(text)
        return one._sourced(one.folder / "setup.bash")

    return source


def test_it_is_sourced_by_the_user_that_runs_the_programs(sourced, stranger):
    """What it leaves in the background is not waited for."""
    found = sourced(
        "sleep 3600 & echo hello; echo a=b >&2; export USED=$(id -u) TWO_LINES=$'1\n2'\n"
    )
    assert found["USED"] == str(stranger or os.geteuid())
    assert found["TWO_LINES"] == "1\n2"
    assert "hello" not in "".join(found) and "a" not in found


@pytest.mark.parametrize("end", ["exit 3", "exit", "false"])
def test_one_that_cannot_be_sourced_is_reported(sourced, end):
    with pytest.raises(CannotCheck, match=r"cannot be sourced: no such thing: moon$"):
        sourced(f"printf 'no such thing:\\nmoon\\n' >&2; {end}\n")


@as_root
@pytest.mark.parametrize(
    ("needed", "how"), [("closed/suite", r"o\+x"), ("closed", r"-R o\+rX"), ("open", "")]
)
def test_a_folder_that_is_closed_to_the_programs_is_named(one, stranger, needed, how):
    (one.folder / "open").mkdir()
    (one.folder / "closed").mkdir(0o700)
    (one.folder / "closed" / "suite").mkdir()
    one._needed = [one.folder / needed]
    closed = one.folder / "closed"
    place.touch_files_as(stranger, stranger)
    try:
        with pytest.raises(CannotCheck) if how else contextlib.nullcontext() as refused:
            one.must_reach_underlay()
    finally:
        place.restore_rights()
    assert not how or re.match(f"{closed} is closed .*: chmod {how} {closed},", str(refused.value))


def test_a_folder_in_which_nothing_can_be_started_is_named(one, monkeypatch):
    one.must_start_programs()
    monkeypatch.setattr(os, "statvfs", lambda path: SimpleNamespace(f_flag=os.ST_NOEXEC))
    with pytest.raises(CannotCheck, match=rf"in {one.folder.parent} \(noexec\): set TMPDIR"):
        one.must_start_programs()


@pytest.mark.parametrize(
    ("strained", "explained", "is_worth_it"),
    [(False, True, False), (False, False, True), (True, True, True), (True, False, True)],
)
def test_a_second_look(make_session, strained, explained, is_worth_it):
    """It forgets what was seen, and nothing of what is."""
    one, count = make_session("a", "2"), itertools.count()
    one.box = SimpleNamespace(patience=SimpleNamespace(strained=lambda: strained))
    assert [one.run("k", lambda: next(count)), one.memo("k", lambda: next(count))] == [0, 1]
    assert one.second_look(explained) == is_worth_it
    again = [one.run("k", lambda: next(count)), one.memo("k", lambda: next(count))]
    assert again == [2 if is_worth_it else 0, 1]


@pytest.mark.parametrize("planted", ["scripts/talker.py", "scripts", "a pipe"])
def test_a_planted_link_or_pipe_is_not_read(make_session, tmp_path, planted):
    one = make_session("a", "2")
    (tmp_path / "outside").mkdir()
    (tmp_path / "outside" / "talker.py").write_text("secret")
    folder = one.package("a").folder
    if planted == "scripts":
        (folder / "scripts").symlink_to(tmp_path / "outside")
    else:
        (folder / "scripts").mkdir()
        file = folder / "scripts/talker.py"
        os.mkfifo(file) if "pipe" in planted else file.symlink_to(tmp_path / "outside/talker.py")
    with pytest.raises(CannotCheck, match="is not as it was: a program changed it"):
        one.text("a", "scripts/talker.py")
