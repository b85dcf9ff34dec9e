#!/usr/bin/python3
"""The mux after a suspension, with programs of many rhythms, and at its own end."""

import contextlib
import time

import rospy
from geometry_msgs.msg import Twist
from rosgraph_msgs.msg import Log
from std_msgs.msg import String

from tutorial_testing.nodes import node_path, pid_of
from tutorial_testing.processes import Program
from tutorial_testing.rig import suspended
from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import wait_for

TELEOP = "/cmd_vel_mux/input/teleop"
OUTAGE_S = 1.0
# More than is read at once.
BACKLOG = ([0.3] * 500 + [0.0] * 500) * 3 + [0.3] * 500  # [m/s]


def twist(speed):
    """A command with the forward speed [m/s]."""
    command = Twist()
    command.linear.x = speed
    return command


@contextlib.contextmanager
def cut_off(node):
    """Keep a node from reading: what is sent to it meanwhile waits in its connections."""
    with suspended([pid_of(node)]):
        ends_s = time.monotonic() + OUTAGE_S
        yield
        wait_for(lambda: time.monotonic() > ends_s, "end of the outage")


class LateTest(RosTest):
    @classmethod
    def setUpClass(cls):
        cls.active, cls.driven, cls.log = [], [], []
        rospy.Subscriber("/rosout", Log, cls.log.append)
        rospy.Subscriber("cmd_vel_mux/active", String, lambda m: cls.active.append(m.data))
        rospy.Subscriber("cmd_vel_mux/output", Twist, lambda m: cls.driven.append(m.linear.x))

    def setUp(self):
        wait_for(lambda: self.active and self.active[-1] == "idle", "a mux that is idle")
        self.driven.clear()

    def test_late_commands_move_nothing(self):
        teleop = rospy.Publisher(TELEOP, Twist, queue_size=len(BACKLOG))
        wait_for(teleop.get_num_connections, "subscriber of teleop")
        teleop.publish(twist(0.2))
        wait_for(lambda: 0.2 in self.driven, "a command that goes through")
        with cut_off("/cmd_vel_mux"):
            for speed in BACKLOG:
                teleop.publish(twist(speed))
            # All of it on its way: what a busy machine sends afterwards is of then, and not late.
            (connection,) = teleop.impl.connections
            wait_for(lambda: not connection._queue, "end of sending")
        wait_for(self.warnings, "warning that it was suspended")

        wait_for(lambda: teleop.publish(twist(0.4)) or self.driven[-1] == 0.4, "a command of now")
        # What was sent before it on the same connection was also received before it.
        self.assertEqual(set(self.driven), {0.2, 0.0, 0.4})
        self.assertEqual(len(self.warnings()), 1, self.warnings())

    def test_programs_of_many_rhythms_are_obeyed(self):
        """When each sends, one after the other: test_arbitration.py has more of them."""
        teleop = self.publisher(TELEOP, Twist)
        wait_for(teleop.get_num_connections, "subscriber of teleop")
        rhythms = {
            "1 Hz": [1.0] * 4,
            "2 Hz": [0.5] * 6,
            "10 Hz": [0.1] * 20,
            "taps": [0.8] * 4,
            **{f"a key held, {s} s": [s] + [1 / 30] * 20 for s in (0.25, 0.5, 0.66)},
        }
        for name, pauses_s in rhythms.items():
            sent = [round(0.1 + number / 1000, 3) for number in range(len(pauses_s))]
            for speed, pause_s in zip(sent, pauses_s):
                teleop.publish(twist(speed))
                time.sleep(pause_s)
            obeyed = [speed for speed in self.driven if speed]
            self.assertGreaterEqual(len(obeyed), 0.95 * len(sent), f"{name}: {obeyed}")
            self.driven.clear()
            wait_for(lambda: self.active[-1] == "idle", "silence")

    def test_a_program_that_is_started_anew_drives_at_once(self):
        command = ("rostopic", "pub", "-r", "10", TELEOP, "geometry_msgs/Twist")
        for speed in (0.5, 0.6):
            with Program(*command, f"{{linear: {{x: {speed}}}}}") as program:
                wait_for(lambda speed=speed: speed in self.driven, f"a command, {speed} m/s")
                program.interrupt()
                program.wait()
            wait_for(lambda: self.active[-1] == "idle", "silence")

    def test_ctrl_c_in_the_middle_of_a_motion_leaves_the_robot_standing(self):
        driven = self.record("/ctrl_c/base/cmd_vel", Twist)
        teleop = {"name": "teleop", "topic": "/stick", "timeout": 60.0, "priority": 1}
        rospy.set_param("/ctrl_c", {"subscribers": [teleop], "publisher": "base/cmd_vel"})
        stick = self.publisher("/stick", Twist)
        mux = node_path("fake_turtlebot_sim", "cmd_vel_mux.py")
        with Program(mux, "__name:=ctrl_c") as node:
            wait_for(lambda: stick.publish(twist(0.2)) or driven, "a command that goes through")
            node.interrupt()
            self.assertEqual((node.wait(), node.output.strip()), (0, ""))
        wait_for(lambda: driven[-1].linear.x == 0.0, "last zero")

    def warnings(self):
        return [line.msg for line in self.log if "suspended" in line.msg]


if __name__ == "__main__":
    run()
