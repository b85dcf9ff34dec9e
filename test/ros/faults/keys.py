#!/usr/bin/python3
"""The virtual gamepad is abandoned or suspended, and the robot stands."""

import subprocess

from tutorial_testing.keys import KeyboardRig
from tutorial_testing.rig import go_on, stop
from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import wait_for


class FaultsOfTheKeys(RosTest):
    def setUp(self):
        self.rig = self.enter(KeyboardRig())

    def check_stays(self, what):
        """LB and W are pressed, and still nothing moves."""
        began = self.rig.now.stamp
        self.rig.terminal.press("Space")
        for _ in range(20):
            self.rig.terminal.press("w")
        self.rig.more()
        self.assertFalse(any(moment.moves for moment in self.rig.since(began)), what)

    def test_a_screen_that_is_held_releases_all_keys(self):
        terminal = self.rig.terminal
        self.rig.drive()
        terminal.press("C-s")  # the terminal's flow control: nothing can be shown any more
        self.rig.wait_for_rest()
        self.check_stays("on a held screen")
        terminal.press("C-q")
        self.rig.drive()
        # It went on with its work, and was not only missed by joy_node.
        self.assertNotIn("no sign of life", terminal.history)

    def test_keys_that_were_typed_during_a_suspension_do_not_drive(self):
        serves = f"virtual_joystick.*--stream.*{self.rig.device}"
        found = subprocess.run(["pgrep", "-f", serves], check=True, capture_output=True, text=True)
        pids = [int(pid) for pid in found.stdout.split()]
        self.rig.drive()
        stop(pids)
        self.rig.wait_for_rest()  # without signs of life
        self.check_stays("while it is suspended")
        go_on(pids)  # it reads what was typed meanwhile
        self.assertTrue(self.rig.stays_at_rest(), "after the suspension")
        self.rig.drive()

    def test_a_terminal_that_is_closed_leaves_a_standing_robot(self):
        self.rig.drive()
        self.rig.terminal.close()
        wait_for(lambda: not self.rig.moves, "standing robot without a terminal")


if __name__ == "__main__":
    run()
