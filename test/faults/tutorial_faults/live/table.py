"""The table of faults: what is done to a live world, how it is undone, and what must hold."""

import contextlib
import io
import math
import signal
import struct
import threading
from functools import partial
from random import Random
from typing import Any, Callable, NamedTuple, Tuple

import rospy
from geometry_msgs.msg import Twist, Vector3
from sensor_msgs.msg import Joy

from tutorial_testing.rig import BASE, DRIVER, JOYSTICK, MUX

NODES = {"joy_node": JOYSTICK, "joy2twist": DRIVER, "mux": MUX, "base": BASE}
TELEOP, NAVI = "cmd_vel_mux/input/teleop", "cmd_vel_mux/input/navi"
# What must hold: the wheels rest in time, and then wait for the release of all; they wait for it
# if they stood; the robot is driven on all the while; it may stop and drive on, for it is no loss.
RESTS, WAITS, DRIVES_ON, MAY_STOP = "rests", "waits", "drives on", "may stop"

VIGILANCE_S = 1.0  # joy2twist's ~vigilance_timeout here, for more trials
PERIOD_S = 0.05  # of the messages of other programs
LB, RB = 4, 5
TEXT_AT = 12  # in a serialized Joy: where the length of its frame_id is
HELD = Joy(axes=[0.0, 1.0, 0.0, 0.0, 0.0, 0.0], buttons=[int(n == LB) for n in range(12)])
BROKEN = (b"", bytes(20), b"\xff" * 100_000)  # of what is too long rospy reads the beginning
ODD = (math.nan, math.inf, -math.inf, 0.0, 1.0, -1.0, 1e38, 1e-45, 2.0, 1e6)


class Fault(NamedTuple):
    """A row."""

    family: str
    part: str  # that is hit
    lasts_s: Tuple[float, float]  # the shortest and the longest time
    must: str
    do: Callable[[Any], Any]  # to a World
    undo: Callable[[Any], Any]
    late_s: float = 0.0  # what it may add to the time until the wheels are at rest

    @property
    def name(self) -> str:
        """Both."""
        return f"{self.family}:{self.part}"


class Raw:
    """A message that goes over the wire as these bytes."""

    def __init__(self, data=b""):
        super().__init__()
        self._data = data

    def serialize(self, buff):
        buff.write(self._data)


RawJoy, RawTwist = type("RawJoy", (Raw, Joy), {}), type("RawTwist", (Raw, Twist), {})


def odd_joy(random):
    """Return a Joy of any shape and any values that holds no dead-man button."""
    axes = random.choice((6, 6, 8, 0, 1, 2, random.randrange(40)))
    buttons = [random.choice((0, 1, -1, 2**31 - 1)) for _ in range(random.choice((12, 12, 5, 0)))]
    buttons[LB : RB + 1] = [0] * len(buttons[LB : RB + 1])
    odd = random.random() < 0.5
    values = [random.choice(ODD) if odd else random.uniform(-1, 1) for _ in range(axes)]
    return Joy(axes=values, buttons=buttons)


def serialised(message):
    """Return the bytes of a message."""
    buff = io.BytesIO()
    message.serialize(buff)
    return buff.getvalue()


def broken_joy(random):
    """Return a Joy that cannot be read: cut, noise, with a length that lies, or oversized."""
    whole, noise = serialised(odd_joy(random)), random.getrandbits(800).to_bytes(100, "little")
    lie = struct.pack("<I", random.randrange(10**6, 2**32))
    lying, oversized = whole[:TEXT_AT] + lie + whole[TEXT_AT + 4 :], whole + bytes(100_000)
    return RawJoy(random.choice((whole[: random.randrange(len(whole))], noise, lying, oversized)))


def says(topic, message_class, make):
    """Return what lets another program publish messages that it makes, and what ends it."""
    over = threading.Event()

    def say(random):
        with contextlib.suppress(OSError, rospy.ROSException):  # its master may be gone
            publisher = rospy.Publisher(topic, message_class, queue_size=10)
            while not over.wait(PERIOD_S):
                publisher.publish(make(random))
            publisher.unregister()

    def begin(world):
        over.clear()
        threading.Thread(target=say, args=(Random(world.seed),), daemon=True).start()

    return begin, lambda _: over.set()


def ends(node, number):
    """Return what ends a node by a signal, and what restarts it."""
    return lambda world: world.signal(node, number), lambda world: world.restart(node)


def between(act_of, begin, end):
    """Return what calls act_of(world) with one value, and what calls it with another one."""
    return lambda world: act_of(world)(begin), lambda world: act_of(world)(end)


def stops(part):
    """Return what suspends a process, and what lets it go on."""
    return between(lambda world: partial(world.signal, part), signal.SIGSTOP, signal.SIGCONT)


def rows():
    """Yield the rows."""
    for name, node in NODES.items():
        yield Fault("kill", name, (0.05, 0.7), RESTS, *ends(node, signal.SIGKILL))
        yield Fault("end", name, (0.05, 0.7), RESTS, *ends(node, signal.SIGINT))
        yield Fault("stop", name, (0.02, 1.5), RESTS, *stops(node))
    plug = between(lambda world: world.hands.plug, False, True)
    freeze = between(lambda world: world.hands.freeze, True, False)
    nan = lambda random: Twist(linear=Vector3(x=random.choice(ODD[:3])))  # noqa: E731
    broken = lambda random: RawTwist(random.choice(BROKEN))  # noqa: E731
    yield Fault("unplug", "gamepad", (0.02, 1.2), RESTS, *plug)
    yield Fault("stop", "gamepad", (0.7, 1.5), RESTS, *freeze)
    # Out of reach: the receiver keeps the last state, and only joy2twist can notice.
    yield Fault("silence", "gamepad", (0.1, 2.5), RESTS, *freeze, late_s=VIGILANCE_S)
    yield Fault("second", "joy", (0.1, 1.0), WAITS, *says("joy", Joy, lambda _: HELD))
    yield Fault("odd", "joy", (0.1, 1.0), MAY_STOP, *says("joy", Joy, odd_joy))
    yield Fault("broken", "joy", (0.1, 1.0), MAY_STOP, *says("joy", RawJoy, broken_joy))
    for name, topic in {"teleop": TELEOP, "navi": NAVI, "cmd_vel": "cmd_vel"}.items():
        yield Fault("nan", name, (0.1, 1.0), DRIVES_ON, *says(topic, Twist, nan))
        yield Fault("broken", name, (0.1, 1.0), DRIVES_ON, *says(topic, RawTwist, broken))
    yield Fault("stop", "master", (0.1, 1.5), DRIVES_ON, *stops("master"))
    yield Fault("stop", "viewer", (0.1, 1.5), DRIVES_ON, *stops("viewer"))


FAULTS = {fault.name: fault for fault in rows()}
