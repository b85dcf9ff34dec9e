#!/usr/bin/python3
"""Who drives over time: the steps are data, in the .test file."""

import sys
import threading
import unittest
from math import isfinite

import rospy
import rostest
from geometry_msgs.msg import Twist
from rosgraph_msgs.msg import Log
from std_msgs.msg import String

from tutorial_testing.nodes import init_node
from tutorial_testing.waiting import wait_for

PERIOD_S = 0.05
STEADY = 10  # commands that go through one after the other, before a step counts as settled


class Speakers(threading.Thread):
    """Say a velocity on some of the topics, again and again, in a thread of its own."""

    def __init__(self, topics):
        super().__init__(daemon=True)
        self.publishers = {
            name: rospy.Publisher(topic, Twist, queue_size=1) for name, topic in topics.items()
        }
        self.speeds = {}
        self.ended = threading.Event()

    def run(self):
        while not self.ended.wait(PERIOD_S):
            for name, speed in self.speeds.items():
                twist = Twist()
                twist.linear.x, twist.angular.z = speed, 1.0 if speed else 0.0
                self.publishers[name].publish(twist)


class WhoDrivesTest(unittest.TestCase):
    def test_who_drives(self):
        active, driven, log = [], [], []
        rospy.Subscriber("/rosout", Log, log.append)
        rospy.Subscriber("cmd_vel_mux/active", String, lambda m: active.append(m.data))
        rospy.Subscriber("base/velocity", Twist, driven.append)
        speakers = Speakers(rospy.get_param("~topics"))
        for name, publisher in speakers.publishers.items():
            wait_for(publisher.get_num_connections, f"subscriber of {name}")
        wait_for(lambda: active == ["idle"], "a mux that says that it is idle")
        speakers.start()
        steps = rospy.get_param("~steps")
        for step in steps:
            speakers.speeds = step["say"]
            wait_for(
                lambda step=step: (
                    active[-1] == step["active"]
                    and driven
                    and driven[-1].linear.x == step["driven"]
                ),
                f"{step['active']} at {step['driven']} m/s ({step['title']})",
            )
            settled = len(driven)
            if step["active"] == "idle":
                continue
            wait_for(lambda n=settled: len(driven) >= n + STEADY, f"commands ({step['title']})")
            through = {twist.linear.x for twist in driven[settled:]}
            self.assertEqual(through, {step["driven"]}, step["title"])
        speakers.ended.set()

        # Who was active, and nobody else in between; of two that start at once the lower one may
        # come first, and drive for a moment.
        names = [name for name in active if name != "low"]
        expected = [step["active"] for step in steps if step["active"] != "low"]
        self.assertEqual(names, ["idle", *expected])
        # Unchanged: both numbers of each. Never a number that is none.
        self.assertTrue(all(isfinite(twist.linear.x) for twist in driven))
        self.assertTrue(all(bool(twist.linear.x) == bool(twist.angular.z) for twist in driven))
        # One zero each time when all fell silent; those of `high` came from itself.
        zeros = [k for k, twist in enumerate(driven) if twist == Twist()]
        spoken = [driven[k - 1].linear.x for k in zeros if driven[k - 1] != Twist()]
        self.assertEqual(spoken, [0.2, 0.15, 0.3])
        # The two inputs that said what is no number are named, once each.
        warnings = [line.msg for line in log if line.level >= Log.WARN]
        self.assertEqual(len(warnings), 2, warnings)
        for name, warning in zip(("high", "middle"), warnings):
            self.assertTrue(warning.startswith(f"{name}: "), warning)
            self.assertIn("not a finite number", warning)


if __name__ == "__main__":
    init_node("cmd_vel_mux_who_drives")
    rostest.rosrun("ros1_tutorial_test", "cmd_vel_mux_who_drives", WhoDrivesTest, sys.argv)
