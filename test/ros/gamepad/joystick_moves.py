#!/usr/bin/python3
"""virtual_joystick through a FIFO: a recording arrives on /joy as it was made."""

import rosbag
import rospkg

from gamepad.gamepads import F710_D
from tutorial_testing.joystick_stream import JoystickTest
from tutorial_testing.nodes import node_path
from tutorial_testing.processes import Program
from tutorial_testing.rostests import run
from tutorial_testing.waiting import wait_for

FULL = 32767
JOYSTICK = (node_path("gamepad", "virtual_joystick"),)


class MovesTest(JoystickTest):
    def test_the_recording_arrives_in_the_steps_of_the_gamepad(self):
        path = f"{rospkg.RosPack().get_path('gamepad')}/bag/joy.bag"
        axis = F710_D.axes[1]
        with rosbag.Bag(path) as bag:
            steps = {-axis.js_value(axis.raw(joy.axes[1])) for _, joy, _ in bag.read_messages()}
        self.start(*JOYSTICK, "--stream", self.stream.path, "--bag", path)
        self.start_driver("deadzone:=0.0")
        wait_for(lambda: len({joy.axes[1] for joy in self.joys}) > 30, "moving stick")
        seen = {round(joy.axes[1] * FULL) for joy in self.joys}
        self.assertLessEqual(seen, steps)
        self.assertTrue(any(joy.buttons[4] for joy in self.joys))

    def test_mistakes_get_one_line(self):
        script = self.folder() / "moves.yaml"
        script.write_text("7", encoding="utf-8")
        for line, *given in (
            ("_joystick: /no/joy.bag: cannot be read: No such file", "--bag", "/no/joy.bag"),
            ("moves.yaml: it has no list of moves", "--script", str(script)),
            ("is there and is no FIFO", "--stream", str(script)),
        ):
            self.check_mistake(Program(*JOYSTICK, "--stream", self.stream.path, *given), line)


if __name__ == "__main__":
    run()
