"""Graded hints: the first failure says what is wrong, a repeated one how to fix it."""

import json

import pytest

from tutorial_check.checking.results import NOTE, OK, WRONG, Outcome, Result
from tutorial_check.course.definition import read_course
from tutorial_check.errors import CannotCheck
from tutorial_check.report.memory import AGAIN, ALWAYS, LATER, NEVER, Memory, show_solution
from tutorial_testing.claims import claim

WRONG_SIGN = Result("C16", WRONG, "axes", seen="angular.z = -1.00 * axes[0]", hint="no minus")
WRONG_AXIS = Result("C16", WRONG, "axes", seen="axis 2 drives", hint="axes[1]")
A_NOTE = Result("C2", NOTE, "a package", seen="odd", hint="rename it")


@pytest.fixture
def memory(tmp_path):
    """memory(level, workspace): the memory of a new run of the checker."""

    def make(level=AGAIN, workspace="ws"):
        (tmp_path / workspace).mkdir(exist_ok=True)
        path = str(tmp_path / workspace)
        return Memory(path, read_course(), level, tmp_path / "cache" / "checked.json")

    return make


def test_the_same_failure_again_shows_how_to_mend_it(memory):
    first = memory()
    assert first.hint_of(WRONG_SIGN) == LATER
    first.keep([Outcome("4.3", [WRONG_SIGN])])
    assert memory().hint_of(WRONG_SIGN) == "no minus"
    again = Result(**{**vars(WRONG_SIGN), "seen": "angular.z = -0.98 * axes[0]"})
    assert memory().hint_of(again) == "no minus"  # another measured number is the same failure
    assert memory().hint_of(WRONG_AXIS) == LATER
    assert memory(workspace="other").hint_of(WRONG_SIGN) == LATER
    # Checking another exercise meanwhile does not reset it; a success does.
    memory().keep([Outcome("2", [Result("C1", OK, "one")], done=True)])
    assert memory().hint_of(WRONG_SIGN) == "no minus"
    memory().keep([Outcome("4.3", [Result("C16", OK, "axes")], done=True)])
    assert memory().hint_of(WRONG_SIGN) == LATER


def test_a_level_a_note_or_an_eager_check_shows_hints_or_none(memory):
    assert [memory(level).hint_of(WRONG_SIGN) for level in (NEVER, ALWAYS)] == ["", "no minus"]
    assert memory().hint_of(A_NOTE) == "rename it"
    assert memory().hint_of(Result("C1", WRONG, "one")) == ""
    assert memory().hint_of(Result("C1", WRONG, "one", hint="cd", eager=True)) == "cd"


@pytest.mark.parametrize("text", ["", "[]", "{", '{"/ws": 3}', '{"/ws First": {"wrong": []}}'])
def test_a_memory_that_cannot_be_read_is_empty(memory, tmp_path, text):
    (tmp_path / "cache").mkdir()
    (tmp_path / "cache/checked.json").write_text(text)
    memory().keep([Outcome("4.3", [WRONG_SIGN])])
    assert memory().hint_of(WRONG_SIGN) == "no minus"
    assert isinstance(json.loads((tmp_path / "cache/checked.json").read_text()), dict)


@claim("A solution is shown only when its exercise is done, and is a file of the course")
def test_a_solution_is_shown_when_its_exercise_is_done(memory, capsys):
    course = read_course()
    with pytest.raises(CannotCheck, match=r"4\.3 is not done yet"):
        show_solution(course, ["4.3"], memory())
    memory().keep([Outcome("4.3", [Result("C16", OK, "axes")], done=True)])
    show_solution(course, ["4.3"], memory())
    assert "publish_twist.py\n#!/usr/bin/" in capsys.readouterr().out
    with pytest.raises(CannotCheck, match=r"4\.4: this course has no solution"):
        show_solution(course, ["4.4"], memory())


@claim("A solution is ...", because="a file of the course")
@pytest.mark.parametrize("file", ["../secret", "link", "../course_2/x", "/etc/passwd"])
def test_a_solution_is_a_file_of_the_course(memory, tmp_path, file):
    folder = tmp_path / "course"
    folder.mkdir()
    (folder / "link").symlink_to("/etc/passwd")
    (folder / "course.yaml").write_text(f"exercises: {{'1': {{title: x, solution: [{file}]}}}}")
    memory().keep([Outcome("1", [Result("C16", OK, "axes")], done=True)])
    with pytest.raises(CannotCheck, match="is no file of the course's folder"):
        show_solution(read_course(folder), ["1"], memory())
