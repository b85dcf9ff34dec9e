#!/usr/bin/python3
"""Every node exits in time, a base at rest first, whatever the screen, peers and master do."""

import contextlib
import math
import os
import signal
import tempfile
from pathlib import Path

import rosgraph
from geometry_msgs.msg import Twist

from node_kit.questions import call
from tutorial_testing.nodes import node_path, pid_of
from tutorial_testing.processes import Program
from tutorial_testing.rig import BASE, JOYSTICK, MUX, Rig, suspended
from tutorial_testing.robot import Robot
from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import BUSY_S, wait_for

LONGEST_END_S = 1.5 + BUSY_S
INPUTS = '[{"name": "a", "topic": "input", "timeout": 1.0, "priority": 1}]'


@contextlib.contextmanager
def held_screen():
    """Yield a path that can be written to, and is full: so is a terminal after Ctrl-S."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "screen"
        os.mkfifo(path)
        descriptor = os.open(path, os.O_RDWR | os.O_NONBLOCK)
        try:
            for size in (4096, 1):  # what is left of the last page, too
                with contextlib.suppress(BlockingIOError):
                    while True:
                        os.write(descriptor, b"." * size)
            yield str(path)
        finally:
            os.close(descriptor)


def master():
    return [call(rosgraph.get_master_uri(), "getPid")[1]]


class FaultsAtTheEnd(RosTest):
    def check_exit(self, rig, node, pid, number):
        """The node exits in time."""
        self.assertLess(rig.kill(node, number, pid), LONGEST_END_S, node)

    def check_each(self, rig, number, meanwhile):
        """One after the other is driven and ended, in a context that meanwhile(node) returns."""
        for node in rig.nodes:
            rig.drive()
            pid = pid_of(node)
            with meanwhile(node):
                self.check_exit(rig, node, pid, number)
            wait_for(lambda: not rig.moves, f"robot at rest after the end of {node}")
            if node != BASE:
                rig.start(node)

    def check_all(self, number):
        """All exit on a held screen, and with suspended peers."""
        with held_screen() as screen, Rig(screen=screen) as rig:
            self.check_each(rig, number, lambda _: contextlib.nullcontext())
        with Rig() as rig:
            peers = lambda node: [pid_of(one) for one in rig.nodes if one != node]  # noqa: E731
            self.check_each(rig, number, lambda node: suspended(peers(node)))

    def test_sigint(self):
        self.check_all(signal.SIGINT)

    def test_sigterm(self):
        self.check_all(signal.SIGTERM)

    def test_all_exit_under_a_hung_master_whichever_is_first(self):
        ends = ((JOYSTICK, signal.SIGTERM), (MUX, signal.SIGINT), (BASE, signal.SIGINT))
        for first, number in ends:
            with Rig() as rig:
                rig.drive()
                pids = {node: pid_of(node) for node in rig.nodes}
                with suspended(master()):
                    for node in (first, *(node for node in rig.nodes if node != first)):
                        self.check_exit(rig, node, pids[node], number)
                        wait_for(lambda: not rig.moves, "robot at rest")

    def test_a_warning_under_a_hung_master_makes_no_node_deaf(self):
        """NaN and a speed beyond the robot's bring a warning of the mux and of the base."""
        robot, command = self.enter(Robot()), Twist()
        pilot = self.publisher("/cmd_vel_mux/input", Twist)

        def moves(speed):
            command.linear.x = speed
            pilot.publish(command)
            return robot.moves

        mux = node_path("fake_turtlebot_sim", "cmd_vel_mux.py")
        base = node_path("fake_turtlebot_sim", "fake_turtlebot.py")
        with Program(mux, f"_subscribers:={INPUTS}", "cmd_vel_mux/output:=cmd_vel"), Program(base):
            wait_for(lambda: moves(0.2), "robot that moves")
            with suspended(master()):
                for bad in (math.nan, 5.0, -5.0):
                    moves(bad)
                wait_for(lambda: not moves(0.0), "robot that obeys zero")
                wait_for(lambda: moves(0.2), "robot that obeys")


if __name__ == "__main__":
    run()
