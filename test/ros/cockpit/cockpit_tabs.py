#!/usr/bin/python3
"""What pages see is what runs: joy2twist's reports, curves, other joysticks."""

import time

import rosgraph
import rospy
from sensor_msgs.msg import Joy

from tutorial_testing.cockpit_rig import WithCockpit
from tutorial_testing.rostests import run
from tutorial_testing.waiting import wait_for

FIELD = "/odom/pose/pose/position/x"
HELD_S = 8.0  # well above the vigilance_timeout of robot.launch.xml


def publishers(topic):
    state = rosgraph.Master(rospy.get_name()).getSystemState()
    return sorted(node for name, nodes in state[0] if name == topic for node in nodes)


class Tabs(WithCockpit):
    def setUp(self):
        self.page = self.enter(self.rig.page())

    def test_a_hand_that_is_still_drives_for_as_long_as_it_is_held(self):
        """A real gamepad that is as still as that is taken to be out of reach."""
        self.page.watch(robots=True, look="")
        begin, losses, seen = 0.0, -1, 0

        def held():
            nonlocal begin, losses, seen
            if len(self.page.of("lost")) != losses or not self.rig.moves:  # the machine was busy
                self.rig.drive(self.page)
                begin, losses = time.monotonic(), len(self.page.of("lost"))
                seen = len(self.page.messages)
            return time.monotonic() - begin > HELD_S

        wait_for(held, "hand that was held for so long")
        told = [m["why"] for m in self.page.messages[seen:] if m["kind"] == "teleop"]
        self.assertFalse([why for why in told if "does not change" in why or "has not" in why])

    def test_every_sample_of_a_field_is_drawn(self):
        self.page.watch(fields=[FIELD])
        self.page.wait_for("plot")
        begin = len(self.page.of("plot"))
        stamps = {round(moment.stamp, 6) for moment in self.rig.more(101)[5:95]}
        wait_for(lambda: len(self.page.of("plot")) > begin + 20, "plot")
        seen = {t for plot in self.page.of("plot") for t, _ in plot["samples"][FIELD]}
        self.assertEqual(stamps - seen, set())

    def test_another_joystick_takes_the_seat_and_the_cockpit_publishes_no_longer(self):
        def is_lost_to_us():
            rival.publish(Joy())
            return any(rospy.get_name() in lost["why"] for lost in self.page.of("lost"))

        self.rig.drive(self.page)
        rival = self.publisher("/joy", Joy)
        wait_for(is_lost_to_us, "loss of the seat")
        wait_for(lambda: "/cockpit" not in publishers("/joy"), "cockpit that publishes no longer")


if __name__ == "__main__":
    run()
