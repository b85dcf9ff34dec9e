#!/usr/bin/python3
"""joy_node over a FIFO: what it publishes of events, recordings and scripts, and at what cost."""

import math
import os
import re
import time
from pathlib import Path

import rosbag
import rospkg

from gamepad.driver.driver import SHORTEST_SILENCE_S
from gamepad.gamepads import F710_D
from gamepad.js_event import AXIS, BUTTON, FULL, INIT
from joy_to_twist.safety import WAITING
from tutorial_testing.joystick_stream import AXES, BUTTONS, LAUNCH, JoystickTest
from tutorial_testing.keys import DiagnosedRobot
from tutorial_testing.nodes import node_path
from tutorial_testing.processes import Program
from tutorial_testing.rostests import run
from tutorial_testing.waiting import BUSY_S, Stopwatch, wait_for

PACKAGE = Path(rospkg.RosPack().get_path("gamepad"))
VIRTUAL = node_path("gamepad", "virtual_joystick")
STILL_S = 5.0
WAKINGS_A_SECOND = 50  # half of them to ask whether to end; measured: 26
CORNERS = [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.0, 0.0)]  # [m], in their order
NEAR_M = 0.25  # on a busy machine each move may be some hundredths of a second off


class DriverTest(JoystickTest):
    def start_both(self, *parameters, axes=AXES):
        """Start the driver and plug the gamepad in; wait for its first message."""
        program = self.start_driver(*parameters)
        wait_for(lambda: "No joystick at" in program.output, "line on the missing device")
        self.plug_in(axes=axes)
        return program

    def test_a_message_has_the_state_the_device_and_the_time(self):
        self.start_both("deadzone:=0.5", "sticky_buttons:=true", "default_trig_val:=true")
        self.assertEqual(self.last, ((0.0,) * AXES, []))
        self.stream.send((AXIS | INIT, 5, -FULL), (AXIS, 0, -FULL), (AXIS, 3, 16000))
        self.stream.send((BUTTON, 4, 1), (BUTTON, 4, 0), (BUTTON, 11, 1))
        wait_for(lambda: self.last[1] == [4, 11], "sticky buttons that were pressed")
        self.assertEqual(self.last[0], (1.0, 0.0, 0.0, 0.0, 0.0, 1.0))
        last = self.joys[-1]
        self.assertEqual((last.header.frame_id, len(last.buttons)), (self.stream.path, BUTTONS))
        self.assertAlmostEqual(last.header.stamp.to_sec(), time.time(), delta=BUSY_S)

    def test_a_loss_gives_neutral_at_once_then_silence_and_it_comes_back_by_itself(self):
        program = self.start_both(axes=8)  # so many as in X mode, where axes 2 and 5 are triggers
        self.stream.send((AXIS, 1, -FULL), (AXIS, 5, FULL), (BUTTON, 4, 1))
        wait_for(lambda: self.last[1] == [4], "stick pushed with the dead-man held")
        watch, lost = Stopwatch(), self.stream.pull_out()
        neutral = ((0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0), [])
        wait_for(lambda: self.last == neutral, "neutral message")
        after = [joy for joy in self.joys if not joy.buttons[4] and joy.axes[5] == 1.0]
        self.assertEqual(len(after), 1)
        late_s = after[0].header.stamp.to_sec() - lost - watch.lost_s
        self.assertLess(late_s, 0.1 + BUSY_S)
        wait_for(lambda: "No joystick at" in program.output.partition("Lost")[2], "search")
        count = len(self.joys)
        self.assertGreaterEqual(time.time() - lost, SHORTEST_SILENCE_S)

        watch = Stopwatch()
        self.stream.plug_in(axes=8)
        self.assertLess(watch.took_s, 1.0 + BUSY_S)
        # Silent until it is touched: the state at opening may be made up.
        self.stream.send((BUTTON, 4, 1))
        wait_for(lambda: len(self.joys) > count, "message")
        self.assertEqual(self.joys[count].buttons[4], 1)

    def test_a_still_stick_hardly_wakes_the_driver(self):
        program = self.start_driver("autorepeat_rate:=0")
        self.stream.plug_in()
        # It repeats nothing, and may not know of its subscriber yet.
        press = ((BUTTON, 0, 1), (BUTTON, 0, 0))
        wait_for(lambda: self.stream.send(*press) or self.joys, "first message")
        before, before_s = wakings(program.pid), processor_time_s(program.pid)
        time.sleep(STILL_S)  # what is measured
        share = (processor_time_s(program.pid) - before_s) / STILL_S
        print(f"joy_node, still stick, no autorepeat: {100 * share:.2f} % of a core")
        self.assertLess(wakings(program.pid) - before, WAKINGS_A_SECOND * STILL_S)

    def test_a_recording_arrives_in_the_steps_of_the_gamepad(self):
        path, axis = PACKAGE / "bag/joy.bag", F710_D.axes[1]
        with rosbag.Bag(str(path)) as bag:
            steps = {-axis.js_value(axis.raw(joy.axes[1])) for _, joy, _ in bag.read_messages()}
        self.start(VIRTUAL, "--stream", self.stream.path, "--bag", str(path))
        self.start_driver("deadzone:=0.0")
        wait_for(lambda: len({joy.axes[1] for joy in self.joys}) > 30, "moving stick")
        self.assertLessEqual({round(joy.axes[1] * FULL) for joy in self.joys}, steps)
        self.assertTrue(any(joy.buttons[4] for joy in self.joys))

    def test_a_mistake_in_what_it_plays_is_one_line(self):
        script = self.folder() / "moves.yaml"
        script.write_text("7", encoding="utf-8")
        for line, *given in (
            ("_joystick: /no/joy.bag: cannot be read: No such file", "--bag", "/no/joy.bag"),
            ("moves.yaml: it has no list of moves", "--script", str(script)),
            ("is there and is no FIFO", "--stream", str(script)),
        ):
            self.check_mistake(Program(VIRTUAL, "--stream", self.stream.path, *given), line)

    def test_a_script_of_moves_drives_a_square(self):
        robot, device = self.enter(DiagnosedRobot()), self.stream.path
        self.start(*LAUNCH, f"joy_dev:={device}")
        # The script begins with its reader, and the robot must be ready then.
        robot.wait_for_state(WAITING)
        script = str(PACKAGE / "config/virtual_joystick/square.yaml")
        self.check_end(self.start(VIRTUAL, "--stream", device, "--script", script))
        passed = iter(robot.odometry)
        for corner in CORNERS:
            near = any(math.dist((at.x, at.y), corner) < NEAR_M for at in passed)
            self.assertTrue(near, f"not near {corner} after those before")
        self.assertFalse(robot.now.moves)
        self.assertLess(math.dist(robot.now.pose[:2], CORNERS[-1]), NEAR_M)


def wakings(pid):
    """How often the threads of a process waited so far: unlike their time, the same beside load."""
    states = [path.read_text() for path in Path(f"/proc/{pid}/task").glob("*/status")]
    return sum(int(re.search(r"^voluntary_ctxt_switches:\s*(\d+)", s, re.M)[1]) for s in states)


def processor_time_s(pid):
    """User and system time of a process so far [s]."""
    fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


if __name__ == "__main__":
    run()
