#!/usr/bin/python3
"""Ctrl-C while launch_bag.launch drives: a standing robot, and nothing left behind."""

import os
import sys
import unittest

import rospkg
import rospy
import rostest
from geometry_msgs.msg import Twist

from tutorial_testing.nodes import init_node
from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for
from tutorial_tools.demo.program import NODES, RVIZ_NODE


class CtrlCTest(unittest.TestCase):
    def check(self, launch):
        """Start a launch command, interrupt it while it drives, look at what is left."""
        velocities = []
        subscriber = rospy.Subscriber(
            "/cmd_vel", Twist, lambda twist: velocities.append((twist.linear.x, twist.angular.z))
        )
        self.addCleanup(subscriber.unregister)
        with launch:
            wait_for(lambda: velocities and velocities[-1][0] > 0.1, "velocity")
            launch.interrupt()
            self.assertEqual(launch.wait(), 0)
            wait_for(lambda: not launch.left_behind(), "end of every process")
            wait_for(lambda: velocities[-1] == (0.0, 0.0), "zero as the last velocity")
            self.assertNotIn("Traceback", launch.output)
            # Where a node has not ended after 15 s, roslaunch says so, and kills it.
            self.assertNotIn("escalating", launch.output)

    def test_by_package(self):
        self.check(Program("roslaunch", "joy2twist", "launch_bag.launch", "rviz:=false"))

    def test_by_file_name_from_its_folder(self):
        folder = os.path.join(rospkg.RosPack().get_path("joy2twist"), "launch")
        self.check(
            Program("sh", "-c", f"cd '{folder}' && exec roslaunch launch_bag.launch rviz:=false")
        )

    def nodes(self, *arguments, **environment):
        """The names of the nodes that launch_bag.launch would start."""
        command = ("roslaunch", "--nodes", "joy2twist", "launch_bag.launch", *arguments)
        with Program(*command, **environment) as listing:
            self.assertEqual(listing.wait(), 0, listing.output)
            return listing.output.split()

    def test_rviz_opens_where_there_is_a_screen_or_where_it_is_asked_for(self):
        self.assertIn("/my_rviz", self.nodes(DISPLAY=":99"))
        self.assertNotIn("/my_rviz", self.nodes(DISPLAY=""))
        self.assertIn("/my_rviz", self.nodes("rviz:=true", DISPLAY=""))
        self.assertNotIn("/my_rviz", self.nodes("rviz:=false", DISPLAY=":99"))

    def test_the_demonstration_knows_the_nodes(self):
        self.assertEqual(sorted(NODES), sorted(self.nodes("rviz:=false", "cockpit:=false")))
        self.assertEqual(
            sorted([*NODES, RVIZ_NODE]), sorted(self.nodes("rviz:=true", "cockpit:=false"))
        )


if __name__ == "__main__":
    init_node("ctrl_c_test")
    rostest.rosrun("ros1_tutorial_test", "launch_bag_ctrl_c", CtrlCTest, sys.argv)
