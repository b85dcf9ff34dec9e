#!/usr/bin/python3
"""The handout's three programs, in our words: what they display and send, and how they end."""

import re

import rospkg
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy

from tutorial_testing.nodes import node_path
from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import wait_for

LONGEST_LINES = 45
# What rospy raises in a callback that publishes while, or after, the topic is closed; in the first
# case it reports a closed file above it, too.
TOO_LATE = r"ROSException: (?:topic was closed during publish\(\)|publish\(\) to a closed topic)"
ABOVE = "During handling of the above exception"


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

    def display(self, step):
        """Start a step, and move the stick until it displays that."""
        node = self.start(node_path("joy2twist", step))
        wait_for(lambda: self.send(0.25, 0.5, 0.125) or "0.25, 0.5" in node.output, "line")
        return node

    def stop(self, node, may_publish_too_late=False):
        """Press Ctrl-C, and go on with the stick as it is until the node is gone."""
        node.interrupt()
        wait_for(lambda: self.send(0.25, 0.5, 0.125) or node.ended, "end")
        wait_for(lambda: self.robot.get_num_connections() == 0, "end of the connection")
        refused = len(re.findall(TOO_LATE, node.output))
        tracebacks = node.output.count("Traceback") - node.output.count(ABOVE)
        self.assertEqual(tracebacks, refused if may_publish_too_late else 0, node.output)

    def test_step_1_displays(self):
        node = self.display("display_joy.py")
        self.assertRegex(node.output, r"/listener_\w+: Get from Joy \[0\.25, 0\.50, 0\.12\]")
        self.stop(node)
        self.assertEqual(self.velocities, [])

    def check_velocities(self):
        wait_for(lambda: self.send(0.25, 0.5) or self.velocities, "velocity")
        self.assertEqual(set(self.velocities), {(0.5, 0.25)})

    def test_step_2_publishes(self):
        node = self.display("publish_twist.py")
        self.check_velocities()
        wait_for(lambda: self.send(1.0) or (0.0, 0.0) in self.velocities, "zero for too few axes")
        # rospy closes the topic while the callback goes on, which is what step 3 is about.
        self.stop(node, may_publish_too_late=True)

    def test_step_3_publishes_and_leaves_the_robot_standing(self):
        node = self.display("new_joy2twist.py")
        self.assertIn("/NewJoy2Twist: Get from Joy", node.output)
        self.check_velocities()
        self.stop(node)
        self.assertIn("Stopping the node", node.output)
        self.assertEqual(self.velocities[-1], (0.0, 0.0))
        stop = self.velocities.index((0.0, 0.0))
        # The callback that had begun by then.
        self.assertLessEqual(self.velocities[stop:].count((0.5, 0.25)), 1)

    def test_each_is_read_at_a_glance(self):
        folder = f"{rospkg.RosPack().get_path('joy2twist')}/scripts/steps"
        for step in ("display_joy.py", "publish_twist.py", "new_joy2twist.py"):
            with open(f"{folder}/{step}") as source:
                self.assertLessEqual(len(source.readlines()), LONGEST_LINES, step)


if __name__ == "__main__":
    run()
