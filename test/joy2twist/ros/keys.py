"""launch_joy_node.launch virtual:=true in a terminal: keys drive, faults never move the robot."""

import os
import subprocess

from tutorial_testing.claims import claim
from tutorial_testing.keys import KeyboardRig
from tutorial_testing.processes import suspended
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import wait_for

HINT = "  without LB: tap space, then this key at once"


@claim(
    "(b) Keys that were typed during a suspension do not drive; a held screen or a closed terminal "
    "leaves a standing robot"
)
class FaultsOfTheKeys(RosTest):
    def setUp(self):
        self.rig = self.enter(KeyboardRig())
        self.terminal = self.rig.terminal

    def check_stays(self):
        """Check that nothing moves although LB and W are pressed."""
        self.rig.wait_for_rest()
        for key in ("Space", *("w" * 20)):
            self.terminal.press(key)
        self.assertTrue(self.rig.stays_at_rest())

    @claim("Keys drive while they are held; Ctrl-C leaves a standing robot")
    def test_keys_move_the_robot_while_lb_is_held_and_ctrl_c_leaves_nothing(self):
        self.assertIn("LB, the dead-man button: hold it", self.terminal.screen)
        shown = f"left stick +0.0 +1.0{HINT}"
        self.terminal.hold("w", lambda: shown in self.terminal.screen, "key on the screen")
        wait_for(lambda: "left stick +0.0 +0.0" in self.terminal.screen, "released key")
        self.assertFalse([m for m in self.rig.odometry if m.moves], "moved without LB")
        self.rig.drive()
        self.rig.wait_for_rest()  # the keys are released
        self.rig.drive()
        self.terminal.press("C-c")
        wait_for(lambda: self.terminal.ended, "end of the launch")
        self.assertIn("done", self.terminal.screen)
        for word in ("Traceback", "died"):  # a normal end does not look like a crash
            self.assertNotIn(word, self.terminal.history)
        self.assertFalse(os.path.exists(self.rig.device), "the FIFO is left")

    def test_a_screen_that_is_held_releases_all_keys(self):
        self.rig.drive()
        self.terminal.press("C-s")  # flow control: the terminal displays nothing more
        self.check_stays()
        self.terminal.press("C-q")
        self.rig.drive()
        # It kept working: joy_node never missed it.
        self.assertNotIn("no sign of life", self.terminal.history)

    def test_keys_that_were_typed_during_a_suspension_do_not_drive(self):
        self.rig.drive()
        serves = f"virtual_joystick.*--stream.*{self.rig.device}"
        pids = subprocess.check_output(["pgrep", "-f", serves], text=True)
        with suspended([int(pid) for pid in pids.split()]):
            self.check_stays()
        self.assertTrue(self.rig.stays_at_rest(), "keys typed meanwhile drive")
        self.rig.drive()
        self.terminal.close()
        wait_for(lambda: not self.rig.moves, "standing robot without a terminal")
