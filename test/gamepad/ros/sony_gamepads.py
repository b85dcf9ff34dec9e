"""joy_remap: a gamepad that looks like another one, or that lacks what a formula needs."""

from rosgraph_msgs.msg import Log
from sensor_msgs.msg import Joy

from tutorial_testing.claims import claim
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import wait_for


class SonyGamepadsTest(RosTest):
    @claim("joy_remap makes one gamepad look like another; a mistake in a formula is one line")
    def test_a_ps4_gamepad_has_the_order_of_ps3joy(self):
        received, log = self.record("joy", Joy), self.record("/rosout", Log)
        pad = self.connected("joy_orig", Joy, queue_size=10)
        wait_for(lambda: pad.publish(Joy(axes=[0.0], buttons=[0])) or log, "first lines")
        short = "need more than its 1 axes and 1 buttons"
        wait_for(lambda: any(short in line.msg for line in log), "warning about a short Joy")
        self.assertEqual(len(received), 0)

        joy = Joy(axes=[0.0] * 14, buttons=[0] * 13)
        joy.axes[1], joy.buttons[4] = 0.5, 1
        joy.header.frame_id = "pad"
        wait_for(lambda: pad.publish(joy) or received, "a Joy")
        first = received[0]
        self.assertEqual((len(first.axes), len(first.buttons)), (27, 17))
        self.assertEqual((first.axes[1], first.axes[14], first.buttons[10]), (0.5, -1.0, 1))
        self.assertEqual(first.header.frame_id, "pad")
