#!/usr/bin/python3
"""The virtual gamepad is abandoned or suspended, and the robot stands."""

import subprocess

from tutorial_testing.keys import KeyboardRig
from tutorial_testing.rig import suspended
from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import wait_for


class FaultsOfTheKeys(RosTest):
    def setUp(self):
        self.rig = self.enter(KeyboardRig())
        self.rig.drive()

    def check_stays(self):
        """LB and W are pressed, and still nothing moves."""
        self.rig.wait_for_rest()
        for key in ("Space", *("w" * 20)):
            self.rig.terminal.press(key)
        self.assertTrue(self.rig.stays_at_rest())

    def test_a_screen_that_is_held_releases_all_keys(self):
        terminal = self.rig.terminal
        terminal.press("C-s")  # the terminal's flow control: nothing can be shown any more
        self.check_stays()
        terminal.press("C-q")
        self.rig.drive()
        # It went on with its work, and was not only missed by joy_node.
        self.assertNotIn("no sign of life", terminal.history)

    def test_keys_that_were_typed_during_a_suspension_do_not_drive(self):
        serves = f"virtual_joystick.*--stream.*{self.rig.device}"
        found = subprocess.run(["pgrep", "-f", serves], check=True, capture_output=True, text=True)
        with suspended([int(pid) for pid in found.stdout.split()]):
            self.check_stays()
        self.assertTrue(self.rig.stays_at_rest(), "what was typed meanwhile")
        self.rig.drive()
        self.rig.terminal.close()
        wait_for(lambda: not self.rig.moves, "standing robot without a terminal")


if __name__ == "__main__":
    run()
