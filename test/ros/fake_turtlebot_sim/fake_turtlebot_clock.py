#!/usr/bin/python3
"""Simulated time that pauses, jumps and is set back, as a bag played in a loop does to it."""

from math import hypot, isfinite

import rospy
from fake_turtlebot_stepping import CommandedRobot, World, twist
from rosgraph_msgs.msg import Log

from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import wait_for

SPEED = 0.7  # [m/s]
COAST = SPEED * 0.6  # [m] the farthest that a jump may carry the robot
TEN_SECONDS_NS = 10 * 10**9


class ClockTest(RosTest):
    @classmethod
    def setUpClass(cls):
        cls.robot = CommandedRobot().__enter__()
        cls.log = []
        rospy.Subscriber("/rosout", Log, cls.log.append)
        # As a simulator does that starts together with the node: time begins at zero.
        cls.world = World([cls.robot], start_ns=0)

    def drive(self):
        """Get the robot going at full speed and return where it is."""
        self.robot.cmd_vel.publish(twist(SPEED, 0.0))
        wait_for(lambda: self.world.step() or self.robot.now.v == SPEED, "moving robot")
        return self.robot.now

    def assert_travelled(self, before, least, most):
        after = self.robot.now
        self.assertTrue(isfinite(after.x) and isfinite(after.y))
        self.assertGreaterEqual(hypot(after.x - before.x, after.y - before.y), least - 1e-9)
        self.assertLessEqual(hypot(after.x - before.x, after.y - before.y), most + 1e-9)

    def test_a_jump_forwards_and_set_back_again_and_again(self):
        before = self.drive()
        self.world.set_clock(self.world.now_ns + 4 * TEN_SECONDS_NS)
        self.assert_travelled(before, 0.0, COAST)
        self.assertEqual(self.robot.now.velocity, (0.0, 0.0))
        before = self.drive()
        for _ in range(3):
            at = self.robot.now
            self.world.set_clock(self.world.now_ns - TEN_SECONDS_NS)  # answers with that very stamp
            self.assert_travelled(at, 0.0, 0.0)
            self.world.step(0.1)  # each period is published again
            self.assert_travelled(at, SPEED * 0.1, SPEED * 0.1)
        self.world.step(1.0)
        self.assert_travelled(before, 0.0, COAST)
        self.assertEqual(self.robot.now.velocity, (0.0, 0.0))

    def test_a_clock_at_zero_is_no_time(self):
        before = self.drive()
        self.world.now_ns = 0
        self.world.tell()  # zero is ROS's "no time": nothing is to be published with it
        self.world.step(1.0)
        self.assert_travelled(before, 0.0, COAST)
        self.assertTrue(all(moment.stamp for moment in self.robot.odometry))

    def test_a_pause_pauses_the_robot(self):
        before, count = self.drive(), len(self.robot.odometry)
        for _ in range(5):  # /clock goes on telling the same time
            self.world.tell()
        self.world.step()
        self.assertEqual(len(self.robot.odometry), count + 1)
        self.assert_travelled(before, SPEED * 0.02, SPEED * 0.02)

    def tearDown(self):
        self.assertEqual([line.msg for line in self.log if line.level >= Log.WARN], [])


if __name__ == "__main__":
    run()
