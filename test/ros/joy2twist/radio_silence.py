#!/usr/bin/python3
"""launch_joy_node.launch with a gamepad that falls silent; what trembles is for unit tests."""

import time

from tutorial_testing.joystick_stream import AXIS, BUTTON, LAUNCH, JoystickTest
from tutorial_testing.robot import Robot
from tutorial_testing.rostests import run
from tutorial_testing.waiting import wait_for

VIGILANCE_S = 3.0  # of the launch file
LIMIT_S = VIGILANCE_S + 0.6 + 0.02  # the base's own timeout, and one period of its odometry
FULL, LB, FORWARD = 32767, 4, 1


class RadioSilenceTest(JoystickTest):
    def setUp(self):
        super().setUp()
        self.robot = self.enter(Robot())
        self.launch = self.start(*LAUNCH, f"joy_dev:={self.stream.path}")
        self.robot.wait_for_rest()

    def show(self, held, forward):
        """Move the hand, and wait until joy_node has published it; when it was moved [s]."""
        seen, now = len(self.joys), time.time()
        self.stream.send((BUTTON, LB, int(held)), (AXIS, FORWARD, -forward))
        wait_for(lambda: len(self.joys) > seen + 1, "messages of joy_node")
        return now

    def drive(self):
        """Release everything, then hold LB and the stick until the robot moves; since when [s]."""

        def hold():
            self.show(False, 0)
            return self.show(True, FULL)

        return self.robot.drive_by(hold, try_s=2.0)

    def test_out_of_reach_it_stops_and_back_in_reach_it_waits_for_the_release(self):
        self.stream.plug_in()
        for _ in range(3):  # again on a machine that was late
            moved = self.drive()
            silence_s = self.robot.wait_for_rest() - moved
            if silence_s < LIMIT_S:
                break
        self.assertTrue(VIGILANCE_S - 0.5 < silence_s < LIMIT_S, silence_s)
        wait_for(lambda: "stops in 0.5 s" in self.launch.output, "warning")

        stood = self.robot.now.stamp
        for forward in (FULL, FULL // 2, FULL):  # back in reach, LB and the stick still held
            self.show(True, forward)
        self.assertTrue(self.robot.stays_at_rest())
        self.assertFalse(any(moment.moves for moment in self.robot.since(stood)))
        self.drive()


if __name__ == "__main__":
    run()
