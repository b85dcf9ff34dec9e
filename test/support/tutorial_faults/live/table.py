"""The table of faults: what happens to a live world, for how long, and what must hold."""

import contextlib
import math
import signal
import threading
from functools import partial
from random import Random
from typing import Any, NamedTuple

import rospy
from geometry_msgs.msg import Twist, Vector3
from sensor_msgs.msg import Joy

from tutorial_testing.nodes import serialised
from tutorial_testing.rig import DRIVER, JOYSTICK, MUX

BASE = "base"  # World.base
NODES = {"joy_node": JOYSTICK, "joy2twist": DRIVER, "mux": MUX, BASE: BASE}
TELEOP = "cmd_vel_mux/input/teleop"
TOPICS = {"teleop": TELEOP, "navi": "cmd_vel_mux/input/navi", "cmd_vel": "cmd_vel"}
# What must hold. RESTS: the wheels rest in time, and then wait for the release of all. WAITS:
# wheels at rest wait for it. DRIVES_ON: the robot does. MAY_STOP: it may also stop for a while.
# PAUSES: the wheels rest in time, and may then drive on, as after an unplugged cable.
RESTS, WAITS, DRIVES_ON, MAY_STOP = "rests", "waits", "drives on", "may stop"
PAUSES = "pauses"

VIGILANCE_S = 1.0  # joy2twist's ~vigilance_timeout here, for more trials
PERIOD_S = 0.05  # messages of other programs
LB = 4
HELD = Joy(axes=[0.0, 1.0, 0.0, 0.0, 0.0, 0.0], buttons=[int(n == LB) for n in range(12)])
ODD = (math.nan, math.inf, -math.inf, 0.0, 1.0, -1.0, 1e38, 1e-45, 2.0, 1e6)


class Fault(NamedTuple):
    """A row; do(world) is a generator: its first step begins the fault, the second one ends it."""

    family: str
    part: str  # the part that is hit
    must: str
    lasts_s: tuple  # the shortest and the longest time
    do: Any
    late_s: float = 0.0  # what it may add to the time until the wheels are at rest
    of_line: bool = False  # whether it hits a serial line, which the simulated base lacks

    @property
    def name(self):
        return f"{self.family}:{self.part}"

    @property
    def is_restart(self):
        """Whether the part is ended, and started again."""
        return self.family in ("kill", "end")


class Raw:
    """A message that is sent as these bytes."""

    def __init__(self, data=b""):
        super().__init__()
        self._data = data

    def serialize(self, buff):
        buff.write(self._data)


RawJoy, RawTwist = type("RawJoy", (Raw, Joy), {}), type("RawTwist", (Raw, Twist), {})


def broken(message):
    """Return bytes that are no message of this type: truncated, or with wrong lengths.

    rospy reads the beginning of longer ones, so that a Joy would be a Twist of tiny velocities.
    """
    return b"", bytes(20), serialised(message)[:-3], b"\xff" * 100_000


def odd_joy(random):
    """Return a Joy with any lengths and values, but no dead-man button held."""
    values = [random.choice(ODD) for _ in range(random.choice((0, 1, 6, 6, 8, 39)))]
    return Joy(axes=values, buttons=[0] * random.choice((0, 5, 12)))


def says(topic, kind, make, world):
    """Let another program publish messages that it makes."""
    over, random = threading.Event(), Random(world.seed)

    def say():
        with contextlib.suppress(OSError, rospy.ROSException):  # the master may be suspended
            publisher = rospy.Publisher(topic, kind, queue_size=10)
            while not over.wait(PERIOD_S):
                publisher.publish(make(random))
            publisher.unregister()

    threading.Thread(target=say, daemon=True).start()
    yield
    over.set()


def ends(node, number, world):
    world.signal(node, number)
    yield
    world.restart(node)


def stops(part, world):
    world.signal(part, signal.SIGSTOP)
    yield
    world.signal(part, signal.SIGCONT)


def hands(name, during, world):
    act = getattr(world.hands, name)
    act(during)
    yield
    act(not during)


def asks(service, during, world):
    """Set a switch of the robot on the serial line, and set it back."""
    world.ask(service, during)
    yield
    world.ask(service, not during)


def restarts_robot(world):
    world.ask("reboot")
    yield


def rows():
    for name, node in NODES.items():
        yield Fault("kill", name, RESTS, (0.05, 0.7), partial(ends, node, signal.SIGKILL))
        yield Fault("end", name, RESTS, (0.05, 0.7), partial(ends, node, signal.SIGINT))
        yield Fault("stop", name, RESTS, (0.02, 1.5), partial(stops, node))
    for name in ("master", "viewer"):
        yield Fault("stop", name, DRIVES_ON, (0.1, 1.5), partial(stops, name))
    yield Fault("unplug", "gamepad", RESTS, (0.02, 1.2), partial(hands, "plug", False))
    freezes = partial(hands, "freeze", True)
    yield Fault("stop", "gamepad", RESTS, (0.7, 1.5), freezes)
    # Out of reach: the receiver keeps the last state, which only joy2twist can notice.
    yield Fault("silence", "gamepad", RESTS, (0.1, 2.5), freezes, VIGILANCE_S)
    for family, part, do in (
        ("unplug", "cable", partial(asks, "plug_in", False)),
        ("off", "robot", partial(asks, "switch_on", False)),
        ("garbage", "cable", partial(asks, "send_garbage", True)),
        ("reboot", "robot", restarts_robot),
    ):
        yield Fault(family, part, PAUSES, (0.05, 1.5), do, of_line=True)
    nan = lambda random: Twist(linear=Vector3(x=random.choice(ODD[:3])))  # noqa: E731
    raw = lambda kind, good: lambda random: kind(random.choice(broken(good)))  # noqa: E731
    for family, part, topic, must, kind, make in (
        ("second", "joy", "joy", WAITS, Joy, lambda _: HELD),
        ("odd", "joy", "joy", MAY_STOP, Joy, odd_joy),
        ("broken", "joy", "joy", MAY_STOP, RawJoy, raw(RawJoy, HELD)),
        *(("nan", part, topic, DRIVES_ON, Twist, nan) for part, topic in TOPICS.items()),
        *(("broken", *row, DRIVES_ON, RawTwist, raw(RawTwist, Twist())) for row in TOPICS.items()),
    ):
        yield Fault(family, part, must, (0.1, 1.0), partial(says, topic, kind, make))


FAULTS = {fault.name: fault for fault in rows()}
