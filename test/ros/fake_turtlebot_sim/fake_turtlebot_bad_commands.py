#!/usr/bin/python3
"""Numbers that are none, or far too large, move nothing and are said once."""

import sys
import unittest
from math import inf, nan

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from fake_turtlebot_stepping import Robot, World, twist
from rosgraph_msgs.msg import Log

from tutorial_testing.nodes import init_node
from tutorial_testing.waiting import wait_for

BAD = [(nan, 0.0), (0.0, nan), (inf, 0.0), (0.0, -inf), (nan, inf)]


class BadCommandsTest(unittest.TestCase):
    def test_bad_commands(self):
        log, diagnostics = [], []
        rospy.Subscriber("/rosout", Log, log.append)
        rospy.Subscriber("/diagnostics", DiagnosticArray, diagnostics.append)
        robot = Robot()
        world = World([robot])
        start = robot.position()

        def rejected():
            world.step()
            values = [v for array in diagnostics for s in array.status for v in s.values]
            counts = [int(v.value) for v in values if v.key.startswith("commands rejected")]
            return counts[-1] if counts else 0

        for bad in BAD:
            # Not faster than they are read: the node keeps only the newest of a burst.
            before = rejected()
            robot.cmd_vel.publish(twist(*bad))
            wait_for(lambda before=before: rejected() > before, f"count of {bad}")
        self.assertEqual(robot.velocity(), (0.0, 0.0))
        self.assertEqual(robot.position(), start)
        self.assertEqual(len(self.warnings(log)), 1, self.warnings(log))
        self.assertIn("not a finite number", self.warnings(log)[0])

        # After all that it drives as ever, and 1e300 only up to what it can.
        world.command(robot, 1e300, 0.0, shown=(0.7, 0.0))
        world.step(1.0)
        self.assertAlmostEqual(robot.position().x - start.x, 0.42, delta=1e-9)
        world.command(robot, -1e300, 0.0, shown=(-0.7, 0.0))
        wait_for(lambda: len(self.warnings(log)) > 1, "warning about the limits")
        self.assertEqual(len(self.warnings(log)), 2, self.warnings(log))
        self.assertIn("scaled down", self.warnings(log)[1])

    @staticmethod
    def warnings(log):
        return [line.msg for line in log if line.level >= Log.WARN and "cmd_vel" in line.msg]

    def test_a_bad_command_does_not_keep_the_robot_going(self):
        robot = Robot()
        world = World([robot], start_ns=10**12)
        start = robot.position()
        world.command(robot, 0.5, 0.0)
        for _ in range(100):
            robot.cmd_vel.publish(twist(nan, 0.0))
            world.step()
        self.assertEqual(robot.velocity(), (0.0, 0.0))
        self.assertAlmostEqual(robot.position().x - start.x, 0.3, delta=1e-9)


if __name__ == "__main__":
    init_node("fake_turtlebot_bad_commands")
    rostest.rosrun("ros1_tutorial_test", "fake_turtlebot_bad_commands", BadCommandsTest, sys.argv)
