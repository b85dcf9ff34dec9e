"""Every mistake is found, at the right check, with its cause. One row, one test."""

import grammar
import mistakes_launch
import mistakes_nodes
import mistakes_packages
import mistakes_world
import pytest
from edits import apply

from tutorial_check.checking.examination import examine
from tutorial_check.course.definition import read_course
from tutorial_check.report.text import lines_of
from tutorial_check.submission.order import Order

OF_HANDOUT = mistakes_packages.ROWS + mistakes_nodes.ROWS + mistakes_launch.ROWS + grammar.WRONG
ROWS = OF_HANDOUT + mistakes_world.ROWS


def is_reported(result, words):
    """Return whether all the words, or the one, are in the report of a Result."""
    words = [words] if isinstance(words, str) else words
    report = "\n".join(lines_of(result)).lower()
    return all(word.lower() in report for word in words)


def named(rows):
    return [f"{row[0]} {row[1]}" for row in rows]


def wrong_of(outcomes):
    assert not [each.trouble for each in outcomes if each.trouble]
    return [one for each in outcomes for one in each.wrong]


@pytest.mark.parametrize("row", ROWS, ids=named(ROWS))
def test_a_mistake_is_found(row, literal, examined):
    exercise, _, edits, check, words = row
    apply(edits, literal)
    wrong = wrong_of(examined(literal.parent, [exercise], only_first=True))
    assert wrong, f"missed: should be {check}"
    report = "\n".join(lines_of(wrong[0]))
    assert wrong[0].id == check and is_reported(wrong[0], words), f"should be {row[3:]}:\n{report}"


@pytest.mark.parametrize("row", OF_HANDOUT, ids=named(OF_HANDOUT))
def test_a_mistake_is_found_in_all_exercises(row, literal, underlay):
    """Its cause is reported, maybe by an earlier check, and it keeps no other one from a verdict."""
    apply(row[2], literal)
    order = Order(literal.parent, underlay, read_course().by_default)
    wrong = wrong_of(examine(order, side_by_side=True))
    assert any(is_reported(one, row[4]) for one in wrong), [lines_of(one) for one in wrong]
