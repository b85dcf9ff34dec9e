"""The mux after a suspension: what came meanwhile moves nothing, what comes then does."""

import time

from geometry_msgs.msg import Twist, Vector3
from rosgraph_msgs.msg import Log
from std_msgs.msg import String

from tutorial_testing.nodes import pid_of
from tutorial_testing.rig import suspended
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import wait_for

TELEOP = "/cmd_vel_mux/input/teleop"
OUTAGE_S = 1.0
BACKLOG = ([0.3] * 500 + [0.0] * 500) * 3 + [0.3] * 500  # [m/s], more than is read at once


def twist(speed):
    return Twist(linear=Vector3(x=speed))


class LateTest(RosTest):
    def test_late_commands_move_nothing(self):
        active, log = self.record("cmd_vel_mux/active", String), self.record("/rosout", Log)
        driven = []  # [m/s]
        self.hear("cmd_vel_mux/output", Twist, lambda command: driven.append(command.linear.x))

        def warnings():
            return [line.msg for line in log if "suspended" in line.msg]

        wait_for(lambda: active and active[-1].data == "idle", "a mux that is idle")
        teleop = self.publisher(TELEOP, Twist, queue_size=len(BACKLOG))
        wait_for(teleop.get_num_connections, "subscriber of teleop")
        wait_for(lambda: teleop.publish(twist(0.2)) or 0.2 in driven, "a command that goes through")
        with suspended([pid_of("/cmd_vel_mux")]):
            ends_s = time.monotonic() + OUTAGE_S
            for speed in BACKLOG:
                teleop.publish(twist(speed))
            # All of it on its way: what a busy machine sends afterwards is of then, and not late.
            waits = lambda: any(one._queue for one in teleop.impl.connections)  # noqa: E731
            wait_for(lambda: not waits(), "end of sending")
            wait_for(lambda: time.monotonic() > ends_s, "end of the outage")
        wait_for(warnings, "warning that it was suspended")

        wait_for(lambda: teleop.publish(twist(0.4)) or driven[-1] == 0.4, "a command of now")
        # What was sent before it on the same connection was also received before it.
        self.assertEqual(set(driven), {0.2, 0.0, 0.4})
