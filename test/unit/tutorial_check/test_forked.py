"""What a helper answers too late is not taken for the answer to another question."""

import os
import select
import signal

import pytest

from tutorial_check.forked import Helper
from tutorial_check.model import CannotCheck


class Waiter:
    """Answers when it is let."""

    def __init__(self, gate):
        self._gate = gate

    def wait(self):
        """Until somebody opens the gate."""
        with open(self._gate):
            return "late"

    def alive(self):
        """Whether it is there."""
        return True


def test_one_that_was_too_late_is_asked_no_more(tmp_path):
    gate = tmp_path / "gate"
    os.mkfifo(gate)
    helper = Helper(lambda: Waiter(gate), {})
    try:
        assert helper.call("alive") is True
        with pytest.raises(CannotCheck, match="hangs in wait"):
            helper.call("wait", deadline_s=0)
        with open(gate, "w"):
            select.select([helper._line], [], [])  # now it has answered
        with pytest.raises(CannotCheck, match="hangs in wait"):
            helper.call("alive")
    finally:
        helper.end()


def test_what_is_asked_in_vain_is_not_waited_for(tmp_path):
    """As a master that was ended, of which rospy never stops asking."""
    gate = tmp_path / "gate"
    os.mkfifo(gate)
    helper, other = Helper(lambda: Waiter(gate), {}), Helper(lambda: Waiter(gate), {})
    try:
        assert not other.ended
        os.kill(other.pid, signal.SIGKILL)
        with pytest.raises(CannotCheck, match="hangs in wait"):
            helper.call("wait", deadline_s=3600.0, in_vain=lambda: other.ended)
    finally:
        helper.end()
        other.end()
