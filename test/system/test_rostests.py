"""test/run_rostests: each has a network of its own; what is ended leaves nothing behind."""

import contextlib
import os
import signal
import subprocess
from pathlib import Path

import pytest

from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for

TESTS = Path(__file__).resolve().parents[1]
LONG_TESTS = tuple(
    str(TESTS / "ros" / "fake_turtlebot_sim" / f"{name}.test")
    for name in ("fake_turtlebot_drive", "fake_turtlebot_live")
)


def networks_of_nodes(program):
    """Return the networks of the nodes that roslaunch has started below a program; a set."""
    networks = set()
    for pid in program.left_behind():
        with contextlib.suppress(OSError):  # it has just ended
            if b"__name:=" in Path(f"/proc/{pid}/cmdline").read_bytes():
                networks.add(os.readlink(f"/proc/{pid}/ns/net"))
    return networks


@pytest.mark.parametrize("end", ["SIGINT", "SIGTERM", "SIGHUP"])
def test_each_has_a_network_of_its_own_and_leaves_nothing(end, tmp_path, monkeypatch):
    monkeypatch.setenv("ROS_IP", "192.0.2.7")  # which no machine has, and which hinders no rostest
    is_refused = subprocess.call(["unshare", "--net", "true"], stderr=subprocess.DEVNULL)
    networks = 1 if is_refused else len(LONG_TESTS)  # where refused they share the machine's
    command = [str(TESTS / "run_rostests"), "2", str(tmp_path / "results"), *LONG_TESTS]
    with Program(*command) as rostests:
        wait_for(lambda: len(networks_of_nodes(rostests)) >= networks, "nodes")
        assert is_refused or os.readlink("/proc/self/ns/net") not in networks_of_nodes(rostests)
        os.kill(rostests.pid, signal.Signals[end])
        assert rostests.wait() == -signal.SIGINT
        assert "rostests: interrupted" in rostests.output
        assert "passed" not in rostests.output
        assert rostests.left_behind() == []
