"""Two TurtleBots in groups: each has its own topics, frames and starting place."""

from geometry_msgs.msg import Twist, Vector3
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

from tutorial_testing.claims import claim
from tutorial_testing.robot import Robot
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import wait_for

FORWARDS = Twist(linear=Vector3(0.3, 0.0, 0.0))
STATIC = {"base_footprint": "base_link", "base_link": "gyro_link"}
DRIVEN = {"odom": "base_footprint", "base_link": "wheel_left_link"}


@claim(
    "Two TurtleBots in groups have their own topics and frames; every link of the model hangs on "
    "its robot"
)
class TwoTurtlebotsTest(RosTest):
    def test_each_starts_at_its_place_and_is_driven_by_its_own_input(self):
        first, second = (self.enter(Robot(f"{name}/")) for name in ("tb1", "tb2"))
        wait_for(lambda: first.odometry and second.odometry, "odometry")
        for value, given in zip(second.now.pose, (1.5, -0.5, 0.7)):
            self.assertAlmostEqual(value, given)
        for name, robot, other in (("tb1", first, second), ("tb2", second, first)):
            teleop = self.connected(f"/{name}/cmd_vel_mux/input/teleop", Twist, queue_size=1)
            other.wait_for_rest()
            before = len(other.odometry)
            drives = lambda r=robot, t=teleop: t.publish(FORWARDS) or r.now.v == 0.3  # noqa: E731
            wait_for(drives, "motion")
            wait_for(lambda n=before, o=other: len(o.odometry) > n, "odometry of the other one")
            self.assertFalse(any(moment.moves for moment in other.odometry[before:]))

    def test_frames_and_the_scan_of_3dsensor_have_the_prefix_of_their_group(self):
        both = [self.record(name, TFMessage) for name in ("/tf", "/tf_static")]
        scans = self.record("/tb2/laser", LaserScan)

        def links():
            transforms = [
                link for sent in both for message in list(sent) for link in message.transforms
            ]
            return {(link.header.frame_id, link.child_frame_id) for link in transforms}

        wanted = {
            (prefix + parent, prefix + child)
            for prefix, of in (("", DRIVEN), ("tb2/", DRIVEN), ("tb2/", STATIC), ("bob/", STATIC))
            for parent, child in of.items()
        }
        wait_for(lambda: links() >= wanted and scans, "transforms of both, and scans")
        self.assertEqual(scans[0].header.frame_id, "tb2/camera_depth_frame")
        self.assertEqual({"tb2/odom"}, {child for parent, child in links() if parent == "map"})
