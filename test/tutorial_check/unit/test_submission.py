"""When a submission records again, what it reads, and where it cannot start programs."""

import itertools
import os
from dataclasses import dataclass, replace
from pathlib import Path
from types import SimpleNamespace
from typing import Tuple

import pytest

from tutorial_check.checking.results import Wrong
from tutorial_check.checking.submission import Submission
from tutorial_check.course.tasks import Task
from tutorial_check.errors import CannotCheck, CutShort
from tutorial_check.recording.launcher import must_start_programs
from tutorial_check.submission.order import Question, Reply, Sandbox
from tutorial_testing.claims import claim


def test_a_folder_in_which_nothing_can_be_started_is_named(order, monkeypatch):
    must_start_programs(order, is_other=False)
    monkeypatch.setattr(os, "statvfs", lambda path: SimpleNamespace(f_flag=os.ST_NOEXEC))
    with pytest.raises(CannotCheck, match=rf"{order.folder.parent} is mounted noexec: set TMPDIR"):
        must_start_programs(order, is_other=False)


@dataclass(frozen=True)
class Seen:
    number: int


def look(workspace) -> Seen:
    """A recorder, whose worker the test below imitates."""


@dataclass(frozen=True)
class Way:
    places: list


@dataclass(frozen=True)
class Drive:
    bumps: int
    ways: Tuple[Way, ...]


def drive(workspace) -> Drive:
    """A recorder that is never called."""


def test_a_recording_that_cannot_be_read_again_is_refused_before_it_is_made(order):
    with pytest.raises(CannotCheck) as error:
        Submission(order, Task({}), ask=None).recording(drive)
    why = "Way.places: its type must name its items, such as Tuple[float, ...]"
    assert str(error.value) == why


@pytest.mark.parametrize(("busy", "overloaded"), [(False, False), (True, False), (True, True)])
def test_what_was_recorded_is_recorded_once_until_it_is_forgotten(order, busy, overloaded):
    count = itertools.count()

    def ask(question):
        assert question == Question(f"{__name__}:look")
        return Reply({"number": next(count)}, busy=busy, overloaded=overloaded)

    submission = Submission(order, Task({}), ask)
    assert [submission.recording(look).number, submission.recording(look).number] == [0, 0]
    assert (submission.busy(), submission.overloaded()) == (busy, overloaded)
    submission.forget_recordings()
    assert submission.recording(look).number == 1


@claim("What leaves the isolation is a recording, and another answer is no verdict")
@pytest.mark.parametrize(("reply", "error", "words"), [
    (Reply(cannot="no room"), CannotCheck, "no room"),
    (Reply(cut_short=CutShort("master gone")), Wrong, "it no longer answers"),
    (Reply({"forged": 1}), ValueError, "no Seen"),
])  # fmt: skip
def test_a_reply_that_is_no_recording(order, reply, error, words):
    one = Submission(order, Task({}), lambda _: reply)
    with pytest.raises(error) as caught:
        one.recording(look)
    assert words in getattr(caught.value, "seen", str(caught.value))


@pytest.mark.parametrize(("path", "is_own", "may_see"), [
    ("{folder}/handed_in/src/a.launch", True, True),
    ("{folder}/handed_in/src/../../../secret", False, False),
    ("{folder}/handed_in/src/link", False, False),
    ("{folder}/shown/a", False, True),
    ("{folder}/other/a", False, False),
    ("/usr/share/a", False, True),
    ("/root/secret", False, False),
])  # fmt: skip
def test_a_path_in_a_recording_is_looked_at_only_where_programs_may(order, path, is_own, may_see):
    source = Path(order.folder) / "handed_in/src"
    source.mkdir(parents=True)
    (source / "link").symlink_to("/root/secret")
    one = Submission(
        replace(order, sandbox=Sandbox(readable=(f"{order.folder}/shown",))), Task({}), None
    )
    whole = path.format(folder=order.folder)
    assert (one.is_own(whole), one.may_see(whole)) == (is_own, may_see)


def test_a_traceback_that_names_a_file_elsewhere_opens_none(order):
    source = Path(order.folder) / "handed_in/src/joy2twist"
    source.mkdir(parents=True)
    (source / "package.xml").write_text("<package><name>joy2twist</name></package>")
    (Path(order.folder) / "secret.py").write_text("x = 1")
    one = Submission(order, Task({}), None)
    with pytest.raises(CannotCheck, match="leads elsewhere"):
        one.text("joy2twist", "../../../secret.py")
