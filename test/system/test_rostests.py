"""test/run_rostests: what an end by Ctrl-C leaves behind, which is nothing."""

import os
import signal
from pathlib import Path

import pytest

from tutorial_testing.processes import Program
from tutorial_testing.waiting import DEADLINE_S, wait_for

TESTS = Path(__file__).resolve().parents[1]
LONG_TESTS = [
    str(TESTS / "ros" / "fake_turtlebot_sim" / f"{name}.test")
    for name in ("fake_turtlebot_interface", "fake_turtlebot_live")
]


def runs_nodes(program):
    """Whether roslaunch has started nodes below a program."""
    for pid in program.left_behind():
        try:
            arguments = Path(f"/proc/{pid}/cmdline").read_bytes()
        except OSError:
            continue
        if b"__name:=" in arguments:
            return True
    return False


@pytest.mark.parametrize("end", ["Ctrl-C", "SIGTERM"])
def test_rostests_that_are_ended_leave_nothing(end, tmp_path):
    command = [str(TESTS / "run_rostests"), "2", str(tmp_path / "results"), *LONG_TESTS]
    with Program(*command) as rostests:
        wait_for(lambda: runs_nodes(rostests), "nodes", DEADLINE_S)
        if end == "Ctrl-C":
            rostests.interrupt()
        else:
            os.kill(rostests.pid, signal.SIGTERM)
        assert rostests.wait() == -signal.SIGINT
        assert "rostests: interrupted" in rostests.output
        assert "passed" not in rostests.output
        assert rostests.left_behind() == []
