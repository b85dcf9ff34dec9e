#!/usr/bin/python3
"""launch_joy_node.launch virtual:=true in a terminal: keys drive the simulated robot."""

import os

from tutorial_testing.keys import KeyboardRig
from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import wait_for

HINT = "  without LB: tap space, then this key at once"
STATE = rf"^  left stick [+-]\d\.\d [+-]\d\.\d({HINT}|  LB|  RB|  MODE LED on|  unplugged)*$"


class KeyboardTest(RosTest):
    def setUp(self):
        self.rig = self.enter(KeyboardRig())
        self.terminal = self.rig.terminal

    def end_with(self, key):
        self.terminal.press(key)
        wait_for(lambda: self.terminal.ended, "end of the launch")
        history = self.terminal.history
        for word in ("Traceback", "died"):  # a normal end does not look like a crash
            self.assertNotIn(word, history)
        for line in history.splitlines():
            if "left stick +" in line:
                self.assertRegex(line, STATE, "something is glued to the state")
        self.assertFalse(os.path.exists(self.rig.device), "the FIFO is left")

    def test_keys_held_and_released_move_and_stop_the_robot(self):
        terminal = self.terminal
        self.assertIn("LB, the dead-man button: hold it", terminal.screen)
        shown = f"left stick +0.0 +1.0{HINT}"
        terminal.hold("w", lambda: shown in terminal.screen, "key on the screen")
        wait_for(lambda: "left stick +0.0 +0.0" in terminal.screen, "released key")
        moved = [moment for moment in self.rig.odometry if moment.moves]
        self.assertEqual(moved, [], "moved without LB")

        terminal.press("Space")
        terminal.hold("Up", self.rig.is_at_full_speed, "moving robot")
        self.assertIn("+1.0  LB", terminal.screen)
        self.rig.wait_for_rest()  # after the keys were released

        self.rig.drive()
        terminal.press("u")
        self.rig.wait_for_rest()
        wait_for(lambda: "unplugged" in terminal.screen, "word on the screen")
        self.end_with("q")

    def test_ctrl_c_while_driving_ends_all_with_a_standing_robot(self):
        self.rig.drive()
        self.end_with("C-c")
        self.assertIn("done", self.terminal.screen)


if __name__ == "__main__":
    run()
