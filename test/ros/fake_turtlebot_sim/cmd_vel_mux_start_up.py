#!/usr/bin/python3
"""The mux's beginning and end: mistakes are one clear line, Ctrl-C leaves a standing robot."""

import contextlib
import sys
import tempfile
import unittest

import rospy
import rostest
from geometry_msgs.msg import Twist

from tutorial_testing.nodes import init_node, node_path
from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for

NODE = (node_path("fake_turtlebot_sim", "cmd_vel_mux.py"),)


def run(*arguments, **environment):
    """Run the node until it ends by itself; return (exit code, what it said)."""
    with Program(*NODE, *arguments, **environment) as node:
        return node.wait(), node.output.strip()


class StartUpTest(unittest.TestCase):
    def assert_one_clear_line(self, result, part):
        code, said = result
        self.assertEqual(code, 1, said)
        self.assertEqual(len(said.splitlines()), 1, said)
        self.assertIn(part, said)

    def test_mistakes_in_the_file(self):
        with contextlib.ExitStack() as all_at_once:
            nodes = {}
            for number, mistake in enumerate(rospy.get_param("~mistakes")):
                says = mistake.pop("says")
                rospy.set_param(f"/mistake_{number}", mistake)
                node = Program(*NODE, f"__name:=mistake_{number}")
                nodes[says] = all_at_once.enter_context(node)
            for says, node in nodes.items():
                self.assert_one_clear_line((node.wait(), node.output.strip()), says)

    def test_no_file(self):
        self.assert_one_clear_line(run("__name:=no_file"), "~subscribers: missing")

    def test_a_mistake_in_mux_config_ends_minimal_launch(self):
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
            file.write("subscribers: []")
            file.flush()
            launch = ("roslaunch", "fake_turtlebot_sim", "minimal.launch")
            with Program(*launch, f"mux_config:={file.name}") as program:
                program.wait()
                self.assertIn("~subscribers: []", program.output)

    def test_no_master(self):
        # The discard port of this machine: nobody listens there.
        result = run(ROS_MASTER_URI="http://localhost:9")
        self.assert_one_clear_line(result, "cmd_vel_mux: no ROS master at http://localhost:9")

    def test_ctrl_c_in_the_middle_of_a_motion_leaves_the_robot_standing(self):
        driven, command = [], Twist()
        command.linear.x = 0.2
        teleop = {"name": "teleop", "topic": "input", "timeout": 60.0, "priority": 1}
        rospy.set_param("/ctrl_c/subscribers", [teleop])
        rospy.Subscriber("/ctrl_c/output", Twist, lambda twist: driven.append(twist.linear.x))
        publisher = rospy.Publisher("/ctrl_c/input", Twist, queue_size=1)
        with Program(*NODE, "__name:=ctrl_c") as node:
            wait_for(lambda: publisher.publish(command) or driven, "a command that goes through")
            node.interrupt()
            code, said = node.wait(), node.output
        self.assertEqual(code, 0, said)
        self.assertEqual(said.strip(), "")
        wait_for(lambda: driven[-1] == 0.0, "last zero")


if __name__ == "__main__":
    init_node("cmd_vel_mux_start_up")
    rostest.rosrun("ros1_tutorial_test", "cmd_vel_mux_start_up", StartUpTest, sys.argv)
