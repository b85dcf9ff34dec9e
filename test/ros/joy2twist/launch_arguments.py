#!/usr/bin/python3
"""Arguments of the launch files: a mistake gets a line before a node starts, and nothing stays."""

from pathlib import Path

import rosgraph
import rosnode
import rospkg
import rospy
import yaml
from sensor_msgs.msg import Joy

from node_kit.questions import address
from tutorial_testing.ports import free_port
from tutorial_testing.processes import Program
from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import wait_for

BAGS = Path(rospkg.RosPack().get_path("joy2twist")) / "bag"


def roslaunch(*arguments, package="joy2twist"):
    return Program("roslaunch", package, *arguments)


def known():
    """Names of the nodes that the master knows."""
    return set(rosnode.get_node_names())


class ArgumentsTest(RosTest):
    def refused(self, package, file, argument, line):
        """A launch says a line, exits, and has started nothing."""
        before = known()
        with Program("roslaunch", package, *file.split(), argument) as launch:
            self.assertNotEqual(launch.wait(), 0, launch.output)
            self.assertIn(f"roslaunch: {argument}: {line}", launch.output.splitlines())
            self.assertNotIn("process[", launch.output)
        self.assertEqual(known(), before)

    def test_a_mistake(self):
        """Each launch file checks its arguments; which ones are allowed is for a unit test."""
        must, missing = "must be true or false", "cannot be read: No such file or directory"
        not_a_name = (
            "must be a letter followed by letters, digits and underscores; did you mean robot_7?"
        )
        no_name = "is missing: which robot of the classroom, such as name:=robot_7"
        for file, argument, line in (
            ("launch_bag.launch", "rviz:=yes", must),
            ("launch_bag.launch", "bag:=/no/joy.bag", missing),
            ("launch_joy_node.launch", "virtual:=yes", must),
            ("launch_joy_node.launch", "rviz:=yes", must),
            ("launch_joy_node_realTurtlebot.launch", "virtual:=yes", must),
            ("launch_joy_node_realTurtlebot.launch", "rviz:=yes", must),
            ("student.launch name:=ada", "loop:=no", must),
            ("student.launch name:=ada", "bag:=/no/joy.bag", missing),
            ("student.launch", "name:=", no_name),
            ("student.launch virtual:=true", "name:=7", not_a_name),
        ):
            self.refused("joy2twist", file, argument, line)
        self.refused("cockpit", "classroom.launch", "lan:=yes", must)

    def test_what_changes_nothing_is_reported_once_and_drives(self):
        given = ("base:=create", "stacks:=hexagons", "wrold:=room")
        with roslaunch("minimal.launch", *given, package="turtlebot_bringup") as launch:
            wait_for(lambda: "/mobile_base" in known(), "robot")
            said = [line for line in launch.output.splitlines() if line.startswith("roslaunch: ")]
            launch.interrupt()
            launch.wait()
        ignored, unknown = said
        self.assertIn("roslaunch: base:=create is ignored", ignored)
        self.assertIn("wrold:=room: not an argument of minimal.launch", unknown)
        self.assertIn("did you mean world:=?", unknown)

    def played(self, command, topic):
        """A launch plays a recording, by a path from the folder in which the user is."""
        came = self.record(topic, Joy)
        with Program("bash", "-c", f"cd '{BAGS}' && exec roslaunch joy2twist {command}") as launch:
            wait_for(lambda: came or launch.ended, "message")
            self.assertFalse(launch.ended, launch.output)
            launch.interrupt()
            launch.wait()

    def test_a_recording_by_a_relative_path(self):
        self.played("launch_bag.launch rviz:=false cockpit:=false bag:=joy.bag", "/joy")
        self.played("student.launch rviz:=false name:=ada bag:=../bag/joy.bag", "/ada/joy")

    def test_the_joystick_leaves_no_parameter_behind(self):
        """A joy_node started by hand after virtual:=true would wait for the FIFO."""
        with roslaunch("--dump-params", "launch_joy_node.launch", "virtual:=true") as dump:
            self.assertEqual(dump.wait(), 0, dump.output)
            given = yaml.safe_load(dump.output)
        self.assertIn("/myjoystick2twist/enable_button", given)
        self.assertEqual([name for name in given if name.startswith("/joy_node/")], [])
        with roslaunch(
            "--args", "/joy_node", "launch_joy_node.launch", "joy_dev:=/tmp/a b"
        ) as shown:
            self.assertEqual(shown.wait(), 0, shown.output)
            self.assertIn("_dev:=/tmp/a b _autorepeat_rate:=20 ", shown.output)

    def test_the_recording_is_not_driven_with_parameters_of_an_earlier_launch(self):
        rospy.set_param("/myjoystick2twist/enable_button", 4)
        master = rosgraph.Master("/test")
        with roslaunch("launch_bag.launch", "rviz:=false", "cockpit:=false") as launch:
            wait_for(lambda: "/myjoystick2twist" in known(), "joy2twist")
            self.assertFalse(master.hasParam("/myjoystick2twist/enable_button"))
            launch.interrupt()
            launch.wait()

    def test_a_classroom_without_a_screen_and_a_student_beside_it_share_one_page(self):
        port = f"cockpit_port:={free_port()}"
        with roslaunch(
            "classroom.launch", "robots:=0", "cockpit:=false", package="cockpit"
        ) as none:
            none.wait()
            self.assertIn("~robots: 0: must be a number from 1 to 1000", none.output)
        student = ("student.launch", "name:=robot_1", "joystick:=browser", "rviz:=false", port)
        with roslaunch("classroom.launch", "lan:=true", port, package="cockpit") as classroom:
            wait_for(lambda: address(rosgraph.get_master_uri()), "page of the classroom")
            for line in ("cockpit: to look:  http://", "cockpit: to drive: http://"):
                self.assertIn(line, classroom.output)
            with roslaunch(*student) as launch:
                wait_for(lambda: "finished cleanly" in launch.output, "end of its cockpit")
                page = address(rosgraph.get_master_uri())
                self.assertIn(
                    f"cockpit: a cockpit is already running: open {page} on", launch.output
                )
                self.assertNotIn("died", launch.output)
                launch.interrupt()
                launch.wait()
            classroom.interrupt()
            classroom.wait()


if __name__ == "__main__":
    run()
