#!/usr/bin/python3
"""~publish_tf false: another node may say where the robot is."""

import sys
import unittest

import rospy
import rostest
from fake_turtlebot_stepping import Robot, World
from tf2_msgs.msg import TFMessage

from tutorial_testing.nodes import init_node
from tutorial_testing.waiting import wait_for


class NoTfTest(unittest.TestCase):
    def test_no_transform_is_published(self):
        heard = []
        tf = rospy.Subscriber("/tf", TFMessage, heard.append)
        world = World([Robot()])
        wait_for(tf.get_num_connections, "connection for transforms")
        world.step(1.0)
        self.assertEqual(heard, [])


if __name__ == "__main__":
    init_node("fake_turtlebot_no_tf")
    rostest.rosrun("ros1_tutorial_test", "fake_turtlebot_no_tf", NoTfTest, sys.argv)
