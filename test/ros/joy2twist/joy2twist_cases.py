#!/usr/bin/python3
"""Plays the cases of a .test file to joy2twist nodes and compares what they send.

Private parameter ~cases: a map from the name of a case to its steps, done in alphabetical order.
A case begins with `node: NAMESPACE` of the node (default: the root). A step is one of

  joy: [axis, ...]      publish a Joy; with buttons: [...], age_s: of its stamp, times: how often,
                        every_s: how often in time (0.02)
  sends: {linear.x: v}  the next velocity is this, all else 0; with times: and within_s: since the
                        end of the step before
  reaches: {linear.x: v}  as many velocities as it takes until one is this; from each to the next
                        linear.x changes by at most `step`, if that is given, and by less than all
                        in one step
  silent_for_s: t       nothing is sent for so long
  rests: true           zeros are sent, until none has come for a while
  leave: true           the publisher of joy leaves; the next joy step brings another one
  state: text           /diagnostics, which come once a second, report a state that begins so; with
                        `again: true` the last Joy is repeated meanwhile

After the last step nothing else may have been sent.
"""

import collections
import time
from math import inf

import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy

from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import wait_for

COMPONENTS = [f"{kind}.{axis}" for kind in ("linear", "angular") for axis in "xyz"]
STEPS = {"joy", "sends", "reaches", "silent_for_s", "rests", "leave", "state"}
QUIET_S = 1.0  # longer than any repetition of zero and any watchdog in the cases


def same(velocity, expected):
    """Whether the velocity has these components, and zeros beside them."""
    return all(abs(velocity[c] - expected.get(c, 0.0)) < 1e-6 for c in COMPONENTS)


class Node:
    """The other side of a joy2twist node: its joystick and its robot."""

    def __init__(self, namespace):
        self._namespace = namespace
        self._received = collections.deque()  # (time of arrival, velocity by component)
        self._robot = rospy.Subscriber(
            f"{namespace}/cmd_vel", Twist, self._on_twist, tcp_nodelay=True
        )
        self._joystick = self._last_joy = None
        self._last_x = 0.0
        self._last_step = time.monotonic()
        # A connection is there when messages go all the way round.
        wait_for(lambda: self._joy([0.0] * 8, [0] * 12) or self._received, f"{namespace}/cmd_vel")
        self._rests(False)

    def _on_twist(self, twist):
        values = [getattr(getattr(twist, c[:-2]), c[-1]) for c in COMPONENTS]
        self._received.append((time.monotonic(), dict(zip(COMPONENTS, values))))

    def _rests(self, rests):
        def quiet():
            last = self._received[-1][0] if self._received else self._last_step
            return time.monotonic() - last > QUIET_S

        wait_for(quiet, "silence")
        if rests and not all(same(velocity, {}) for _, velocity in self._received):
            raise AssertionError(f"not only zeros: {list(self._received)}")
        self._received.clear()

    def play(self, steps):
        """Do all steps of a case."""
        for step in steps:
            (kind,) = STEPS & set(step)
            getattr(self, f"_{kind}")(**step)
            if kind not in ("sends", "reaches"):
                self._last_step = time.monotonic()
        if self._received:
            raise AssertionError(f"also sent: {list(self._received)}")

    def _joy(self, joy, buttons=(), age_s=0.0, times=1, every_s=0.02):
        if self._joystick is None:
            self._joystick = rospy.Publisher(f"{self._namespace}/joy", Joy, queue_size=100)
            wait_for(self._joystick.get_num_connections, "subscriber of joy")
        for _ in range(times):
            message = Joy(axes=[float(axis) for axis in joy], buttons=buttons)
            message.header.stamp = rospy.Time.now() - rospy.Duration(age_s)
            self._joystick.publish(message)
            self._last_joy = message
            self._last_step = time.monotonic()
            time.sleep(every_s)

    def _sends(self, sends, times=1, within_s=None):
        for _ in range(times):
            arrival, velocity = self._next(sends)
            if not same(velocity, sends):
                raise AssertionError(f"sent {velocity} instead of {sends}")
        if within_s is not None and arrival > self._last_step + within_s:
            raise AssertionError(f"sent {arrival - self._last_step:.3f} s later")

    def _reaches(self, reaches, step=inf):
        speeds, velocity = [self._last_x], None
        while velocity is None or not same(velocity, reaches):
            _, velocity = self._next(reaches)
            speeds.append(velocity["linear.x"])
        changes = [abs(after - before) for before, after in zip(speeds, speeds[1:])]
        if step < inf and (
            max(changes) > step + 1e-6 or abs(speeds[-1] - speeds[0]) <= max(changes)
        ):
            raise AssertionError(f"linear.x went {speeds}")

    def _next(self, expected):
        """The next velocity that was sent, and when."""
        wait_for(lambda: self._received, f"velocity {expected}")
        arrival, velocity = self._received.popleft()
        self._last_x = velocity["linear.x"]
        return arrival, velocity

    def _silent_for_s(self, silent_for_s):
        end = time.monotonic() + silent_for_s
        while time.monotonic() < end:
            if self._received:
                raise AssertionError(f"sent {self._received[0][1]} instead of nothing")
            time.sleep(0.01)

    def _leave(self, leave):
        if self._joystick:
            self._joystick.unregister()
        self._joystick = None

    def _state(self, state, again=False):
        name = f"{self._namespace}/NewJoy2Twist: joystick".strip("/")

        def reported():
            if again:
                self._last_joy.header.stamp = rospy.Time.now()
                self._joystick.publish(self._last_joy)
            return self.states.get(name, "").startswith(state)

        wait_for(reported, f"state {state} of {name}")


class CasesTest(RosTest):
    """One test method for every case."""

    @classmethod
    def setUpClass(cls):
        cls.nodes = {}  # by namespace
        Node.states = {}  # of every node, by its name in /diagnostics
        keep = lambda array: Node.states.update((s.name, s.message) for s in array.status)  # noqa: E731
        rospy.Subscriber("/diagnostics", DiagnosticArray, keep)

    def play(self, _, steps):
        namespace = steps[0].get("node", "")
        if namespace not in self.nodes:
            self.nodes[namespace] = Node(namespace and f"/{namespace}")
        self.nodes[namespace].play([step for step in steps if "node" not in step])


if __name__ == "__main__":
    run(CasesTest)
