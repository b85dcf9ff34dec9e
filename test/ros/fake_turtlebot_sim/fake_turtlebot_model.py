#!/usr/bin/python3
"""The model's links hang on the robot that they belong to; names by ~prefix."""

import sys
import unittest

import rospy
import rostest
from tf2_msgs.msg import TFMessage

from tutorial_testing.nodes import init_node
from tutorial_testing.waiting import wait_for


class ModelTest(unittest.TestCase):
    def test_every_link_hangs_on_the_odometry_of_its_robot(self):
        prefix, parents = rospy.get_param("~prefix"), {}

        def on_transforms(message):
            for transform in message.transforms:
                parents[transform.child_frame_id] = transform.header.frame_id

        rospy.Subscriber("/tf", TFMessage, on_transforms)
        rospy.Subscriber("/tf_static", TFMessage, on_transforms)
        for link in ("stack_link", "wheel_left_link", "wheel_right_link"):
            wait_for(lambda link=link: prefix + link in parents, f"transform of {prefix}{link}")
            self.assertEqual(parents[prefix + link], f"{prefix}base_link")
        wait_for(lambda: f"{prefix}base_link" in parents, "transform of the base")
        self.assertEqual(parents[f"{prefix}base_link"], f"{prefix}base_footprint")
        wait_for(lambda: f"{prefix}base_footprint" in parents, "transform of the robot")
        self.assertEqual(parents[f"{prefix}base_footprint"], f"{prefix}odom")


if __name__ == "__main__":
    init_node("fake_turtlebot_model")
    rostest.rosrun("ros1_tutorial_test", "fake_turtlebot_model", ModelTest, sys.argv)
