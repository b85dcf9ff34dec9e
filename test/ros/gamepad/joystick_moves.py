#!/usr/bin/python3
"""virtual_joystick through a FIFO: a script of moves and a recording arrive on /joy."""

import sys
import tempfile
import unittest
from pathlib import Path

import rosbag
import rospkg
import rostest

from gamepad.gamepads import F710_D
from tutorial_testing.joystick_stream import JoyLog, driver
from tutorial_testing.nodes import init_node, node_path
from tutorial_testing.processes import Program
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


class MovesTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.device = str(self.folder / "js0")
        self.log = JoyLog()
        self.addCleanup(self.log.stop)

    def start(self, *arguments, deadzone=0.05):
        """virtual_joystick, and a driver that reads its FIFO."""
        program = Program(*JOYSTICK, "--stream", self.device, *arguments)
        self.addCleanup(program.__exit__)
        self.addCleanup(driver(self.device, f"deadzone:={deadzone}").__exit__)
        return program

    def write(self, text):
        path = self.folder / "moves.yaml"
        path.write_text(text, encoding="utf-8")
        return str(path)

    def test_a_script_is_followed(self):
        program = self.start("--script", self.write(SCRIPT))
        self.assertEqual(program.wait(), 0, program.output)
        wait_for(lambda: self.log.last and not self.log.last[1], "neutral message at the end")
        states = []
        for joy in self.log.messages:
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
        self.start("--bag", path, deadzone=0.0)
        wait_for(lambda: len({joy.axes[1] for joy in self.log.messages}) > 30, "moving stick")
        seen = {round(joy.axes[1] * FULL) for joy in self.log.messages}
        self.assertLessEqual(seen, steps)
        self.assertTrue(any(joy.buttons[4] for joy in self.log.messages))

    def test_mistakes_get_one_line(self):
        stream, missing = ("--stream", self.device), str(self.folder / "none")
        for line, option, content in (
            (f"cannot read {missing}: No such file", "--script", None),
            (f"cannot read {missing}: No such file", "--bag", None),
            ("moves.yaml: it has no list of moves", "--script", "7"),
            ("moves.yaml: while ", "--script", "moves: ]\n\t@"),
            ("moves.yaml: ", "--bag", "no bag"),
            ("is there and is no FIFO", "--stream", ""),
        ):
            path = missing if content is None else self.write(content)
            with Program(*JOYSTICK, *stream, option, path) as program:
                self.assertEqual(program.wait(), 1)
                self.assertIn(line, program.output)
                self.assertEqual(program.output.count("\n"), 1, program.output)


if __name__ == "__main__":
    init_node("joystick_moves_test")
    rostest.rosrun("ros1_tutorial_test", "joystick_moves", MovesTest, sys.argv)
