#!/usr/bin/python3
"""A classroom: ten students replay joy.bag at once, and each drives its own robot."""

import sys
import unittest
from contextlib import ExitStack
from pathlib import Path

import rosgraph
import rospkg
import rospy
import rostest
from nav_msgs.msg import Odometry
from rospy import AnyMsg

from tutorial_testing.nodes import init_node
from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for

ROBOTS = [f"robot_{number}" for number in range(1, 31)]
DRIVEN = ROBOTS[:10]
LONGEST_S = 240.0  # the recording takes 55 s, thirty programs on a busy machine as long to start
# Velocities that come late on a busy machine bend the path a little. Measured: 0.01 m.
TOLERANCE_M = 0.1
STATE_BYTES = 8 * 2 * (7 + 36) - 8  # pose, velocity and their covariances: the end of an Odometry
BAG = Path(rospkg.RosPack().get_path("joy2twist"), "bag", "joy.bag")


def place(odometry):
    """(place [m], direction) as complex numbers."""
    pose = odometry.pose.pose
    return (
        complex(pose.position.x, pose.position.y),
        complex(pose.orientation.w, pose.orientation.z) ** 2,
    )


class StudentTest(unittest.TestCase):
    def test_ten_drive_their_own_robots_and_the_others_stand(self):
        driven = {name: [] for name in DRIVEN}
        standing = {name: set() for name in ROBOTS[len(DRIVEN) :]}
        for name, raw in driven.items():
            # To be read later, and then every fifth: ten robots at 50 Hz are work.
            rospy.Subscriber(
                f"/{name}/odom", AnyMsg, lambda message, raw: raw.append(message._buff), raw
            )
        for name, states in standing.items():
            rospy.Subscriber(
                f"/{name}/odom",
                AnyMsg,
                lambda message, states: states.add(message._buff[-STATE_BYTES:]),
                states,
            )
        wait_for(lambda: all([*driven.values(), *standing.values()]), "thirty robots")

        with ExitStack() as stack:
            students = [
                stack.enter_context(
                    Program(
                        *("roslaunch", "joy2twist", "student.launch", "rviz:=false"),
                        *(f"name:={name}", f"bag:={BAG}"),
                    )
                )
                for name in DRIVEN
            ]
            wait_for(lambda: drivers() == set(DRIVEN), "ten drivers at once", LONGEST_S)
            for student in students:
                self.assertEqual(student.wait(LONGEST_S), 0, student.output)
                for word in ("Traceback", "died"):  # a normal end does not look like a crash
                    self.assertNotIn(word, student.output)

        for name, states in standing.items():
            self.assertEqual(len(states), 1, f"{name} does not stand still")
        ends = []
        for name, raw in driven.items():
            odometry = [Odometry().deserialize(one) for one in [*raw[::5], raw[-1]]]
            start, direction = place(odometry[0])
            path = [(place(o)[0] - start) / direction for o in odometry]
            self.assertGreater(max(map(abs, path)), 0.5, name)  # [m]
            ends.append(path[-1])
            twist = odometry[-1].twist.twist
            self.assertEqual((twist.linear.x, twist.angular.z), (0.0, 0.0))
        for end in ends:  # of the same recording
            self.assertLess(abs(end - ends[0]), TOLERANCE_M, ends)


def drivers():
    """Return the robots to which velocities are sent."""
    publishers, _, _ = rosgraph.Master("/student").getSystemState()
    return {topic.split("/")[1] for topic, _ in publishers if topic.endswith("/cmd_vel")}


if __name__ == "__main__":
    init_node("student")
    rostest.rosrun("ros1_tutorial_test", "student", StudentTest, sys.argv)
