"""A student's setup.bash runs, and is waited for, as a program of the student's; a second look."""

import itertools
import os
import tempfile
from pathlib import Path
from types import SimpleNamespace

import pytest

from tutorial_check import place, session
from tutorial_check.box import Box
from tutorial_check.model import CannotCheck


@pytest.fixture
def sourced(stranger):
    """sourced(text): what variables there are after a setup.bash with this text."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder).chmod(0o755)
        session.prepare(folder, stranger)
        one = session.Session(
            folder,
            None,
            [],
            {"PATH": "/usr/bin:/bin"},
            floor=None,
            make_box=lambda environment: Box(environment, stranger),
            can_have_devices=False,
        )

        def source(text):
            setup = Path(folder) / "setup.bash"
            setup.write_text(text)
            return one._sourced(setup)

        yield source
        one.box.clear()


def test_who_sources_it_is_who_runs_the_programs(sourced, stranger):
    found = sourced("echo hello; echo a=b >&2; export WHO=$(id -u) TWO_LINES=$'1\n2'\n")
    assert found["WHO"] == str(stranger or os.geteuid())
    assert found["TWO_LINES"] == "1\n2"
    assert "hello" not in "".join(found) and "a" not in found


def test_what_it_leaves_in_the_background_is_not_waited_for(sourced):
    assert sourced("sleep 3600 & export THERE=yes\n")["THERE"] == "yes"


@pytest.mark.parametrize("end", ["exit 3", "exit", "false"])
def test_it_is_told_if_it_cannot_be_sourced(sourced, end):
    with pytest.raises(CannotCheck, match=r"cannot be sourced: no such thing: moon$"):
        sourced(f"printf 'no such thing:\\nmoon\\n' >&2; {end}\n")


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


def test_a_planted_link_is_not_written_through(make_session, tmp_path):
    one = make_session("a", "2")
    other = tmp_path / "other"
    other.write_text("kept")
    folder = one.package("a").folder
    (folder / "checked_1_talker.py").symlink_to(other)
    assert one.sibling("a", "talker.py", "changed") == "checked_1_talker.py"
    assert other.read_text() == "kept"
    assert (folder / "checked_1_talker.py").read_text() == "changed"
    assert not (folder / "checked_1_talker.py").is_symlink()


@pytest.mark.parametrize("planted", ["scripts/talker.py", "scripts"])
def test_a_planted_link_is_not_read_through(make_session, tmp_path, planted):
    one = make_session("a", "2")
    (tmp_path / "outside").mkdir()
    (tmp_path / "outside" / "talker.py").write_text("secret")
    link = one.package("a").folder / planted
    link.parent.mkdir(exist_ok=True)
    link.symlink_to(tmp_path / "outside" / ("talker.py" if planted.endswith(".py") else ""))
    with pytest.raises(CannotCheck, match="is not as it was: a program changed it"):
        one.text("a", "scripts/talker.py")
    with pytest.raises(CannotCheck, match="is not as it was"):
        one.sibling("a", "scripts/talker.py", "x") if planted == "scripts" else one.text(
            "a", "scripts/talker.py"
        )


def test_a_pipe_in_place_of_a_script_is_not_waited_for(make_session):
    one = make_session("a", "2")
    os.mkfifo(one.package("a").folder / "talker.py")
    with pytest.raises(CannotCheck, match="no regular file"):
        one.text("a", "talker.py")


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can read as another user")
def test_root_opens_files_with_the_rights_of_the_programs_user(tmp_path, stranger):
    secret = tmp_path / "secret"
    secret.write_text("x")
    secret.chmod(0o600)
    place.touch_files_as(stranger, stranger)
    try:
        with pytest.raises(PermissionError):
            secret.read_text()
        with place.own_rights():
            assert secret.read_text() == "x"
        with pytest.raises(PermissionError):
            secret.read_text()
    finally:
        place.touch_files_as(os.geteuid(), os.getegid())
    assert secret.read_text() == "x"
