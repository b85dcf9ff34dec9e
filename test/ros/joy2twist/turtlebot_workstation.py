#!/usr/bin/python3
"""launch_joy_node_realTurtlebot.launch: what drives the TurtleBot, and which view opens."""

import math
import os
from pathlib import Path

import rosbag
import rosgraph
import rosnode
import rospkg
import rospy
import yaml
from geometry_msgs.msg import Twist

from tutorial_testing.joystick_stream import AXIS, BUTTON, Stream
from tutorial_testing.nodes import node_path
from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import wait_for

FILE = "launch_joy_node_realTurtlebot.launch"
TELEOP = "/cmd_vel_mux/input/teleop"
BAG = Path(rospkg.RosPack().get_path("joy2twist"), "bag", "joy.bag")
SPEED = 0.35  # [m/s] at full deflection, config/f710_d.yaml
FORWARD = (AXIS, 1, -32767)  # Linux counts upwards as negative
LB = 4
PACKAGE = """
<package>
  <name>turtlebot_rviz_launchers</name><version>0.0.0</version><description>None</description>
  <maintainer email="nobody@example.org">Nobody</maintainer><license>None</license>
</package>
"""


class WorkstationTest(RosTest):
    def launch(self, *arguments):
        return self.start("roslaunch", "joy2twist", FILE, *arguments)

    def test_a_recording_drives_once_and_ends_the_launch(self):
        speeds = self.record(TELEOP, Twist)
        short = str(self.folder() / "short.bag")
        with rosbag.Bag(str(BAG)) as whole, rosbag.Bag(short, "w") as part:
            messages = [(joy, stamp) for _, joy, stamp in whole.read_messages()][:200]
            # At rest until all are connected: a later subscriber is held until the release.
            rest, began = messages[0]
            for k in range(200, 0, -1):
                part.write("/joy", rest, began - rospy.Duration(k / 50))
            for joy, stamp in messages:
                part.write("/joy", joy, stamp)
        asked = {SPEED * joy.axes[1] for joy, _ in messages if joy.buttons[LB]}
        launch = self.launch(f"bag:={short}", "rviz:=false")
        wait_for(lambda: len(speeds) > 10, "velocities")
        self.assertIn("/myjoystick2twist", rosnode.get_node_names())
        publishers, _, _ = rosgraph.Master("/test").getSystemState()
        self.assertNotIn("/cmd_vel", dict(publishers))
        self.check_end(launch)
        sent = [twist.linear.x for twist in speeds]
        self.assertEqual(sent[-1], 0.0)
        self.assertGreater(max(sent), 0.1)
        self.assertLessEqual(set(sent), asked | {0.0})
        self.assertIn("roslaunch: rosbag has finished, which ends this launch\n", launch.output)
        self.assertNotIn("died", launch.output)  # a normal end does not look like a crash
        self.assertIn("axis 1 -> linear.x", launch.output)
        self.assertNotIn("Get from Joy", launch.output)  # which would scroll that away

    def test_a_gamepad_drives_while_lb_is_held(self):
        speeds = self.record(TELEOP, Twist)
        gamepad = Stream()
        self.addCleanup(gamepad.remove)
        launch = self.launch(f"joy_dev:={gamepad.path}", "rviz:=false", "log_rate:=50")
        wait_for(lambda: gamepad.path in launch.output, "driver that looks for the gamepad")
        gamepad.plug_in()
        gamepad.send((BUTTON, LB, 0))
        wait_for(lambda: "Get from Joy" in launch.output, "joystick at rest, seen by joy2twist")
        gamepad.send((BUTTON, LB, 1), FORWARD)
        wait_for(lambda: speeds and speeds[-1].linear.x == SPEED, "velocity")
        gamepad.send((BUTTON, LB, 0))
        wait_for(lambda: speeds[-1] == Twist(), "zero")
        self.assertEqual({twist.linear.x for twist in speeds}, {0.0, SPEED})
        launch.interrupt()
        launch.wait()

    def test_whatever_the_preset_says_it_needs_a_dead_man_arms_and_has_the_limits_of_a_kobuki(self):
        dump = self.start("roslaunch", "--dump-params", "joy2twist", FILE, "joy_config:=extreme_3d")
        self.assertEqual(dump.wait(), 0, dump.output)
        given = yaml.safe_load(dump.output)
        prefix = "/myjoystick2twist/"
        for name, value in {
            "require_enable_button": True, "arm_on_neutral": True, "max_linear_speed": 0.7,
            "max_angular_speed": math.pi, "joy_timeout": 0.5, "vigilance_timeout": 3.0,
        }.items():  # fmt: skip
            self.assertEqual(given[prefix + name], value, name)

    def test_the_view_is_that_of_the_suite_of_a_turtlebot_if_installed_or_the_users(self):
        packages, folder = rospkg.RosPack(), self.folder()
        for program in ("rviz", "roslaunch"):  # in their place: it says what it was given
            (folder / program).write_text('#!/bin/sh\necho "$0" "$@"\n')
            (folder / program).chmod(0o755)
        launchers = folder / "turtlebot_rviz_launchers"
        launchers.mkdir()
        (launchers / "package.xml").write_text(PACKAGE)
        ours = os.environ["ROS_PACKAGE_PATH"]
        real, suite = f"{folder}:{ours}", packages.get_path("fake_turtlebot_sim")
        for config, path, command in (
            ("auto", ours, f"rviz -d {suite}/rviz/sim.rviz"),
            ("/my.rviz", real, "rviz -d /my.rviz"),
            ("auto", real, f"roslaunch {launchers}/launch/view_robot.launch"),
        ):
            given = {"PATH": f"{folder}:{os.environ['PATH']}", "ROS_PACKAGE_PATH": path}
            view = self.start(node_path("tutorial_tools", "view_robot"), config, **given)
            self.assertEqual((view.wait(), view.output), (0, f"{folder}/{command}\n"))


if __name__ == "__main__":
    run()
