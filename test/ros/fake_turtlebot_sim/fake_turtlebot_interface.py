#!/usr/bin/python3
"""The topics and services of the running node are those that its docstring tells."""

import inspect
import re
import sys
import unittest

import rosgraph
import rospy
import rostest

from fake_turtlebot_sim.simulator.node import FakeTurtlebot
from tutorial_testing.nodes import init_node
from tutorial_testing.waiting import wait_for

NODE = "/fake_turtlebot"
OF_EVERY_NODE = {"/rosout", "/tf_static", f"{NODE}/get_loggers", f"{NODE}/set_logger_level"}


class InterfaceTest(unittest.TestCase):
    def test_topics_and_services(self):
        wait_for(lambda: f"{NODE}/reset" in self.names(2), "the last thing that the node registers")
        documented = self.documented()
        with_errors = rospy.get_param(f"{NODE}/wheel_noise", 0.0) > 0
        if not with_errors:
            documented["Publishers"].remove("/base_pose_ground_truth")
        for kind, title in enumerate(("Publishers", "Subscribers", "Services")):
            self.assertEqual(
                self.names(kind) - OF_EVERY_NODE, documented[title] - OF_EVERY_NODE, title
            )

    @staticmethod
    def names(kind):
        """The node's publishers (0), subscribers (1) or services (2), as the master has them."""
        state = rosgraph.Master("/test").getSystemState()
        return {name for name, nodes in state[kind] if NODE in nodes}

    @staticmethod
    def documented():
        """{heading: names} of the docstring: each name stands before its type in brackets."""
        # getdoc, as Python takes the indentation away itself from 3.13 on.
        text = inspect.getdoc(FakeTurtlebot)
        parts = re.split(r"^(\w+): ", text, flags=re.MULTILINE)[1:]
        listed = dict(zip(parts[::2], parts[1::2]))
        return {
            title: {
                rospy.resolve_name(name.replace("~", f"{NODE}/"))
                for name in re.findall(r"([~/\w]+)(?: and [/\w]+)? \(", listed[title])
                + re.findall(r"and (\S+) \(", listed[title])
            }
            for title in ("Publishers", "Subscribers", "Services")
        }


if __name__ == "__main__":
    init_node("fake_turtlebot_interface")
    rostest.rosrun("ros1_tutorial_test", "fake_turtlebot_interface", InterfaceTest, sys.argv)
