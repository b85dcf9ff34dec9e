#!/usr/bin/python3
"""joy_node over a stream of events: what it publishes, when, and what it does on a loss."""

import time

from gamepad.driver.driver import SHORTEST_SILENCE_S
from gamepad.js_event import AXIS, BUTTON, FULL, INIT
from tutorial_testing.joystick_stream import AXES, BUTTONS, JoystickTest
from tutorial_testing.rostests import run
from tutorial_testing.waiting import BUSY_S, wait_for


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
        self.assertAlmostEqual(last.header.stamp.to_sec(), time.time(), delta=1.0)

    def test_a_loss_gives_neutral_at_once_then_silence_and_it_comes_back_by_itself(self):
        program = self.start_both(axes=8)  # so many as in X mode, where axes 2 and 5 are triggers
        self.stream.send((AXIS, 1, -FULL), (AXIS, 5, FULL), (BUTTON, 4, 1))
        wait_for(lambda: self.last[1] == [4], "stick pushed with the dead-man held")
        lost = self.stream.pull_out()
        neutral = ((0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0), [])
        wait_for(lambda: self.last == neutral, "neutral message")
        after = [joy for joy in self.joys if not joy.buttons[4] and joy.axes[5] == 1.0]
        self.assertEqual(len(after), 1)
        self.assertLess(after[0].header.stamp.to_sec() - lost, 0.1 + BUSY_S)
        wait_for(lambda: "No joystick at" in program.output.partition("Lost")[2], "search")
        count = len(self.joys)
        self.assertGreaterEqual(time.time() - lost, SHORTEST_SILENCE_S)

        back = time.time()
        self.stream.plug_in(axes=8)
        self.assertLess(time.time() - back, 1.0 + BUSY_S)
        # Silent until it is touched: the state at opening may be made up.
        self.stream.send((AXIS, 1, -FULL), (BUTTON, 4, 1))
        wait_for(lambda: len(self.joys) > count, "message")
        first = self.joys[count]
        self.assertEqual((first.axes[1], first.buttons[4]), (1.0, 1))


if __name__ == "__main__":
    run()
