"""A helper that does not answer is given up, and no late answer is taken for another one."""

import os

import pytest

from tutorial_check.isolation.helper_process import Helper
from tutorial_check.model import CannotCheck


@pytest.fixture
def gate(tmp_path):
    os.mkfifo(tmp_path / "gate")
    return tmp_path / "gate"


@pytest.fixture
def helper(gate):
    """One whose read_text() waits for the gate."""
    made = Helper(lambda: gate, {})
    yield made
    made.end()


def test_a_helper_that_was_late_is_asked_no_more(helper, gate):
    assert helper.call("exists") is True
    with pytest.raises(CannotCheck, match="hangs in read_text"):
        helper.call("read_text", deadline_s=0)
    with open(gate, "w"):
        pass
    with pytest.raises(CannotCheck, match="hangs in read_text"):
        helper.call("exists")
