"""launch_joy_node_realTurtlebot.launch: what drives the TurtleBot, and which view opens."""

import os

import rosgraph
import rosnode
import rospkg
from geometry_msgs.msg import Twist

from tutorial_testing.hands import record
from tutorial_testing.nodes import node_path
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import wait_for

FILE = "launch_joy_node_realTurtlebot.launch"
TELEOP = "/cmd_vel_mux/input/teleop"
SPEED = 0.35  # [m/s] at full deflection, config/f710_d.yaml
PACKAGE = """<package>
  <name>turtlebot_rviz_launchers</name><version>0.0.0</version><description>None</description>
  <maintainer email="nobody@example.org">Nobody</maintainer><license>None</license>
</package>"""


class WorkstationTest(RosTest):
    def test_a_recording_drives_once_and_ends_the_launch(self):
        speeds = self.record(TELEOP, Twist)
        path = record(str(self.folder() / "short.bag"))
        launch = self.start("roslaunch", "joy2twist", FILE, f"bag:={path}", "rviz:=false")
        wait_for(lambda: speeds and speeds[-1].linear.x, "velocities")
        self.assertIn("/myjoystick2twist", rosnode.get_node_names())
        publishers, _, _ = rosgraph.Master("/test").getSystemState()
        self.assertNotIn("/cmd_vel", dict(publishers))
        self.check_end(launch)
        self.assertEqual({twist.linear.x for twist in speeds}, {0.0, SPEED})
        self.assertEqual(speeds[-1], Twist())
        self.assertIn("roslaunch: rosbag has finished, which ends this launch\n", launch.output)
        self.assertNotIn("died", launch.output)  # a normal end does not look like a crash
        self.assertIn("axis 1 -> linear.x", launch.output)
        self.assertNotIn("Get from Joy", launch.output)  # which would scroll that away

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
