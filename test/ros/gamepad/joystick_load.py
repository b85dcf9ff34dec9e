#!/usr/bin/python3
"""joy_node's processor time with a still stick."""

import os
import time
from pathlib import Path

from gamepad.js_event import BUTTON
from tutorial_testing.joystick_stream import JoystickTest
from tutorial_testing.rostests import run
from tutorial_testing.waiting import wait_for

STILL_S = 5.0


class LoadTest(JoystickTest):
    def test_a_still_stick_costs_under_one_percent(self):
        program = self.start_driver("autorepeat_rate:=0")
        self.stream.plug_in()
        # It repeats nothing, and may not know of its subscriber yet.
        press = ((BUTTON, 0, 1), (BUTTON, 0, 0))
        wait_for(lambda: self.stream.send(*press) or self.joys, "first message")
        before = processor_time_s(program.pid)
        time.sleep(STILL_S)  # what is measured
        share = (processor_time_s(program.pid) - before) / STILL_S
        print(f"joy_node, still stick, no autorepeat: {100 * share:.2f} % of a core")
        self.assertLess(share, 0.01)


def processor_time_s(pid):
    """User and system time of a process so far [s]."""
    fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


if __name__ == "__main__":
    run()
