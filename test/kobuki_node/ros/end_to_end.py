"""minimal.launch with a Kobuki on a serial line: odometry, a figure of eight, and a bumper."""

import time
from math import degrees, hypot, remainder, tau
from pathlib import Path

import pytest
import rospkg
import rospy
from geometry_msgs.msg import Twist, Vector3
from kobuki_msgs.msg import BumperEvent

from tutorial_testing.claims import claim
from tutorial_testing.robot import PERIOD_S, Robot
from tutorial_testing.rostests import RosTest
from tutorial_testing.serial_kobuki import SerialKobuki
from tutorial_testing.waiting import tolerance, wait_for

BAG = Path(rospkg.RosPack().get_path("gamepad"), "bag/joy.bag")
RECORDING_S = 60.0  # joy.bag, about
WINDOW = 500  # odometry messages, ten seconds
MEDIAN_S = 0.001  # a busy machine adds jitter; ./tutorial bench kobuki_node measures it
POSE_M, HEADING_DEG = 0.001, 0.1
BACKS_OFF_S = 0.2
SAFE_SPEED = -0.1  # [m/s] of the safety controller


class Truth(Robot):
    odometry_topic = "base_pose_ground_truth"


@claim(
    "minimal.launch with a robot on a serial line: 50 Hz, a figure of eight ends within 1 mm and "
    "0.1 deg of the truth, and from a bumper it backs off within 0.2 s"
)
@pytest.mark.long
class EndToEnd(RosTest):
    def launch(self, *device):
        """Start a robot and the TurtleBot's launch file; return (odometry, truth)."""
        robot = self.enter(SerialKobuki(*device))
        truth, odometry = self.enter(Truth()), self.enter(Robot())
        self.start("roslaunch", "turtlebot_bringup", "minimal.launch", f"serialport:={robot.port}")
        wait_for(lambda: truth.odometry and odometry.odometry, "odometry and truth")
        return odometry, truth

    def test_1_odometry_comes_50_times_a_second(self):
        odometry, _ = self.launch()
        stamps = [moment.stamp for moment in odometry.more(WINDOW)]
        gaps = sorted(b - a for a, b in zip(stamps, stamps[1:]))
        self.assertAlmostEqual(gaps[len(gaps) // 2], PERIOD_S, delta=MEDIAN_S)

    def test_2_after_a_figure_of_eight_the_odometry_is_the_truth(self):
        odometry, truth = self.launch()
        played = self.start(
            "roslaunch", "joy2twist", "launch_joy_node_realTurtlebot.launch", f"bag:={BAG}",
            "rviz:=false", "cockpit:=false",
        )  # fmt: skip
        wait_for(lambda: truth.moves, "robot that drives")
        wait_for(lambda: played.ended, "end of the recording", 4 * RECORDING_S)
        truth.wait_for_rest()
        odometry.wait_for_rest()
        way = sum(hypot(b.x - a.x, b.y - a.y) for a, b in zip(truth.odometry, truth.odometry[1:]))
        self.assertGreater(way, 5.0)
        is_, seen = truth.now, odometry.now
        self.assertLess(hypot(seen.x - is_.x, seen.y - is_.y), POSE_M)
        self.assertLess(abs(degrees(remainder(seen.yaw - is_.yaw, tau))), HEADING_DEG)

    def test_3_from_a_bumper_the_robot_backs_off_though_the_stick_is_held(self):
        _, truth = self.launch("_world:=room")
        pressed = []
        hear = lambda event: pressed.append((time.time(), event.state))  # noqa: E731
        self.hear("mobile_base/events/bumper", BumperEvent, hear)
        teleop = self.connected("cmd_vel_mux/input/teleop", Twist, queue_size=1)
        ahead = Twist(linear=Vector3(x=0.5))
        late_s = tolerance()
        backs = lambda moment: moment.v == SAFE_SPEED  # noqa: E731
        timer = rospy.Timer(rospy.Duration(0.05), lambda _: teleop.publish(ahead))
        self.addCleanup(timer.shutdown)
        stamp = truth.first(backs, "robot that backs off").stamp
        timer.shutdown()
        hit_s = truth.first(lambda moment: moment.x > 4.0 - 0.178 - 1e-6, "wall").stamp
        self.assertTrue(pressed)
        self.assertLess(stamp - hit_s, BACKS_OFF_S + late_s())
