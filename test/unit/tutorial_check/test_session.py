"""A student's setup.bash and first program run as the student's; a second look; planted links."""

import itertools
import os
import re
import tempfile
from pathlib import Path
from types import SimpleNamespace

import pytest

from tutorial_check import environment, session
from tutorial_check.box import Box
from tutorial_check.model import CannotCheck

as_root = pytest.mark.skipif(os.geteuid() != 0, reason="only root can run programs as another user")


@pytest.fixture
def one(stranger):
    """A Session whose programs run under another uid."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder).chmod(0o755)
        environment.prepare(folder, stranger)
        made = session.Session(
            folder,
            None,
            [],
            {"PATH": "/usr/bin:/bin"},
            underlay=None,
            make_box=lambda variables: Box(variables, stranger),
            can_have_devices=False,
        )
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
def test_a_folder_that_is_closed_to_the_programs_is_named(one, needed, how):
    (one.folder / "open").mkdir()
    (one.folder / "closed").mkdir(0o700)
    (one.folder / "closed" / "suite").mkdir()
    if not how:
        one.must_start_programs([one.folder / needed])
        return
    closed = one.folder / "closed"
    with pytest.raises(CannotCheck, match=rf"^{closed} is .*: chmod {how} {closed},"):
        one.must_start_programs([one.folder / needed])


def test_a_folder_in_which_nothing_can_be_started_is_named(one, monkeypatch):
    """As one that is mounted noexec."""
    monkeypatch.setattr(session, "TRIAL", "#!/nowhere\n")
    why = f"no program can be started in {one.folder.parent} (No such file or directory): set"
    with pytest.raises(CannotCheck, match=re.escape(why)):
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


def test_a_planted_link_is_not_written_through(make_session, tmp_path):
    one = make_session("a", "2")
    (tmp_path / "other").write_text("kept")
    planted = one.package("a").folder / "checked_1_talker.py"
    planted.symlink_to(tmp_path / "other")
    assert one.sibling("a", "talker.py", "changed") == "checked_1_talker.py"
    assert (tmp_path / "other").read_text() == "kept"
    assert planted.read_text() == "changed" and not planted.is_symlink()


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


def test_a_pipe_in_place_of_a_script_is_not_waited_for(make_session):
    one = make_session("a", "2")
    os.mkfifo(one.package("a").folder / "talker.py")
    with pytest.raises(CannotCheck, match="no regular file"):
        one.text("a", "talker.py")
