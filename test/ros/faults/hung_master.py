#!/usr/bin/python3
"""Under a master that hangs every node ends, base first, and a warning makes nobody deaf."""

import contextlib
import math
import os
import signal
import sys
import time
import unittest

import rosgraph
import rospy
import rostest
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry

from node_kit.questions import call
from tutorial_testing.nodes import init_node, node_path
from tutorial_testing.processes import Program
from tutorial_testing.rig import BASE, DRIVER, JOYSTICK, MUX, Rig, go_on, stop
from tutorial_testing.waiting import BUSY_S, wait_for

INPUTS = '[{"name": "a", "topic": "input", "timeout": 1.0, "priority": 1}]'
MUX_COMMAND = (
    node_path("fake_turtlebot_sim", "cmd_vel_mux.py"), f"_subscribers:={INPUTS}",
    "cmd_vel_mux/output:=cmd_vel",
)  # fmt: skip
LONGEST_END_S = 1.5 + BUSY_S


@contextlib.contextmanager
def hung_master():
    """The master takes connections and answers nobody."""
    pids = [call(rosgraph.get_master_uri(), "getPid")[1]]
    stop(pids)
    try:
        yield
    finally:
        go_on(pids)


class FaultsUnderAHungMaster(unittest.TestCase):
    """What is connected stays so; whatever asks the master waits for ever."""

    def check_end(self, number):
        with Rig(with_mux=True) as rig:
            rig.drive()
            pids = {node: rig.pid(node) for node in rig.nodes}
            with hung_master():
                for node in (JOYSTICK, DRIVER, MUX, BASE):
                    began = time.monotonic()
                    os.kill(pids[node], number)
                    rig.programs[node].wait()
                    self.assertLess(time.monotonic() - began, LONGEST_END_S, node)
                    if node == JOYSTICK:
                        rig.wait_for_rest()
                self.assertFalse(rig.is_moving())

    def test_every_node_ends_on_sigint(self):
        self.check_end(signal.SIGINT)

    def test_every_node_ends_on_sigterm(self):
        self.check_end(signal.SIGTERM)

    def check_driven_end(self, node):
        """The wheels are at rest before the node that moved them is gone."""
        with Rig(with_mux=True) as rig:
            rig.drive()
            pid = rig.pid(node)
            with hung_master():
                os.kill(pid, signal.SIGINT)
                rig.programs[node].wait()
                wait_for(lambda: not rig.is_moving(), f"robot at rest after the end of {node}")

    def test_the_end_of_the_mux_leaves_a_standing_robot(self):
        self.check_driven_end(MUX)

    def test_the_end_of_the_base_leaves_a_standing_robot(self):
        self.check_driven_end(BASE)

    def test_a_warning_makes_nobody_deaf(self):
        """NaN and a speed beyond the robot's bring a warning of the mux and of the base."""
        moving, command = [], Twist()
        odom = rospy.Subscriber("odom", Odometry, lambda o: moving.append(o.twist.twist.linear.x))
        pilot = rospy.Publisher("/cmd_vel_mux/input", Twist, queue_size=10)
        self.addCleanup(odom.unregister)
        self.addCleanup(pilot.unregister)

        def speed(value):
            command.linear.x = value
            pilot.publish(command)
            return moving and moving[-1]

        nodes = [
            Program(*MUX_COMMAND),
            Program(node_path("fake_turtlebot_sim", "fake_turtlebot.py")),
        ]
        for node in nodes:
            self.addCleanup(node.__exit__)
        wait_for(lambda: speed(0.2), "robot that moves")
        with hung_master():
            for bad in (math.nan, 5.0, -5.0):
                speed(bad)
            wait_for(lambda: speed(0.0) == 0.0, "robot that obeys zero")
            wait_for(lambda: speed(0.2), "robot that obeys")


if __name__ == "__main__":
    init_node("hung_master")
    rostest.rosrun("ros1_tutorial_test", "hung_master", "__main__", sys.argv)
