#!/usr/bin/python3
"""launch_joy_node.launch with a gamepad that falls silent; what trembles is for unit tests."""

import sys
import time
import unittest

import rospy
import rostest
from nav_msgs.msg import Odometry

from tutorial_testing.joystick_stream import AXIS, BUTTON, JoyLog, Stream
from tutorial_testing.nodes import init_node
from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for

VIGILANCE_S = 3.0  # of the launch file
LIMIT_S = VIGILANCE_S + 0.6 + 0.02  # the base's own timeout, and one period of its odometry
FULL, LB, FORWARD = 32767, 4, 1


class RadioSilenceTest(unittest.TestCase):
    def setUp(self):
        self.stream, self.odometry = Stream(), []
        self.addCleanup(self.stream.remove)
        self.addCleanup(rospy.Subscriber("odom", Odometry, self.odometry.append).unregister)
        self.log = JoyLog()
        self.addCleanup(self.log.stop)
        self.launch = Program(
            "roslaunch", "joy2twist", "launch_joy_node.launch", f"joy_dev:={self.stream.path}",
            "rviz:=false", "cockpit:=false",
        )  # fmt: skip
        self.addCleanup(self.launch.__exit__)
        wait_for(lambda: self.odometry, "robot")

    def moves(self):
        twist = self.odometry[-1].twist.twist
        return twist.linear.x != 0 or twist.angular.z != 0

    def show(self, held, forward):
        """Move the hand, and wait until joy_node has published it; when it was moved [s]."""
        seen, now = len(self.log.messages), time.time()
        self.stream.send((BUTTON, LB, int(held)), (AXIS, FORWARD, -forward))
        wait_for(lambda: len(self.log.messages) > seen + 1, "messages of joy_node")
        return now

    def drive(self):
        """Release everything, then hold LB and the stick until the robot moves."""

        def once():
            self.show(False, 0)
            moved = self.show(True, FULL)
            end = time.monotonic() + 2.0
            while time.monotonic() < end and not self.moves():
                time.sleep(0.01)
            return self.moves() and moved

        return wait_for(once, "moving robot")

    def silence_s(self):
        """Drive, then fall silent: how long after the last event the robot moved [s]."""
        moved = self.drive()
        wait_for(lambda: not self.moves(), "robot at rest")
        return max(m.header.stamp.to_sec() for m in self.odometry if m.twist.twist.linear.x) - moved

    def test_out_of_reach_it_stops_and_back_in_reach_it_waits_for_the_release(self):
        self.stream.plug_in()
        delays_s = []
        while len(delays_s) < 3 and min(delays_s, default=LIMIT_S) >= LIMIT_S:
            delays_s.append(self.silence_s())  # again on a machine that was late
        self.assertLess(min(delays_s), LIMIT_S)
        self.assertGreater(min(delays_s), VIGILANCE_S - 0.5)
        wait_for(lambda: "stops in 0.5 s" in self.launch.output, "warning")

        stood = len(self.odometry)
        for forward in (FULL, FULL // 2, FULL):  # back in reach, LB and the stick still held
            self.show(True, forward)
        wait_for(lambda: len(self.odometry) > stood + 50, "odometry")
        self.assertFalse(any(m.twist.twist.linear.x for m in self.odometry[stood:]))
        self.drive()


if __name__ == "__main__":
    init_node("radio_silence_test")
    rostest.rosrun("ros1_tutorial_test", "radio_silence", RadioSilenceTest, sys.argv)
