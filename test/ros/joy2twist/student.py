#!/usr/bin/python3
"""A classroom: students replay joy.bag at once, and each drives its own robot."""

import sys
import unittest
from contextlib import ExitStack
from pathlib import Path

import rosgraph
import rospkg
import rospy
import rostest
from nav_msgs.msg import Odometry

from tutorial_testing.nodes import init_node
from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for

DRIVEN = [f"robot_{number}" for number in range(1, 4)]
STANDING = [f"robot_{number}" for number in range(4, 31)]
LONGEST_S = 240.0  # the recording takes 55 s, all programs on a busy machine as long to start
# Velocities that come late on a busy machine bend the path a little. Measured: 0.01 m.
TOLERANCE_M = 0.1
BAG = Path(rospkg.RosPack().get_path("joy2twist"), "bag", "joy.bag")


class StudentTest(unittest.TestCase):
    def test_three_drive_their_own_robots_and_the_others_stand(self):
        places = {name: [] for name in (*DRIVEN, *STANDING)}  # [m], as complex numbers
        speeds = {}

        def on_odometry(message, name):
            pose, twist = message.pose.pose, message.twist.twist
            at = complex(pose.position.x, pose.position.y)
            if not places[name] or places[name][-1] != at:
                places[name].append(at)
            speeds[name] = twist.linear.x, twist.angular.z

        for name in places:
            rospy.Subscriber(f"/{name}/odom", Odometry, on_odometry, name)
        wait_for(lambda: all(places.values()), "thirty robots")
        with ExitStack() as stack:
            command = ("roslaunch", "joy2twist", "student.launch", "rviz:=false", f"bag:={BAG}")
            students = [stack.enter_context(Program(*command, f"name:={name}")) for name in DRIVEN]
            wait_for(lambda: drivers() == set(DRIVEN), "three drivers at once", LONGEST_S)
            for student in students:
                self.assertEqual(student.wait(LONGEST_S), 0, student.output)
                for word in ("Traceback", "died"):  # a normal end does not look like a crash
                    self.assertNotIn(word, student.output)
        self.assertEqual([name for name in STANDING if len(places[name]) > 1], [])
        ends = [places[name][-1] - places[name][0] for name in DRIVEN]
        for name, end in zip(DRIVEN, ends):  # of the same recording
            self.assertGreater(max(abs(at - places[name][0]) for at in places[name]), 0.5, name)
            self.assertEqual(speeds[name], (0.0, 0.0))
            self.assertLess(abs(end - ends[0]), TOLERANCE_M, ends)


def drivers():
    """Return the robots to which velocities are sent."""
    publishers, _, _ = rosgraph.Master("/student").getSystemState()
    return {topic.split("/")[1] for topic, _ in publishers if topic.endswith("/cmd_vel")}


if __name__ == "__main__":
    init_node("student")
    rostest.rosrun("ros1_tutorial_test", "student", StudentTest, sys.argv)
