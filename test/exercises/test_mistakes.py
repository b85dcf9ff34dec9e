"""Every mistake is found, at the right check, with its cause. One row, one test."""

import grammar
import mistakes_launch
import mistakes_nodes
import mistakes_packages
import mistakes_world
import pytest
from edits import apply

from tutorial_check.course import read_course
from tutorial_check.examination import examine
from tutorial_check.model import CannotCheck
from tutorial_check.report import lines_of

OF_HANDOUT = mistakes_packages.ROWS + mistakes_nodes.ROWS + mistakes_launch.ROWS + grammar.WRONG
ROWS = OF_HANDOUT + mistakes_world.ROWS


def is_reported(result, words):
    """Return whether all the words, or the one, are in the report of a Result."""
    words = [words] if isinstance(words, str) else words
    report = "\n".join(lines_of(result)).lower()
    return all(word.lower() in report for word in words)


def named(rows):
    return [f"{row[0]} {row[1]}" for row in rows]


def found(row, literal, underlay, record_property, exercises):
    """All results that are wrong, when these exercises are checked."""
    apply(row[2], literal)
    try:
        outcomes = examine(literal.parent, underlay, exercises, only_first=len(exercises) == 1)
        trouble = next((each.trouble for each in outcomes if each.trouble), "")
    except CannotCheck as error:
        trouble = str(error)
    if trouble:
        record_property("not checked", f"{row[0]} {row[1]}: {trouble}")
        pytest.fail(trouble)
    return [one for each in outcomes for one in each.results if one.status == "wrong"]


@pytest.mark.parametrize("row", ROWS, ids=named(ROWS))
def test_mistake(row, literal, underlay, record_property):
    exercise, what, _, check, words = row
    title = f"{exercise} {what}"
    wrong = found(row, literal, underlay, record_property, [exercise])
    if not wrong:
        record_property("missed", f"{title}: should be {check}")
        pytest.fail("missed")
    if wrong[0].id != check or not is_reported(wrong[0], words):
        report = "\n".join(lines_of(wrong[0]))
        record_property("wrongly blamed", f"{title}: should be {check} with {words}, is {report}")
        pytest.fail(report)
    record_property("found", title)


@pytest.mark.parametrize("row", OF_HANDOUT, ids=named(OF_HANDOUT))
def test_in_all_exercises(row, literal, underlay, record_property):
    """Its cause is reported, maybe by an earlier check, and it keeps no other one from a verdict."""
    title = f"{row[0]} {row[1]}"
    wrong = found(row, literal, underlay, record_property, read_course().by_default)
    causes = [one for one in wrong if is_reported(one, row[4])]
    others = [one.id for one in wrong if one not in causes]
    if others:
        record_property("reported as well", f"{title}: {', '.join(others)}")
    if not causes:
        record_property("missed", f"{title}: should have {row[4]}")
        pytest.fail("missed")
    record_property("found", title)


def test_there_are_enough():
    """A row that is twice there counts once."""
    assert len({(row[0], row[1]) for row in ROWS}) == len(ROWS) >= 140
    assert min(len(grammar.WRONG), len(grammar.RIGHT)) >= 60
