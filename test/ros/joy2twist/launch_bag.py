#!/usr/bin/python3
"""What runs on the topics while launch_bag.launch does."""

import sys
import unittest

import rosnode
import rospy
import rostest
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState, Joy
from tf2_msgs.msg import TFMessage

from tutorial_testing.nodes import init_node
from tutorial_testing.waiting import wait_for

RATE_HZ = 50  # of joy.bag and of the simulation
SAMPLE_S = 6.0  # how much is looked at; the tour begins with a second of rest


class Recorder:
    """Keeps the messages of a topic."""

    def __init__(self, topic, message_type):
        self.messages = []
        self.subscriber = rospy.Subscriber(topic, message_type, self.messages.append)


class LaunchBagTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.cmd_vel = Recorder("/cmd_vel", Twist)
        cls.odom = Recorder("/odom", Odometry)
        cls.tf = Recorder("/tf", TFMessage)
        cls.joints = Recorder("/joint_states", JointState)
        wait_for(lambda: cls.odom.messages and cls.cmd_vel.messages, "first messages")
        cls.joy = Recorder("/joy", Joy)  # last: every joy below has its cmd_vel above
        wait_for(
            lambda: any(abs(odom.twist.twist.linear.x) > 0.1 for odom in cls.odom.messages),
            "moving robot",
        )
        wait_for(lambda: len(cls.joy.messages) > SAMPLE_S * RATE_HZ, "joystick messages")
        cls.joy.subscriber.unregister()
        # What is still under way: the newest joystick message must have its answer.
        last = cls.joy.messages[-1]
        wait_for(
            lambda: any(t.linear.x == last.axes[1] for t in cls.cmd_vel.messages[-RATE_HZ:]),
            "velocity for the last joystick message",
        )
        for recorder in (cls.cmd_vel, cls.odom, cls.tf, cls.joints):
            recorder.subscriber.unregister()

    def test_the_nodes_have_the_names_of_the_handout(self):
        for node in ("/fake_turtlebot", "/myjoystick2twist", "/rosbag", "/robot_state_publisher"):
            self.assertIn(node, rosnode.get_node_names())
        self.assertNotIn("/my_rviz", rosnode.get_node_names())  # rviz:=false

    def test_one_velocity_for_every_joystick_message_with_its_values(self):
        expected = [(joy.axes[1], joy.axes[0]) for joy in self.joy.messages]
        sent = [(twist.linear.x, twist.angular.z) for twist in self.cmd_vel.messages]
        self.assertGreater(len(set(expected)), RATE_HZ)
        starts = [
            start
            for start in range(len(sent) - len(expected) + 1)
            if sent[start : start + len(expected)] == expected
        ]
        self.assertTrue(starts, "the velocities are not those of the joystick, one for one")
        for twist in self.cmd_vel.messages:
            others = (twist.linear.y, twist.linear.z, twist.angular.x, twist.angular.y)
            self.assertEqual(others, (0, 0, 0, 0))

    def test_the_wheels_turn_and_the_model_is_published(self):
        first, last = self.joints.messages[0], self.joints.messages[-1]
        self.assertEqual(set(last.name), {"wheel_left_joint", "wheel_right_joint"})
        for before, after in zip(first.position, last.position):
            self.assertGreater(after - before, 1.0)  # [rad]: some 0.04 m of way and more
        children = {t.child_frame_id for message in self.tf.messages for t in message.transforms}
        self.assertLessEqual({"wheel_left_link", "wheel_right_link"}, children)


if __name__ == "__main__":
    init_node("launch_bag_test")
    rostest.rosrun("ros1_tutorial_test", "launch_bag", LaunchBagTest, sys.argv)
