#!/usr/bin/python3
"""Simulated time that pauses, jumps and is set back, as a bag played in a loop does to it."""

from math import hypot

from fake_turtlebot_stepping import SteppedRobot

from tutorial_testing.rostests import RosTest, run

SPEED = 0.7  # [m/s]
COAST = SPEED * 0.6  # [m] the farthest that a jump may carry the robot
TEN_SECONDS_NS = 10 * 10**9


class ClockTest(RosTest):
    def setUp(self):
        """Get the robot going at full speed."""
        self.robot = self.enter(SteppedRobot())
        self.robot.command(SPEED, 0.0)
        self.before = self.robot.now

    def assert_travelled(self, before, least, most):
        way = hypot(self.robot.now.x - before.x, self.robot.now.y - before.y)
        self.assertTrue(least - 1e-9 <= way <= most + 1e-9, way)

    def test_after_a_jump_forwards_it_coasts_for_the_timeout_at_most(self):
        self.robot.set_clock(self.robot.now_ns + 4 * TEN_SECONDS_NS)
        self.assert_travelled(self.before, 0.0, COAST)
        self.assertFalse(self.robot.now.moves)

    def test_set_back_it_keeps_its_pose_and_its_command_keeps_its_age(self):
        for _ in range(3):
            at = self.robot.now
            self.robot.set_clock(self.robot.now_ns - TEN_SECONDS_NS)  # answers with that very stamp
            self.assert_travelled(at, 0.0, 0.0)
            self.robot.step(0.1)  # each period is published again
            self.assert_travelled(at, SPEED * 0.1, SPEED * 0.1)
        self.robot.step(1.0)
        self.assert_travelled(self.before, 0.0, COAST)
        self.assertFalse(self.robot.now.moves)


if __name__ == "__main__":
    run()
