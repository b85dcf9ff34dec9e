"""Every mistake is found by the right check, with its cause; each row is a test."""

import grammar
import mistakes_launch
import mistakes_nodes
import mistakes_packages
import mistakes_world
import pytest
from edits import apply

from tutorial_check.course.definition import read_course
from tutorial_check.examining.examination import examine
from tutorial_check.report.text import lines_of
from tutorial_check.submission.order import Order
from tutorial_testing.claims import claim

OF_HANDOUT = mistakes_packages.ROWS + mistakes_nodes.ROWS + mistakes_launch.ROWS + grammar.WRONG
ROWS = OF_HANDOUT + mistakes_world.ROWS


def is_reported(result, words):
    """Return whether all the words are in the report of a Result."""
    report = "\n".join(lines_of(result)).lower()
    return all(word.lower() in report for word in words)


def wrong_of(outcomes):
    assert not [outcome.trouble for outcome in outcomes if outcome.trouble]
    return [result for outcome in outcomes for result in outcome.wrong]


@claim("A devel folder ...", because="a folder that is not whole")
@claim("An error of CMake, compiler ...", because="end to end")
@claim(
    "Each mistake in packages, files, nodes, launch files, the class and the world (76 of a "
    "grammar) is found at the right check, with its cause and its line"
)
@pytest.mark.parametrize("row", ROWS, ids=str)
def test_a_mistake_is_found(row, literal, examined):
    apply(row.edits, literal)
    wrong = wrong_of(examined(literal.parent, [row.exercise], only_first=True))
    assert wrong, f"missed: should be {row.check}"
    report = "\n".join(lines_of(wrong[0]))
    is_found = wrong[0].id == row.check and is_reported(wrong[0], row.words)
    assert is_found, f"should be {row.check}, {row.words}:\n{report}"


@claim("A mistake keeps no other exercise from a verdict")
@pytest.mark.parametrize("row", OF_HANDOUT, ids=str)
def test_a_mistake_is_found_in_all_exercises(row, literal, underlay):
    """Some check reports its cause, and every other exercise still has a verdict."""
    apply(row.edits, literal)
    order = Order(literal.parent, underlay, read_course().by_default)
    wrong = wrong_of(examine(order, side_by_side=True))
    assert any(is_reported(result, row.words) for result in wrong), [*map(lines_of, wrong)]
