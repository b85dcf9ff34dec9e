#!/usr/bin/python3
"""launch_joy_node.launch: a script of moves drives a square; another package reads the gamepad."""

import math
import os
import sys
import tempfile
import unittest
from pathlib import Path

import rospkg
import rospy
import rostest
import yaml
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry

from joy_to_twist.safety import WAITING
from tutorial_testing.joystick_stream import JoyLog
from tutorial_testing.nodes import init_node, node_path
from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for

SQUARE = ("config", "virtual_joystick", "square.yaml")  # in gamepad
METRES_PER_S, RADIANS_PER_S = 0.35, 1.2  # at full deflection: config/f710_d.yaml
NEAR_M, NEAR_RAD = 0.25, 0.3  # on a busy machine each move may be some hundredths of a second off
SCRIPT_S = 60.0  # more than it takes

# A package in place of joy. Its node pushes the stick with LB held, after a neutral message.
PACKAGE = """<package format="2"><name>other_joy</name><version>1.0.0</version>
<description>A stand-in.</description><maintainer email="a@b.cd">a</maintainer>
<license>BSD</license></package>"""
JOY_NODE = """#!/usr/bin/python3
import rospy
from sensor_msgs.msg import Joy

rospy.init_node("another_name")
joy = Joy(axes=[0.0] * 6, buttons=[0] * 12)
joy.header.frame_id = rospy.get_param("~dev")
publisher = rospy.Publisher("joy", Joy, queue_size=10)
rate = rospy.Rate(rospy.get_param("~autorepeat_rate"))
began = rospy.get_time()
while not rospy.is_shutdown():
    pushed = publisher.get_num_connections() and rospy.get_time() - began > 2.0
    joy.axes[1], joy.buttons[4] = float(pushed), int(pushed)
    publisher.publish(joy)
    rate.sleep()
"""


class LaunchTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.device = str(self.folder / "js0")
        self.states, self.odometry = [], []
        for subscriber in (
            rospy.Subscriber("/diagnostics", DiagnosticArray, self.keep_state),
            rospy.Subscriber("odom", Odometry, self.odometry.append),
        ):
            self.addCleanup(subscriber.unregister)

    def keep_state(self, message):
        self.states += [s.message for s in message.status if s.name.startswith("myjoystick2twist")]

    def launch(self, *arguments, **environment):
        command = ("roslaunch", "joy2twist", "launch_joy_node.launch")
        command += ("rviz:=false", "cockpit:=false")
        program = Program(*command, f"joy_dev:={self.device}", *arguments, **environment)
        self.addCleanup(program.__exit__)
        return program

    def distance_to(self, place):
        """How near the robot has come to a pose (x, y [m], yaw [rad]): the least distance [m]."""
        positions = [message.pose.pose.position for message in self.odometry]
        return min(math.dist((p.x, p.y), place[:2]) for p in positions)

    def test_the_script_of_the_square_is_driven(self):
        self.launch()
        # The script begins with its reader, and the robot must be ready then.
        wait_for(lambda: self.odometry and WAITING in self.states, "joy2twist and robot")
        path = os.path.join(rospkg.RosPack().get_path("gamepad"), *SQUARE)
        command = (node_path("gamepad", "virtual_joystick"), "--stream", self.device)
        with Program(*command, "--script", path) as program:
            self.assertEqual(program.wait(SCRIPT_S), 0, program.output)
        places = closed_form(yaml.safe_load(Path(path).read_text(encoding="utf-8"))["moves"])
        self.assertGreater(max(math.hypot(x, y) for x, y, _ in places), 1.4)  # the far corner
        for place in places:
            self.assertLess(self.distance_to(place), NEAR_M, f"not near {place}")
        last = self.odometry[-1]
        self.assertEqual((last.twist.twist.linear.x, last.twist.twist.angular.z), (0.0, 0.0))
        x, y, yaw = places[-1]
        at, q = last.pose.pose.position, last.pose.pose.orientation
        self.assertLess(math.dist((at.x, at.y), (x, y)), NEAR_M)
        turned = math.remainder(2 * math.atan2(q.z, q.w) - yaw, math.tau)
        self.assertLess(abs(turned), NEAR_RAD)

    def test_joy_pkg_starts_the_node_of_another_package(self):
        node = self.folder / "other_joy" / "joy_node"
        node.parent.mkdir()
        (node.parent / "package.xml").write_text(PACKAGE, encoding="utf-8")
        node.write_text(JOY_NODE, encoding="utf-8")
        node.chmod(0o755)
        log = JoyLog()
        self.addCleanup(log.stop)
        path = f"{self.folder}:{os.environ['ROS_PACKAGE_PATH']}"
        program = self.launch("joy_pkg:=other_joy", ROS_PACKAGE_PATH=path)
        wait_for(lambda: log.last and log.last[1] == [4], "held LB")
        self.assertEqual(log.messages[-1].header.frame_id, self.device)
        self.assertEqual(rospy.get_param("/joy_node"), {"dev": self.device, "autorepeat_rate": 20})
        wait_for(lambda: abs(self.odometry[-1].twist.twist.linear.x - METRES_PER_S) < 1e-6, "robot")
        program.interrupt()
        self.assertEqual(program.wait(), 0)
        self.assertNotIn("Traceback", program.output)


def closed_form(moves):
    """The pose (x, y [m], yaw [rad]) after each move: ahead, or a turn on the spot."""
    x = y = yaw = 0.0
    poses = []
    for move in moves:
        turn, ahead = move.get("left_stick", (0.0, 0.0))
        assert not (turn and ahead)
        x += METRES_PER_S * ahead * move["for"] * math.cos(yaw)
        y += METRES_PER_S * ahead * move["for"] * math.sin(yaw)
        yaw += RADIANS_PER_S * turn * move["for"]
        poses.append((x, y, yaw))
    return poses


if __name__ == "__main__":
    init_node("joystick_launch_test")
    rostest.rosrun("ros1_tutorial_test", "joystick_launch", LaunchTest, sys.argv)
