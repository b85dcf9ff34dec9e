#!/usr/bin/python3
"""launch_joy_node_realTurtlebot.launch: what drives the TurtleBot, and which view opens."""

import os
from pathlib import Path

import rosbag
import rosgraph
import rosnode
import rospkg
import rospy
from geometry_msgs.msg import Twist

from node_kit.questions import holder
from tutorial_testing.joystick_stream import AXIS, BUTTON, Stream
from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import wait_for

TELEOP = "/cmd_vel_mux/input/teleop"
BAG = Path(rospkg.RosPack().get_path("joy2twist"), "bag", "joy.bag")
SPEED = 0.35  # [m/s] at full deflection, config/f710_d.yaml
FULL = 32767
FORWARD = (AXIS, 1, -FULL)  # Linux counts upwards as negative
LB = 4
PACKAGE = """
<package>
  <name>turtlebot_rviz_launchers</name><version>0.0.0</version><description>None</description>
  <maintainer email="nobody@example.org">Nobody</maintainer><license>None</license>
</package>
"""
VIEW = '<launch><param name="/view_of_the_turtlebot" value="open"/></launch>'


class WorkstationTest(RosTest):
    def setUp(self):
        self.speeds = []
        self.hear(TELEOP, Twist, lambda twist: self.speeds.append(twist.linear.x))

    def launch(self, *arguments, **environment):
        file = ("joy2twist", "launch_joy_node_realTurtlebot.launch")
        launch = self.start("roslaunch", *file, *arguments, **environment)
        self.addCleanup(self.interrupt, launch)
        return launch

    def interrupt(self, launch):
        if not launch.ended:
            launch.interrupt()
        launch.wait()  # its nodes are no longer registered

    def test_a_recording_drives_once_and_ends_the_launch(self):
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
        wait_for(lambda: len(self.speeds) > 10, "velocities")
        self.assertIn("/myjoystick2twist", rosnode.get_node_names())
        # A driver of a test before may still be registered, on a machine too busy for its goodbye.
        self.assertIsNone(holder(rosgraph.get_master_uri(), "/joy_node"))
        publishers, _, _ = rosgraph.Master("/test").getSystemState()
        self.assertNotIn("/cmd_vel", dict(publishers))
        self.assertEqual(launch.wait(), 0, launch.output)
        self.assertEqual(self.speeds[-1], 0.0)
        self.assertGreater(max(self.speeds), 0.1)
        self.assertLessEqual(set(self.speeds), asked | {0.0})
        self.assertIn("roslaunch: rosbag has finished, which ends this launch\n", launch.output)
        for word in ("Traceback", "died"):  # a normal end does not look like a crash
            self.assertNotIn(word, launch.output)
        self.assertIn("axis 1 -> linear.x", launch.output)
        self.assertNotIn("Get from Joy", launch.output)  # which would scroll that away

    def test_a_gamepad_drives(self):
        gamepad = Stream()
        self.addCleanup(gamepad.remove)
        launch = self.launch(f"joy_dev:={gamepad.path}", "rviz:=false", "log_rate:=50")
        wait_for(lambda: gamepad.path in launch.output, "driver that looks for the gamepad")
        gamepad.plug_in()
        gamepad.send((BUTTON, LB, 0))
        wait_for(lambda: "Get from Joy" in launch.output, "joystick at rest, seen by joy2twist")
        gamepad.send((BUTTON, LB, 1), FORWARD)
        wait_for(lambda: self.speeds and self.speeds[-1] == SPEED, "velocity")
        gamepad.send((BUTTON, LB, 0))
        wait_for(lambda: self.speeds[-1] == 0.0, "zero")
        self.assertEqual(set(self.speeds), {0.0, SPEED})

    def test_the_view_of_the_suite_opens_or_the_one_that_the_user_names(self):
        folder = self.folder()
        rviz, given = folder / "rviz", folder / "given"  # writes down its arguments
        rviz.write_text(f'#!/bin/sh\necho "$@" > {given}.new; mv {given}.new {given}; sleep 600\n')
        rviz.chmod(0o755)
        for arguments, file in (
            ([], f"{rospkg.RosPack().get_path('fake_turtlebot_sim')}/rviz/sim.rviz"),
            (["rviz_config:=/my.rviz"], "/my.rviz"),
        ):
            path = f"{folder}:{os.environ['PATH']}"
            launch = self.launch("rviz:=true", "cockpit:=false", *arguments, PATH=path)
            wait_for(lambda: given.exists() or launch.ended, "view")  # noqa: B023
            words = given.read_text().split()
            self.assertEqual(words[:2], ["-d", file])
            self.assertIn("__name:=my_rviz", words)
            self.interrupt(launch)
            given.unlink()

    def test_the_view_of_the_turtlebot_opens_where_it_is_installed(self):
        folder = self.folder()
        package = folder / "turtlebot_rviz_launchers"
        (package / "launch").mkdir(parents=True)
        (package / "package.xml").write_text(PACKAGE)
        (package / "launch" / "view_robot.launch").write_text(VIEW)
        path = f"{folder}:{os.environ['ROS_PACKAGE_PATH']}"
        self.launch("rviz:=true", ROS_PACKAGE_PATH=path)
        wait_for(lambda: rospy.has_param("/view_of_the_turtlebot"), "view")


if __name__ == "__main__":
    run()
