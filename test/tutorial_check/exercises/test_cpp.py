"""Programs in C++: mistakes are found, in words of C++; right ones are right, or worth a note."""

import importlib
import shutil
from pathlib import Path

import pytest
import variants_cpp
from edits import apply
from notes_cpp import NOTES
from solution import B, J
from test_mistakes import is_reported, wrong_of

from tutorial_check.checking.checks import checks_of
from tutorial_check.course.definition import read_course
from tutorial_check.report.text import lines_of
from tutorial_testing.claims import claim

MODULES = sorted(Path(__file__).parent.glob("mistakes_cpp_*.py"))
MISTAKES = [row for path in MODULES for row in importlib.import_module(path.stem).ROWS]
OF_PYTHON = ("rospy", ".py", "Traceback")
UNUSED = {"2": "", "3": J}  # {exercise: the package that it does not need}; others: B


def change(row, src, exercise):
    """Apply the edits of a row, and remove what would be built in vain."""
    apply(row.edits, src)
    unused = UNUSED.get(exercise, B)
    if unused:
        shutil.rmtree(src / unused, ignore_errors=True)


@claim("A literal solution of the handout in C++ is right in every exercise")
def test_a_literal_solution_in_cpp_is_right(literal_cpp, check):
    course = read_course()
    seen = check(literal_cpp.parent, course.by_default)
    checks = {made.id for made in checks_of(course) if made.exercise in course.by_default}
    assert seen.keys() == checks


@claim(
    "Other right solutions in C++ (a global publisher, classes with bind, lambdas, spinners, "
    "timers, several files, a library, names by variables, remaps) are not blamed"
)
@pytest.mark.parametrize("row", variants_cpp.ROWS, ids=str)
def test_a_variant_in_cpp_is_right(row, literal_cpp, check):
    apply(row.edits, literal_cpp)
    check(literal_cpp.parent, row.exercises)


@claim(
    "Each mistake of a program in C++ is found at the right check, with its cause and its line; "
    "no report of it has words of Python"
)
@pytest.mark.parametrize("row", MISTAKES, ids=str)
def test_a_mistake_in_cpp_is_found(row, literal_cpp, examined):
    change(row, literal_cpp, row.exercise)
    wrong = wrong_of(examined(literal_cpp.parent, [row.exercise], only_first=True))
    assert wrong, f"missed: should be {row.check}"
    report = "\n".join(lines_of(wrong[0]))
    is_found = wrong[0].id == row.check and is_reported(wrong[0], row.words)
    assert is_found, f"should be {row.check}, {row.words}:\n{report}"
    assert not [word for word in OF_PYTHON if word in report], report


@claim("What is right in C++ and worth knowing is a note, with its line")
@pytest.mark.parametrize("row", NOTES, ids=str)
def test_a_right_program_in_cpp_is_noted(row, literal_cpp, check):
    change(row, literal_cpp, row.exercises[0])
    results = check(literal_cpp.parent, row.exercises)
    for name, words in row.notes.items():
        assert results[name].status == ("note" if words else "ok")
        assert is_reported(results[name], words), lines_of(results[name])
