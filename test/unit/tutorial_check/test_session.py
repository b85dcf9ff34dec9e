"""A student's setup.bash runs, and is waited for, as a program of the student's; a second look."""

import itertools
import os
import tempfile
from pathlib import Path
from types import SimpleNamespace

import pytest

from tutorial_check import session
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
