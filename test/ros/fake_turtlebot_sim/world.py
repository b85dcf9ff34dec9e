#!/usr/bin/python3
"""A room as programs see it: map, scan, bumpers, frames, and the way back from a wall."""

import contextlib
import os
import signal
import time
from math import isfinite

import rospy
from geometry_msgs.msg import Twist
from kobuki_msgs.msg import BumperEvent
from nav_msgs.msg import OccupancyGrid, Odometry
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray

from tutorial_testing.nodes import pid_of
from tutorial_testing.processes import lives
from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import wait_for

AT_THE_WALL = 4.0 - 0.178  # x of the robot's middle [m]
LONGEST_PUSH_S = 0.5
REST_S = 0.7


class WorldTest(RosTest):
    @classmethod
    def setUpClass(cls):
        cls.heard = {}
        for topic, kind in (
            ("map", OccupancyGrid), ("world_markers", MarkerArray), ("scan", LaserScan),
            ("odom", Odometry), ("base_pose_ground_truth", Odometry),
            ("bumper_markers", MarkerArray),
        ):  # fmt: skip
            rospy.Subscriber(topic, kind, lambda m, topic=topic: cls.heard.update({topic: m}))
        cls.unmeasured = set()  # ranges that are no numbers
        rospy.Subscriber("scan", LaserScan, cls.on_scan)
        cls.frames, cls.events = {}, []
        for topic in ("/tf", "/tf_static"):
            rospy.Subscriber(topic, TFMessage, cls.on_tf)
        rospy.Subscriber(
            "mobile_base/events/bumper", BumperEvent,
            lambda event: cls.events.append((time.monotonic(), event)),
        )  # fmt: skip
        cls.teleop = rospy.Publisher("cmd_vel_mux/input/teleop", Twist, queue_size=1)
        wait_for(cls.teleop.get_num_connections, "mux")
        topics = ("map", "world_markers", "scan", "odom", "base_pose_ground_truth")
        wait_for(lambda: all(topic in cls.heard for topic in topics), "first messages")

    @classmethod
    def on_scan(cls, scan):
        cls.unmeasured |= {str(one) for one in scan.ranges if not isfinite(one)}

    @classmethod
    def on_tf(cls, message):
        for one in message.transforms:
            cls.frames[one.header.frame_id, one.child_frame_id] = one.transform.translation

    def drive(self, v, until, what):
        twist = Twist()
        twist.linear.x = v
        wait_for(lambda: self.teleop.publish(twist) or until(), what)

    def x(self):
        return self.heard["base_pose_ground_truth"].pose.pose.position.x

    def test_1_map_markers_frames_and_scan_show_the_room(self):
        self.assertEqual(self.heard["map"].header.frame_id, "map")
        self.assertEqual(set(self.heard["map"].data), {0, 100})
        shown = {marker.ns for marker in self.heard["world_markers"].markers}
        self.assertEqual(shown, {"walls", "posts"})
        camera = ("base_footprint", "camera_depth_frame")
        wait_for(lambda: self.frames.keys() >= {("map", "odom"), camera}, "transforms")
        self.assertAlmostEqual(self.frames["map", "odom"].x, 0.0)
        scan, behind = self.heard["scan"], self.frames[camera].x
        self.assertEqual((scan.header.frame_id, len(scan.ranges)), ("camera_depth_frame", 640))
        self.assertAlmostEqual(scan.ranges[320], 4.0 - behind, delta=1e-3)  # the wall ahead

    def test_2_at_the_wall_it_backs_off_however_the_stick_is_held(self):
        self.drive(0.7, lambda: len(self.events) >= 8, "the wall, met four times")
        self.assertLessEqual(self.x(), AT_THE_WALL + 1e-9)
        states = [event.state for _, event in self.events]
        self.assertEqual(states[:8], [1, 0] * 4)  # one event for each change
        self.assertEqual({event.bumper for _, event in self.events}, {BumperEvent.CENTER})
        pushes = [off - on for (on, _), (off, _) in zip(self.events[::2], self.events[1::2])]
        self.assertLess(max(pushes), LONGEST_PUSH_S)
        self.assertIn("bumper_markers", self.heard)
        self.assertEqual(self.unmeasured, {"nan"})  # at the wall, as on a real TurtleBot
        self.drive(-0.5, lambda: self.x() < 3.0, "way back, by the stick")

    def test_3_of_a_base_that_died_at_the_wall_no_bumper_stays_pressed(self):
        pid, heard = pid_of("/mobile_base"), []

        def back_off(_):  # the controller knows of the bumper by now
            heard.append(time.monotonic())
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)

        rospy.Subscriber("cmd_vel_mux/input/safety_controller", Twist, back_off)
        rests = time.monotonic() + REST_S  # the multiplexer wants to see it, after test_2
        self.drive(0.0, lambda: time.monotonic() > rests, "rest")
        self.drive(0.7, lambda: not lives(pid), "the wall, met for the last time")
        ended = time.monotonic()
        wait_for(lambda: time.monotonic() - max([ended, *heard]) > 1.0, "safety controller silent")


if __name__ == "__main__":
    run()
