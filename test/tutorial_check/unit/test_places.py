"""A recording names folders by words, never by paths of a machine."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Dict, Tuple

import pytest

from tutorial_check.checking.submission import Submission
from tutorial_check.course.tasks import Task
from tutorial_check.recording.worker import reply_to
from tutorial_check.submission.order import Question, Reply
from tutorial_check.submission.places import Places
from tutorial_testing.claims import claim

HERE = Places({"submission": Path("/tmp/a/ws"), "scratch": Path("/tmp/a"), "all": Path("/")})
THERE = Places({"submission": Path("/var/b/handed_in"), "scratch": Path("/var/b")})


@dataclass(frozen=True)
class Printed:
    text: str = ""
    files: Tuple[Path, ...] = ()
    by_file: Dict[str, int] = field(default_factory=dict)


@pytest.mark.parametrize(("here", "word", "there"), [
    ("see /tmp/a/ws/src/x.py", "see {submission}/src/x.py", "see /var/b/handed_in/src/x.py"),
    ("in /tmp/a/ws.", "in {submission}.", "in /var/b/handed_in."),
    ("/tmp/a/wsx:/tmp/a/home", "{scratch}/wsx:{scratch}/home", "/var/b/wsx:/var/b/home"),
    ("/tmp/ab/ws, /usr", "/tmp/ab/ws, /usr", "/tmp/ab/ws, /usr"),
    ("{x} {submission", "{x} {submission", "{x} {submission"),
])  # fmt: skip
def test_a_folder_has_a_word_and_is_another_folder_elsewhere(here, word, there):
    made = Printed(here, (Path(here),), {here: 1})
    assert HERE.named(made) == Printed(word, (Path(word),), {word: 1})
    assert THERE.whole(HERE.named(made)) == Printed(there, (Path(there),), {there: 1})


def test_without_folders_nothing_is_replaced():
    assert Places({}).named("/tmp") == Places({}).whole("/tmp") == "/tmp"


def record(workspace) -> Printed:
    """Note what a program prints."""
    return Printed(f"{workspace.source}/a and /usr")


@claim(
    "A recording names no path of a machine: folders have words, and are another machine's folders "
    "there"
)
def test_a_worker_sends_no_path_of_its_machine_and_a_submission_has_its_own(
    make_submission, order, tmp_path
):
    workspace = make_submission("joy2twist", "4.3")
    workspace.runner.clock = Clock
    sent = workspace.places.named(reply_to(Question(f"{__name__}:record"), workspace))
    assert sent == Reply(Printed("{submission}/src/a and /usr"))
    submission = Submission(order, Task({}), lambda _: Reply({**vars(sent.recording)}))
    assert submission.recording(record).text.startswith(f"{tmp_path}/handed_in/src/a ")
    assert "{submission}" in submission.exchanges[0]["recording"]["text"]


def of_a_program(workspace) -> Printed:
    """Record an object that is not data."""
    return Printed(object())


def test_a_recording_of_what_is_no_data_is_one_line_that_names_the_recorder(make_submission):
    workspace = make_submission("joy2twist", "4.3")
    workspace.runner.clock = Clock
    cannot = reply_to(Question(f"{__name__}:of_a_program"), workspace).cannot
    assert cannot.startswith("test_places.py: of_a_program() records what is no text")
    assert cannot.endswith("; of a program record .ran") and "\n" not in cannot


class Clock:
    """The clock of a quiet machine."""

    busy = overloaded = staticmethod(lambda: False)
