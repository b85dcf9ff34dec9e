#!/usr/bin/python3
"""joy_node over a stream of events: what it publishes, when, and what it does on a loss."""

import sys
import time
import unittest

import rosnode
import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray

from gamepad.driver.driver import SHORTEST_SILENCE_S
from gamepad.js_event import AXIS, BUTTON, FULL, INIT
from tutorial_testing.joystick_stream import AXES, BUTTONS, JoyLog, Stream, driver
from tutorial_testing.nodes import init_node, node_path
from tutorial_testing.processes import Program
from tutorial_testing.waiting import BUSY_S, wait_for

ZERO = (0.0,) * AXES


class DriverTest(unittest.TestCase):
    def setUp(self):
        self.stream = Stream()
        self.addCleanup(self.stream.remove)
        self.log = JoyLog()
        self.addCleanup(self.log.stop)

    def start(self, *parameters, axes=AXES):
        """Start the driver and plug the gamepad in; wait for its first message."""
        program = driver(self.stream.path, *parameters)
        self.addCleanup(program.__exit__)
        wait_for(lambda: "No joystick at" in program.output, "line on the missing device")
        wait_for(lambda: self.log.connected, "connection")
        self.stream.plug_in(axes)
        wait_for(lambda: self.log.last, "first message")
        return program

    def test_states_in_the_sense_of_ros(self):
        self.start("deadzone:=0.5", "sticky_buttons:=true", "default_trig_val:=true")
        self.assertEqual(self.log.last, (ZERO, []))
        self.stream.send((AXIS | INIT, 5, -FULL))
        wait_for(lambda: self.log.last[0][5] == 1.0, "axis at opening, as default_trig_val asks")
        self.stream.send((AXIS, 0, -FULL), (AXIS, 1, FULL), (AXIS, 2, 24575), (AXIS, 3, 16000))
        wait_for(lambda: self.log.last[0][0], "moved stick")
        left, up, right, little, *_ = self.log.last[0]
        self.assertEqual((left, up, little), (1.0, -1.0, 0.0))
        self.assertAlmostEqual(right, -0.5, delta=1e-4)
        self.stream.send((BUTTON, 4, 1), (BUTTON, 4, 0), (BUTTON, 11, 1))
        wait_for(lambda: self.log.last[1] == [4, 11], "sticky buttons that were pressed")
        last = self.log.messages[-1]
        self.assertEqual(last.header.frame_id, self.stream.path)
        self.assertEqual(len(last.buttons), BUTTONS)
        self.assertAlmostEqual(last.header.stamp.to_sec(), time.time(), delta=1.0)

    def test_without_autorepeat_every_press_and_release_arrives_and_no_more(self):
        self.start("autorepeat_rate:=0")
        self.stream.send(*[(BUTTON, 0, step % 2) for step in range(1, 51)])
        self.stream.send((BUTTON, 1, 1))
        wait_for(lambda: self.log.last[1] == [1], "last press")
        self.assertEqual([joy.buttons[0] for joy in self.log.messages], [0, *[1, 0] * 25, 0])

    def test_a_loss_gives_neutral_at_once_then_silence_and_it_comes_back_by_itself(self):
        program = self.start(axes=8)  # so many as in X mode, where axes 2 and 5 are triggers
        self.stream.send((AXIS, 1, -FULL), (AXIS, 5, FULL), (BUTTON, 4, 1))
        wait_for(lambda: self.log.last[1] == [4], "stick pushed with the dead-man held")
        lost = self.stream.pull_out()
        neutral = ((0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0), [])
        wait_for(lambda: self.log.last == neutral, "neutral message")
        after = [joy for joy in self.log.messages if not joy.buttons[4] and joy.axes[5] == 1.0]
        self.assertEqual(len(after), 1)
        self.assertLess(after[0].header.stamp.to_sec() - lost, 0.1 + BUSY_S)
        wait_for(lambda: "No joystick at" in program.output.partition("Lost")[2], "search")
        count = len(self.log.messages)
        self.assertGreaterEqual(time.time() - lost, SHORTEST_SILENCE_S)

        back = time.time()
        self.stream.plug_in(axes=8)
        self.assertLess(time.time() - back, 1.0 + BUSY_S)
        # Silent until it is touched: the state at opening may be made up.
        self.stream.send((AXIS, 1, -FULL), (BUTTON, 4, 1))
        wait_for(lambda: len(self.log.messages) > count, "message")
        first = self.log.messages[count]
        self.assertEqual((first.axes[1], first.buttons[4]), (1.0, 1))

    def test_diagnostics(self):
        levels = {}

        def keep(message):
            for status in message.status:
                if status.name.endswith("Joystick Driver Status"):
                    levels[status.message] = (status.level, {v.key: v.value for v in status.values})

        subscriber = rospy.Subscriber("/diagnostics", DiagnosticArray, keep)
        self.addCleanup(subscriber.unregister)
        self.start("diagnostic_period:=0.1")
        wait_for(lambda: "OK" in levels, "diagnostics of the open joystick")
        self.assertEqual(levels["OK"][0], 0)
        self.assertEqual(levels["OK"][1]["device"], self.stream.path)
        wait_for(lambda: 15 < float(levels["OK"][1]["recent publication rate (Hz)"]) < 25, "20 Hz")
        self.stream.pull_out()
        wait_for(lambda: "Joystick not open." in levels, "diagnostics of the lost joystick")
        self.assertEqual(levels["Joystick not open."][0], 2)

    def test_ctrl_c_ends_it_with_and_without_a_gamepad(self):
        program = self.start()
        program.interrupt()
        self.assertEqual(program.wait(), 0)
        with driver("/no/such/device") as waiting:
            wait_for(lambda: "No joystick at /no/such/device" in waiting.output, "line")
            waiting.interrupt()
            self.assertEqual(waiting.wait(), 0)
            self.assertNotIn("Traceback", waiting.output + program.output)
            self.assertNotIn("/joy_node", rosnode.get_node_names())  # not registered as if it ran

    def test_a_mistake_and_a_missing_master_get_one_line(self):
        nowhere = "http://localhost:1"
        node = (node_path("gamepad", "joy_node"),)
        for program, line in (
            (driver("js0"), "~dev: 'js0': must be a whole path, such as /dev/input/js0"),
            (Program(*node, ROS_MASTER_URI=nowhere), f"no ROS master at {nowhere}"),
        ):
            with program:
                self.assertEqual(program.wait(), 1)
                self.assertTrue(program.output.startswith(f"joy_node: {line}"), program.output)
                self.assertEqual(program.output.count("\n"), 1)


if __name__ == "__main__":
    init_node("joystick_driver_test")
    rostest.rosrun("ros1_tutorial_test", "joystick_driver", DriverTest, sys.argv)
