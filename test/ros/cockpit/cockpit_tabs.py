#!/usr/bin/python3
"""What pages see is what runs."""

import contextlib
import json
import time

import rosgraph
import rospy
from sensor_msgs.msg import Joy

from tutorial_testing.cockpit_rig import WithCockpit
from tutorial_testing.rostests import run
from tutorial_testing.socket_page import DRIVE, REST, SocketPage
from tutorial_testing.waiting import wait_for

FIELD = "/odom/pose/pose/position/x"
HELD_S = 8.0  # well above the vigilance_timeout of robot.launch.xml


def publishers(topic):
    state = rosgraph.Master(rospy.get_name()).getSystemState()
    return sorted(node for name, nodes in state[0] if name == topic for node in nodes)


@contextlib.contextmanager
def joystick():
    """Another publisher of the robot's joystick."""
    publisher = rospy.Publisher("/joy", Joy, queue_size=1)
    try:
        yield publisher
    finally:
        publisher.unregister()


class Tabs(WithCockpit):
    def setUp(self):
        self.page = self.enter(self.rig.page())

    def test_a_hand_that_is_still_drives_for_as_long_as_it_is_held(self):
        """A real gamepad that is as still as that is taken to be out of reach."""
        self.page.watch(robots=True, look="")
        begin, losses, seen = 0.0, -1, 0

        def held():
            nonlocal begin, losses, seen
            if len(self.page.of("lost")) != losses or not self.rig.moves:  # of a busy machine
                self.rig.drive(self.page)
                begin, losses = time.monotonic(), len(self.page.of("lost"))
                seen = len(self.page.messages)
            return time.monotonic() - begin > HELD_S

        wait_for(held, "hand that was held for so long")
        self.assertFalse(self.says("does not change", seen) or self.says("has not", seen))

    def test_a_gamepad_out_of_reach_is_shown_before_the_robot_stops(self):
        self.page.watch(robots=True, look="")
        rest, held = (Joy(axes=axes, buttons=buttons) for axes, buttons in (REST, DRIVE))
        with joystick() as gamepad:
            wait_for(lambda: gamepad.publish(rest) or self.says("armed"), "armed joy2twist")
            begin = len(self.page.messages)
            wait_for(lambda: gamepad.publish(held) or self.says("has not changed", begin), "stop")
        self.assertTrue(self.says("driving: the joystick does not change", begin))
        wait_for(self.sits, "seat, once the gamepad has left")

    def says(self, words, begin=0):
        """Whether the page was sent a state of joy2twist with these words since then."""
        told = [m["why"] for m in self.page.messages[begin:] if m["kind"] == "teleop"]
        return any(words in (why or "") for why in told)

    def test_every_sample_of_a_field(self):
        self.page.watch(fields=[FIELD], field_list=True)
        self.assertIn(FIELD, self.page.wait_for("fields")["fields"])
        self.page.wait_for("plot")
        begin = len(self.page.of("plot"))
        stamps = {round(moment.stamp, 6) for moment in self.rig.more(101)[5:95]}
        wait_for(lambda: len(self.page.of("plot")) > begin + 20, "plot")
        seen = {t for plot in self.page.of("plot") for t, _ in plot["samples"][FIELD]}
        self.assertEqual(stamps - seen, set())

    def test_a_recording_drives_and_takes_the_seat(self):
        self.page.watch(bag=True)
        self.assertIn("joy.bag", self.page.wait_for("bags")["names"])
        self.page.say("bag_open", name="joy.bag")
        bag = self.page.wait_for("bag")
        self.assertEqual(bag["topics"][0]["type"], "sensor_msgs/Joy")
        self.assertIn("/joy/axes[1]", bag["curves"])
        self.assertLess(len(json.dumps(bag)), 200_000)
        self.page.say("bag_play", topic="/joy", rate=1.0, loop=True, robot="")
        self.page.wait_for("seat", lambda seat: seat["how"] == "bag" and seat["yours"])
        with SocketPage(self.rig.port) as other:
            other.say("drive", robot="", mode="D")
            other.wait_for("refused", lambda no: "another page drives" in no["why"])
        wait_for(lambda: self.rig.moves, "robot that follows the recording")
        when = time.time()
        self.page.say("bag_pause")
        self.rig.wait_for_rest(when)
        self.assertTrue(self.rig.stays_at_rest())
        position = self.page.of("bag_at")[-1]["position"]
        self.page.say("bag_seek", position=position + 1.0)
        self.page.wait_for("bag_at", lambda at: abs(at["position"] - position - 1.0) < 0.01)

    def is_lost_to_us(self):
        return any(rospy.get_name() in lost["why"] for lost in self.page.of("lost"))

    def sits(self):
        self.page.say("drive", robot="", mode="D")
        return any(seat["yours"] for seat in self.page.of("seat"))

    def test_another_joystick_has_the_first_say(self):
        self.page.watch(robots=True, look="")
        with joystick() as rival:
            wait_for(lambda: rival.publish(Joy()) or self.page.of("pad"), "joystick on the page")
            rival.publish(Joy())
            self.page.say("drive", robot="", mode="D")
            why = self.page.wait_for("refused")["why"]
            self.assertIn(f"{rospy.get_name()} publishes the joystick topic", why)
            self.assertEqual(publishers("/joy"), [rospy.get_name()])
        wait_for(self.sits, "seat, once the other one has ended")
        self.rig.drive(self.page)
        with joystick() as rival:
            wait_for(lambda: rival.publish(Joy()) or self.is_lost_to_us(), "loss of the seat")
        wait_for(lambda: "/cockpit" not in publishers("/joy"), "cockpit that publishes no longer")


if __name__ == "__main__":
    run()
