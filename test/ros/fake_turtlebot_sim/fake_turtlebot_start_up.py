#!/usr/bin/python3
"""The node's beginning and end: mistakes are one clear line, Ctrl-C is no drama."""

import sys
import time
import unittest

import rospy
import rostest
from nav_msgs.msg import Odometry

from tutorial_testing.nodes import init_node, node_path
from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for

NODE = (node_path("fake_turtlebot_sim", "fake_turtlebot.py"),)


def run(*arguments, **environment):
    """Run the node until it ends by itself; return (exit code, what it said)."""
    with Program(*NODE, *arguments, **environment) as node:
        return node.wait(), node.output.strip()


class StartUpTest(unittest.TestCase):
    def assert_one_clear_line(self, result, *parts):
        code, said = result
        self.assertEqual(code, 1, said)
        self.assertEqual(len(said.splitlines()), 1, said)
        for part in parts:
            self.assertIn(part, said)

    def test_an_unknown_parameter(self):
        result = run("_timeout:=1.0", "__name:=unknown_parameter")
        self.assert_one_clear_line(result, "~timeout: 1.0", "did you mean ~cmd_vel_timeout?")

        self.assertFalse(rospy.has_param("/unknown_parameter/timeout"))  # the next start may work

    def test_a_parameter_out_of_range(self):
        result = run("_rate:=0", "__name:=out_of_range")
        self.assert_one_clear_line(result, "~rate: 0", "from 5 to 1000 Hz")

    def test_no_master(self):
        # The discard port of this machine: nobody listens there.
        result = run(ROS_MASTER_URI="http://localhost:9")
        self.assert_one_clear_line(result, "no ROS master at http://localhost:9", "start roscore")

    def test_no_address_of_a_master(self):
        result = run(ROS_MASTER_URI="localhost")
        self.assert_one_clear_line(result, "ROS_MASTER_URI", "localhost")

    def test_ctrl_c_ends_it_at_once_and_quietly(self):
        odometry = []
        rospy.Subscriber("odom", Odometry, odometry.append)
        with Program(*NODE, "__name:=ctrl_c") as node:
            wait_for(lambda: odometry, "odometry")
            node.interrupt()
            begin_s = time.monotonic()
            code, said = node.wait(), node.output
            took_s = time.monotonic() - begin_s
        self.assertEqual(code, 0, said)
        self.assertEqual(said.strip(), "")
        self.assertLess(took_s, 3.0)  # a quiet machine: 0.3 s


if __name__ == "__main__":
    init_node("fake_turtlebot_start_up")
    rostest.rosrun("ros1_tutorial_test", "fake_turtlebot_start_up", StartUpTest, sys.argv)
