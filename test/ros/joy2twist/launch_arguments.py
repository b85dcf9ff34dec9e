#!/usr/bin/python3
"""Arguments of the launch files: a mistake gets a line before a node starts, and nothing stays."""

from pathlib import Path

import rosgraph
import rosnode
import rospkg
import rospy
import yaml
from sensor_msgs.msg import Joy

from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import wait_for

BAGS = Path(rospkg.RosPack().get_path("joy2twist")) / "bag"
NO_SCREEN = ("rviz:=false", "cockpit:=false")


def known():
    """Names of the nodes that the master knows."""
    return set(rosnode.get_node_names())


class ArgumentsTest(RosTest):
    def test_each_launch_file_refuses_a_mistake_before_it_starts_a_node(self):
        """Which values are allowed is for a unit test."""
        before, must = known(), "must be true or false"
        for package, file, argument, line in (
            ("cockpit", "classroom.launch", "lan:=yes", must),
            ("joy2twist", "launch_bag.launch", "rviz:=yes", must),
            ("joy2twist", "launch_joy_node.launch", "virtual:=yes", must),
            ("joy2twist", "launch_joy_node_realTurtlebot.launch", "virtual:=yes", must),
            ("joy2twist", "student.launch", "name:=", "is missing: which robot of the classroom"),
            ("joy2twist", "student.launch name:=ada", "bag:=/no/joy.bag", "cannot be read"),
        ):
            launch = self.start("roslaunch", package, *file.split(), argument)
            self.assertNotEqual(launch.wait(), 0, launch.output)
            self.assertIn(f"roslaunch: {argument}: {line}", launch.output)
            self.assertNotIn("process[", launch.output)
        self.assertEqual(known(), before)

    def test_a_recording_by_a_relative_path_without_parameters_of_an_earlier_launch(self):
        rospy.set_param("/myjoystick2twist/enable_button", 4)
        came = self.record("/joy", Joy)
        command = "launch_bag.launch bag:=../bag/joy.bag " + " ".join(NO_SCREEN)
        launch = self.start("sh", "-c", f"cd '{BAGS}' && exec roslaunch joy2twist {command}")
        wait_for(lambda: came or launch.ended, "message")
        self.assertFalse(launch.ended, launch.output)
        self.assertFalse(rosgraph.Master("/test").hasParam("/myjoystick2twist/enable_button"))
        launch.interrupt()
        launch.wait()

    def read(self, option, *arguments):
        """Return what roslaunch prints of launch_joy_node.launch without starting it."""
        launch = self.start("roslaunch", option, "joy2twist", "launch_joy_node.launch", *arguments)
        self.assertEqual(launch.wait(), 0, launch.output)
        return launch.output

    def test_the_joystick_leaves_no_parameter_behind(self):
        """A joy_node started by hand after virtual:=true would wait for the FIFO."""
        given = yaml.safe_load(self.read("--dump-params", "virtual:=true"))
        self.assertIn("/myjoystick2twist/enable_button", given)
        self.assertEqual([name for name in given if name.startswith("/joy_node/")], [])

    def test_joy_pkg_is_the_package_whose_node_reads_the_device(self):
        shown = self.read("--args=/joy_node", "joy_pkg:=joy", "joy_dev:=/tmp/a b")
        self.assertIn("/joy/joy_node _dev:=/tmp/a b _autorepeat_rate:=20 ", shown)


if __name__ == "__main__":
    run()
