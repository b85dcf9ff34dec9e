#!/usr/bin/python3
"""virtual_joystick through a FIFO: a script of moves and a recording arrive on /joy."""

import rosbag
import rospkg

from gamepad.gamepads import F710_D
from tutorial_testing.joystick_stream import JoystickTest
from tutorial_testing.nodes import node_path
from tutorial_testing.processes import Program
from tutorial_testing.rostests import run
from tutorial_testing.waiting import wait_for

SCRIPT = """
mode: X
moves:
  - {for: 0.5}
  - {for: 0.5, held: [LB], left_stick: [0.0, 1.0], triggers: [0.0, 1.0]}
  - {for: 1.5, plugged: false}
  - {for: 0.5, held: [RB]}
"""
FULL = 32767
JOYSTICK = (node_path("gamepad", "virtual_joystick"),)


class MovesTest(JoystickTest):
    def start_both(self, *arguments, deadzone=0.05):
        """virtual_joystick, and a driver that reads its FIFO."""
        program = self.start(*JOYSTICK, "--stream", self.stream.path, *arguments)
        self.start_driver(f"deadzone:={deadzone}")
        return program

    def write(self, text):
        path = self.folder() / "moves.yaml"
        path.write_text(text, encoding="utf-8")
        return str(path)

    def test_a_script_is_followed(self):
        program = self.start_both("--script", self.write(SCRIPT))
        self.assertEqual(program.wait(), 0, program.output)
        wait_for(lambda: self.last and not self.last[1], "neutral message at the end")
        states = []
        for joy in self.joys:
            axes = [round(axis, 6) for axis in joy.axes]  # a sign of life changes the last bit
            state = (axes[1], axes[5], [n for n, held in enumerate(joy.buttons) if held])
            if state not in states[-1:]:
                states.append(state)
        pushed = states.index((1.0, -1.0, [4]))  # stick up, RT pulled, LB held
        self.assertEqual(states[pushed + 1], (0.0, 1.0, []))  # unplugged: RT at rest
        self.assertIn([5], [held for _, _, held in states[pushed + 1 :]])

    def test_the_recording_arrives_in_the_steps_of_the_gamepad(self):
        path = f"{rospkg.RosPack().get_path('gamepad')}/bag/joy.bag"
        axis = F710_D.axes[1]
        with rosbag.Bag(path) as bag:
            steps = {-axis.js_value(axis.raw(joy.axes[1])) for _, joy, _ in bag.read_messages()}
        self.start_both("--bag", path, deadzone=0.0)
        wait_for(lambda: len({joy.axes[1] for joy in self.joys}) > 30, "moving stick")
        seen = {round(joy.axes[1] * FULL) for joy in self.joys}
        self.assertLessEqual(seen, steps)
        self.assertTrue(any(joy.buttons[4] for joy in self.joys))

    def test_mistakes_get_one_line(self):
        missing = str(self.folder() / "none")
        for line, option, content in (
            (f"_joystick: {missing}: cannot be read: No such file", "--bag", None),
            ("moves.yaml: it has no list of moves", "--script", "7"),
            ("is there and is no FIFO", "--stream", ""),
        ):
            path = missing if content is None else self.write(content)
            given = ("--stream", self.stream.path, option, path)
            self.check_mistake(Program(*JOYSTICK, *given), line)


if __name__ == "__main__":
    run()
