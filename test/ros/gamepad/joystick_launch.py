#!/usr/bin/python3
"""launch_joy_node.launch: a script of moves drives a square; another package reads the gamepad."""

import math
import os
from pathlib import Path

import rospkg
import rospy
import yaml

from joy_to_twist.safety import WAITING
from tutorial_testing.joystick_stream import LAUNCH, JoystickTest
from tutorial_testing.keys import DiagnosedRobot
from tutorial_testing.nodes import node_path
from tutorial_testing.processes import Program
from tutorial_testing.rostests import run
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


class LaunchTest(JoystickTest):
    def setUp(self):
        super().setUp()
        self.robot = self.enter(DiagnosedRobot())

    def launch(self, *arguments, **environment):
        device = f"joy_dev:={self.stream.path}"
        return self.start(*LAUNCH, device, *arguments, **environment)

    def distance_to(self, place):
        """How near the robot has come to a pose (x, y [m], yaw [rad]): the least distance [m]."""
        return min(math.dist((m.x, m.y), place[:2]) for m in self.robot.odometry)

    def test_the_script_of_the_square_is_driven(self):
        self.launch()
        # The script begins with its reader, and the robot must be ready then.
        self.robot.wait_for_state(WAITING)
        path = os.path.join(rospkg.RosPack().get_path("gamepad"), *SQUARE)
        command = (node_path("gamepad", "virtual_joystick"), "--stream", self.stream.path)
        with Program(*command, "--script", path) as program:
            self.assertEqual(program.wait(SCRIPT_S), 0, program.output)
        places = closed_form(yaml.safe_load(Path(path).read_text(encoding="utf-8"))["moves"])
        self.assertGreater(max(math.hypot(x, y) for x, y, _ in places), 1.4)  # the far corner
        for place in places:
            self.assertLess(self.distance_to(place), NEAR_M, f"not near {place}")
        last, (x, y, yaw) = self.robot.now, places[-1]
        self.assertFalse(last.moves)
        self.assertLess(math.dist((last.x, last.y), (x, y)), NEAR_M)
        self.assertLess(abs(math.remainder(last.yaw - yaw, math.tau)), NEAR_RAD)

    def test_joy_pkg_starts_the_node_of_another_package(self):
        folder = self.folder()
        node = folder / "other_joy" / "joy_node"
        node.parent.mkdir()
        (node.parent / "package.xml").write_text(PACKAGE, encoding="utf-8")
        node.write_text(JOY_NODE, encoding="utf-8")
        node.chmod(0o755)
        path = f"{folder}:{os.environ['ROS_PACKAGE_PATH']}"
        program = self.launch("joy_pkg:=other_joy", ROS_PACKAGE_PATH=path)
        wait_for(lambda: self.last and self.last[1] == [4], "held LB")
        device = self.stream.path
        self.assertEqual(self.joys[-1].header.frame_id, device)
        self.assertEqual(rospy.get_param("/joy_node"), {"dev": device, "autorepeat_rate": 20})
        self.robot.first(lambda moment: abs(moment.v - METRES_PER_S) < 1e-6, "full speed")
        self.end(program)


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
    run()
