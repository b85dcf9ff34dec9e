"""From commands to the pose, step by step; the test publishes /clock, so no machine is too slow.

A step ends when the odometry with its stamp arrives.
"""

from math import cos, dist, nan, pi, sin

import rospy
from geometry_msgs.msg import PoseWithCovarianceStamped, Twist, Vector3
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock, Log
from sensor_msgs.msg import JointState
from std_msgs.msg import Empty
from std_srvs.srv import Empty as EmptyService
from tf2_msgs.msg import TFMessage

from tutorial_testing.claims import claim
from tutorial_testing.robot import Moment, Robot
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import wait_for

PERIOD_NS = 20_000_000
START = (1.0, -2.0, pi / 2)
BACK_NS, COAST_M = 10 * 10**9, 0.7 * 0.6  # a jump of time, and how far the robot coasts in it


def after(v, w, seconds):
    """Return the pose after an arc from the start."""
    ahead, left = v / w * sin(w * seconds), v / w * (1 - cos(w * seconds))
    return START[0] - left, START[1] + ahead, START[2] + w * seconds


class SteppedRobotTest(RosTest):
    now_ns = 100 * 10**9

    def setUp(self):
        self.log, self.joints = self.record("/rosout", Log), self.record("joint_states", JointState)
        self.cmd_vel, self.clock = self.connected("cmd_vel", Twist), self.publisher("/clock", Clock)
        self.robot = self.enter(Robot())

    @claim(
        "Frames, joints, start and `~publish_tf` are parameters; pose estimate and the two resets "
        "put the robot elsewhere, and a pose in another frame is refused"
    )
    @claim("Simulated time may pause, jump and be set back", because="end to end")
    @claim("Too fast is scaled ...", because="the reports")
    def test_it_is_limited_stops_by_itself_is_put_elsewhere_and_bears_a_clock_set_back(self):
        transforms = self.record("/tf", TFMessage)
        told, truths = (self.record(one, Odometry) for one in ("odom", "base_pose_ground_truth"))
        # The test does not know when the robot connects to /clock: time goes on until it answers.
        wait_for(lambda: self.tell(PERIOD_NS) or (self.robot.odometry and truths), "odometry")
        self.check_a_drive(told, truths)
        self.assertEqual(transforms, [])  # ~publish_tf is false
        self.check_places()
        self.check_clock()

    def check_a_drive(self, told, truths):
        self.command(1.4, 1.0, (0.7, 0.5))  # scaled down, with the same radius
        self.step(0.2)
        self.command(nan, 0.0, (0.7, 0.5))  # ignored; it does not feed the timeout either
        self.step(1.0)
        # Wheels of 0.8 and 1.2 times the nominal radius, 0.2 m apart, truly drive 0.52 and 0.9 m/s.
        for messages, arc in ((told, (0.7, 0.5)), (truths, (0.71, 1.9))):
            self.check_near(Moment.of(self.newest(messages)).pose, after(*arc, 0.6))
        self.assertFalse(self.robot.moves)
        frames = told[-1].header.frame_id, told[-1].child_frame_id
        joints = self.newest(self.joints).name
        self.assertEqual((*frames, *joints), ("home", "hull", "port", "starboard"))
        wait_for(lambda: len(self.warnings()) >= 2, "warnings")
        limited, rejected = self.warnings()
        self.assertIn("scaled down", limited)
        self.assertIn("not a finite number", rejected)

    def check_places(self):
        initialpose = self.connected("initialpose", PoseWithCovarianceStamped)
        reset_odometry = self.connected("mobile_base/commands/reset_odometry", Empty)
        service = rospy.ServiceProxy("/fake_turtlebot/reset", EmptyService)
        given = PoseWithCovarianceStamped()
        given.pose.pose.position.x, given.pose.pose.orientation.w = 3.0, 1.0
        for reset in (reset_odometry.publish, service):
            self.command(0.5, 0.5)
            self.step(1.0)
            before, wheels = self.robot.now.pose, self.newest(self.joints).position
            given.header.frame_id = "map"
            initialpose.publish(given)
            wait_for(lambda: "'map'" in "".join(self.warnings()), "warning about the frame")
            self.step(0.1)
            self.assertEqual(self.robot.now.pose, before)
            given.header.frame_id = "home"
            initialpose.publish(given)
            self.reach((3.0, 0.0, 0.0))
            self.assertEqual(self.newest(self.joints).position, wheels)
            reset()
            self.reach((0.0, 0.0, 0.0))
            self.assertEqual(self.newest(self.joints).position, (0.0, 0.0))
            self.log.clear()

    def check_clock(self):
        self.command(0.7, 0.0)
        begin = self.robot.now
        at = begin
        self.tell(-BACK_NS)  # it answers with this stamp and keeps its pose
        self.wait_for_answer()
        self.assertEqual(self.robot.now.pose, at.pose)
        self.step(0.1)  # each period is published again
        self.assertAlmostEqual(dist(self.robot.now.pose[:2], at.pose[:2]), 0.07)
        self.tell(4 * BACK_NS)
        self.wait_for_answer()
        self.assertLessEqual(dist(self.robot.now.pose[:2], begin.pose[:2]), COAST_M + 1e-9)
        self.assertFalse(self.robot.now.moves)

    def tell(self, later_ns):
        """Let time go on, or back, without waiting for an answer."""
        self.now_ns += later_ns
        self.clock.publish(Clock(rospy.Time(0, self.now_ns)))

    def wait_for_answer(self):
        stamp = rospy.Time(0, self.now_ns).to_sec()
        wait_for(lambda: self.robot.now.stamp == stamp, f"odometry with the stamp {stamp:.3f}")

    def step(self, seconds=0.02):
        """Let time go on in periods of 50 Hz."""
        for _ in range(round(seconds * 1e9 / PERIOD_NS)):
            self.tell(PERIOD_NS)
            self.wait_for_answer()

    def reach(self, values, name="pose"):
        """Step until the odometry shows this pose or velocity."""

        def shows():
            self.step()
            return dist(getattr(self.robot.now, name), values) < 1e-9

        wait_for(shows, f"odometry with the {name} {values}")

    def command(self, v, w, shown=None):
        """Send a velocity and step until the odometry shows it."""
        self.cmd_vel.publish(Twist(Vector3(x=v), Vector3(z=w)))
        self.reach(shown or (v, w), "velocity")

    def newest(self, messages):
        """Return the current message of a topic."""
        stamp = self.robot.now.stamp
        is_there = lambda: messages and messages[-1].header.stamp.to_sec() == stamp  # noqa: E731
        return wait_for(is_there, "message of now") and messages[-1]

    def check_near(self, pose, expected):
        for value, wanted in zip(pose, expected):
            self.assertAlmostEqual(value, wanted, delta=1e-9)

    def warnings(self):
        return [line.msg for line in self.log if line.level >= Log.WARN]
