"""A room as programs see it: map, scan, bumpers, frames, and the way back from a wall."""

import time
from math import isfinite

from geometry_msgs.msg import Twist, Vector3
from kobuki_msgs.msg import BumperEvent
from nav_msgs.msg import OccupancyGrid, Odometry
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray

from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import Stopwatch, wait_for

AT_THE_WALL = 4.0 - 0.178  # x of the robot's middle [m]
BEHIND_M = 0.087  # by which the camera is behind the robot's middle
LONGEST_PUSH_S = 0.5


class WorldTest(RosTest):
    def test_1_map_markers_frames_and_scan_show_the_room(self):
        grids, markers = (
            self.record("map", OccupancyGrid),
            self.record("world_markers", MarkerArray),
        )
        scans, frames = self.record("scan", LaserScan), {}

        def on_tf(message):
            for one in message.transforms:
                x = round(one.transform.translation.x, 6)
                frames[one.header.frame_id, one.child_frame_id] = x

        for topic in ("/tf", "/tf_static"):
            self.hear(topic, TFMessage, on_tf)
        expected = {("map", "odom"): 0.0, ("base_footprint", "camera_depth_frame"): -BEHIND_M}
        wait_for(lambda: expected.items() <= frames.items(), "transforms")
        wait_for(lambda: grids and markers and scans, "first messages")
        self.assertEqual((grids[0].header.frame_id, set(grids[0].data)), ("map", {0, 100}))
        self.assertEqual({marker.ns for marker in markers[0].markers}, {"walls", "posts"})
        scan = scans[0]
        self.assertEqual((scan.header.frame_id, len(scan.ranges)), ("camera_depth_frame", 640))
        self.assertAlmostEqual(scan.ranges[320], 4.0 + BEHIND_M, delta=1e-3)  # the wall ahead

    def test_2_at_the_wall_it_backs_off_however_the_stick_is_held(self):
        events, unmeasured = [], set()  # (when, event); ranges that are no numbers
        truths = self.record("base_pose_ground_truth", Odometry)
        shown = self.record("bumper_markers", MarkerArray)
        self.hear(
            "mobile_base/events/bumper", BumperEvent,
            lambda event: events.append((time.monotonic(), event)),
        )  # fmt: skip
        self.hear(
            "scan", LaserScan,
            lambda scan: unmeasured.update(str(one) for one in scan.ranges if not isfinite(one)),
        )  # fmt: skip
        teleop = self.publisher("cmd_vel_mux/input/teleop", Twist, queue_size=1)
        wait_for(teleop.get_num_connections, "mux")

        def drive(v, until, what):
            wait_for(lambda: teleop.publish(Twist(linear=Vector3(x=v))) or until(), what)

        watch = Stopwatch()
        drive(0.7, lambda: len(events) >= 8, "the wall, met four times")
        places = [truth.pose.pose.position.x for truth in truths]
        self.assertLessEqual(max(places), AT_THE_WALL + 1e-9)
        self.assertEqual([event.state for _, event in events[:8]], [1, 0] * 4)
        self.assertEqual({event.bumper for _, event in events}, {BumperEvent.CENTER})
        pushes = [off - on for (on, _), (off, _) in zip(events[::2], events[1::2])]
        self.assertLess(max(pushes), LONGEST_PUSH_S + watch.lost_s)
        self.assertTrue(shown)
        self.assertEqual(unmeasured, {"nan"})  # at the wall, as on a real TurtleBot
        drive(-0.5, lambda: truths[-1].pose.pose.position.x < 3.0, "way back, by the stick")
