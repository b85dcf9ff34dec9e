"""Every mistake is found, at the right check, with its cause. One row, one test."""

import mistakes_launch
import mistakes_nodes
import mistakes_packages
import pytest
from edits import apply

from tutorial_check.examination import examine
from tutorial_check.model import CannotCheck
from tutorial_check.report import lines_of

ROWS = mistakes_packages.ROWS + mistakes_nodes.ROWS + mistakes_launch.ROWS


@pytest.mark.parametrize("row", ROWS, ids=[f"{row[0]} {row[1]}" for row in ROWS])
def test_mistake(row, literal, floor, record_property):
    exercise, what, edits, check, words = row
    words = [words] if isinstance(words, str) else words
    apply(edits, literal)
    title = f"{exercise} {what}"
    try:
        outcomes = examine(literal.parent, floor, [exercise], only_first=True)
    except CannotCheck as error:
        record_property("not checked", f"{title}: {error}")
        raise
    wrong = [result for result in outcomes[0].results if result.status == "wrong"]
    if outcomes[0].trouble:
        record_property("not checked", f"{title}: {outcomes[0].trouble}")
        pytest.fail("not checked")
    if not wrong:
        record_property("missed", f"{title}: should be {check}")
        pytest.fail("missed")
    told = "\n".join(lines_of(wrong[0]))
    if wrong[0].id != check or not all(word.lower() in told.lower() for word in words):
        record_property("wrongly blamed", f"{title}: should be {check} with {words}, is {told}")
        pytest.fail(told)
    record_property("found", title)


def test_there_are_enough():
    """A row that is twice there counts once."""
    assert len({(row[0], row[1]) for row in ROWS}) == len(ROWS) >= 80
