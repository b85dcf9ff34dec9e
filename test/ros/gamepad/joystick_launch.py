#!/usr/bin/python3
"""launch_joy_node.launch: a script of moves drives a square."""

import math
import os

import rospkg

from joy_to_twist.safety import WAITING
from tutorial_testing.joystick_stream import LAUNCH, JoystickTest
from tutorial_testing.keys import DiagnosedRobot
from tutorial_testing.nodes import node_path
from tutorial_testing.rostests import run

SQUARE = ("config", "virtual_joystick", "square.yaml")  # in gamepad
CORNERS = [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.0, 0.0)]  # [m], in their order
NEAR_M, NEAR_RAD = 0.25, 0.3  # on a busy machine each move may be some hundredths of a second off
SCRIPT_S = 60.0  # more than it takes


class LaunchTest(JoystickTest):
    def test_the_script_of_the_square_is_driven(self):
        robot = self.enter(DiagnosedRobot())
        device = self.stream.path
        self.start(*LAUNCH, f"joy_dev:={device}")
        # The script begins with its reader, and the robot must be ready then.
        robot.wait_for_state(WAITING)
        path = os.path.join(rospkg.RosPack().get_path("gamepad"), *SQUARE)
        joystick = node_path("gamepad", "virtual_joystick")
        program = self.start(joystick, "--stream", device, "--script", path)
        self.assertEqual(program.wait(SCRIPT_S), 0, program.output)
        passed = iter(robot.odometry)
        for corner in CORNERS:
            near = any(math.dist((at.x, at.y), corner) < NEAR_M for at in passed)
            self.assertTrue(near, f"not near {corner} after those before")
        last = robot.now
        self.assertFalse(last.moves)
        self.assertLess(math.dist((last.x, last.y), CORNERS[-1]), NEAR_M)
        self.assertLess(abs(math.remainder(last.yaw, math.tau)), NEAR_RAD)


if __name__ == "__main__":
    run()
