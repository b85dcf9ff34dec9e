#!/usr/bin/python3
"""The handout's three programs, in our words: what they display and send, and how they end."""

from pathlib import Path

import rospkg
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy

from tutorial_testing.nodes import node_path
from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import wait_for

LONGEST_LINES = 45


class StepsTest(RosTest):
    """A step runs; this process is its joystick and its robot."""

    def setUp(self):
        self.velocities = []
        self.joystick = self.publisher("joy", Joy)
        self.robot = self.hear("cmd_vel", Twist, self.heard)

    def heard(self, twist):
        self.velocities.append((twist.linear.x, twist.angular.z))

    def send(self, *axes):
        self.joystick.publish(Joy(axes=axes))

    def display(self, step, name):
        """Start a step, and move the stick until it displays that."""
        node = self.start(node_path("joy2twist", step))
        line = "Get from Joy [0.25, 0.5"
        wait_for(lambda: self.send(0.25, 0.5, 0.125) or line in node.output, line)
        self.assertRegex(node.output, name)
        return node

    def stop(self, node):
        """Press Ctrl-C, and go on with the stick as it is until the node is gone."""
        node.interrupt()
        wait_for(lambda: self.send(0.25, 0.5, 0.125) or node.ended, "end")
        wait_for(lambda: self.robot.get_num_connections() == 0, "end of the connection")

    def test_step_1_displays_and_publishes_nothing(self):
        node = self.display("display_joy.py", r"/listener_\w+: Get")
        self.stop(node)
        self.assertNotIn("Traceback", node.output)
        self.assertEqual(self.velocities, [])

    def test_step_2_publishes_a_velocity_and_zero_for_too_few_axes(self):
        self.display("publish_twist.py", r"/\w+: Get")
        wait_for(lambda: self.send(0.25, 0.5) or self.velocities, "velocity")
        wait_for(lambda: self.send(1.0) or (0.0, 0.0) in self.velocities, "zero")
        self.assertEqual(set(self.velocities), {(0.5, 0.25), (0.0, 0.0)})

    def test_step_3_publishes_and_leaves_the_robot_standing(self):
        node = self.display("new_joy2twist.py", "/NewJoy2Twist: Get")
        wait_for(lambda: self.send(0.25, 0.5) or self.velocities, "velocity")
        self.stop(node)
        self.assertNotIn("Traceback", node.output)
        self.assertIn("Stopping the node", node.output)
        self.assertEqual(self.velocities[-1], (0.0, 0.0))
        stop = self.velocities.index((0.0, 0.0))
        # The callback that had started by then.
        self.assertLessEqual(self.velocities[stop:].count((0.5, 0.25)), 1)

    def test_each_is_read_at_a_glance(self):
        for step in Path(rospkg.RosPack().get_path("joy2twist"), "scripts/steps").glob("*.py"):
            self.assertLessEqual(step.read_text().count("\n"), LONGEST_LINES, step)


if __name__ == "__main__":
    run()
