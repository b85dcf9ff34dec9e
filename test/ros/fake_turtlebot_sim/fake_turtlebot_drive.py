#!/usr/bin/python3
"""Commands in, pose out: ~commands and what to ~expect are data of the .test files.

~commands: list of {send: [v, w], shown: [v, w] (if the robot executes another), wait: seconds}
~expect: names from below with values, exact to 1e-9
"""

import sys
import unittest
from math import atan2

import rospy
import rostest
from fake_turtlebot_stepping import Robot, World
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState

from tutorial_testing.waiting import wait_for


class DriveTest(unittest.TestCase):
    def test_the_robot_is_where_it_was_sent(self):
        robot = Robot()
        joints, truths = [], []
        rospy.Subscriber("joint_states", JointState, joints.append)
        rospy.Subscriber("base_pose_ground_truth", Odometry, truths.append)
        world = World([robot])
        for command in rospy.get_param("~commands"):
            v, w = command["send"]
            began_ns = world.command(robot, v, w, tuple(command.get("shown", (v, w))))
            world.step(command["wait"] - (world.now_ns - began_ns) * 1e-9)
        end = robot.odometry[-1]
        wait_for(lambda: joints and joints[-1].header.stamp == end.header.stamp, "wheel joints")
        result = dict(pose_of(end), **twist_of(end))
        result.update(zip(("left_angle", "right_angle"), joints[-1].position))
        result.update(zip(("left_joint", "right_joint"), joints[-1].name))
        result.update(frame=end.header.frame_id, base_frame=end.child_frame_id)
        expected = rospy.get_param("~expect")
        if any(name.startswith("true_") for name in expected):
            wait_for(lambda: truths and truths[-1].header.stamp == end.header.stamp, "truth")
            result.update({f"true_{name}": value for name, value in pose_of(truths[-1]).items()})
        for name, value in expected.items():
            if isinstance(value, str):
                self.assertEqual(result[name], value, name)
            else:
                self.assertAlmostEqual(result[name], value, msg=name, delta=1e-9)


def pose_of(odometry):
    position, q = odometry.pose.pose.position, odometry.pose.pose.orientation
    return {"x": position.x, "y": position.y, "yaw": 2 * atan2(q.z, q.w)}


def twist_of(odometry):
    return {"v": odometry.twist.twist.linear.x, "w": odometry.twist.twist.angular.z}


if __name__ == "__main__":
    rospy.init_node("fake_turtlebot_drive")
    rostest.rosrun("ros1_tutorial_test", "fake_turtlebot_drive", DriveTest, sys.argv)
