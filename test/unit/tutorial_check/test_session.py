"""When a session of checks looks again, and where it can start nothing."""

import itertools
import os
from types import SimpleNamespace

import pytest

from tutorial_check.model import CannotCheck


def test_a_folder_in_which_nothing_can_be_started_is_named(make_session, monkeypatch):
    one = make_session("a", "2")
    one.must_start_programs()
    monkeypatch.setattr(os, "statvfs", lambda path: SimpleNamespace(f_flag=os.ST_NOEXEC))
    with pytest.raises(CannotCheck, match=rf"in {one.folder.parent} \(noexec\): set TMPDIR"):
        one.must_start_programs()


@pytest.mark.parametrize(
    ("strained", "explained", "is_worth_it"),
    [(False, True, False), (False, False, True), (True, True, True), (True, False, True)],
)
def test_a_second_look_at_what_was_busy_or_unexplained(
    make_session, strained, explained, is_worth_it
):
    """It forgets what was seen, and nothing of what is."""
    one, count = make_session("a", "2"), itertools.count()

    def look(ground):
        return next(count)

    one.runner = SimpleNamespace(clock=SimpleNamespace(strained=lambda: strained))
    assert [one.recording(look), one.memo("k", lambda: next(count))] == [0, 1]
    assert one.second_look(explained) == is_worth_it
    again = [one.recording(look), one.memo("k", lambda: next(count))]
    assert again == [2 if is_worth_it else 0, 1]
