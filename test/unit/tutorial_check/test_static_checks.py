"""Checks that only read files: right ones are not blamed, each mistake in them is found."""

import shutil
from pathlib import Path
from types import SimpleNamespace

import edits
import mistakes_nodes
import mistakes_packages
import pytest

from tutorial_check.course import checks_of, read_course
from tutorial_check.exercises.joystick_task import JoystickTask
from tutorial_check.model import NOTE, OK, WRONG, Run
from tutorial_check.report import lines_of
from tutorial_check.session import Session
from tutorial_check.workspace import find_layout

LITERAL = Path(__file__).resolve().parents[2] / "exercises" / "literal"
READ_ALONE = ("C2", "C3", "C5", "C12", "C13", "C29")
CHECKS = checks_of(read_course())
STARTS_SOMETHING = ("a dependency that there is not", "load_manifest of another name")
ROWS = [
    row
    for row in mistakes_packages.ROWS + mistakes_nodes.ROWS
    if row[3] in READ_ALONE and row[1] not in STARTS_SOMETHING
]


@pytest.fixture
def judge(tmp_path):
    """judge(checks, edits): the results of these checks of the right solution, once changed."""

    def judged(checks, changes=()):
        source = shutil.copytree(LITERAL, tmp_path / "ws" / "src")
        edits.apply(changes, source)
        session = Session(
            tmp_path,
            find_layout(tmp_path / "ws"),
            ["2", "3", "4.3", "6.2"],
            SimpleNamespace(environment={}),
            underlay="",
            can_have_devices=False,
            task=JoystickTask({}),
        )
        run = Run(CHECKS, session, lambda _: False, lambda: False)
        return [run.result(each) for each in checks]

    return judged


def test_a_right_solution_is_not_blamed(judge):
    assert {one.status for one in judge(READ_ALONE)} == {OK, NOTE}


@pytest.mark.parametrize("row", ROWS, ids=[f"{row[3]} {row[1]}" for row in ROWS])
def test_a_mistake_in_a_file_is_found(judge, row):
    _, _, changes, check, words = row
    (one,) = judge([check], changes)
    report = "\n".join(lines_of(one)).lower()
    words = [words] if isinstance(words, str) else words
    assert one.status == WRONG and all(word.lower() in report for word in words), report
