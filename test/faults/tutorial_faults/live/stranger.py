"""Somebody else on the robot's master, who says what nobody should, or listens and does not read.

Told by lines: `say KIND SECONDS` (see SAYINGS), and `slow SECONDS` (how long its callbacks take).
"""

import math
import struct
import sys
import threading
import time

import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Joy

PERIOD_S = 0.05
INPUTS = {
    "teleop": "cmd_vel_mux/input/teleop",
    "navi": "cmd_vel_mux/input/navi",
    "cmd_vel": "cmd_vel",
}


class Raw:
    """The bytes of a message, as they go over the wire after its length."""

    def __init__(self, data=b""):
        super().__init__()
        self._data = data

    def serialize(self, buff):
        buff.write(self._data)


class RawJoy(Raw, Joy):
    """A Joy of any bytes."""


class RawTwist(Raw, Twist):
    """A Twist of any bytes."""


def twist(x=0.0, y=0.0, z=0.0):
    message = Twist()
    message.linear.x, message.linear.y, message.angular.z = x, y, z
    return message


_JOY_HEAD = struct.pack("<IIII", 0, 0, 0, 0)  # sequence, stamp, no frame_id
HELD = Joy(axes=[0.0, 1.0, 0.0, 0.0, 0.0, 0.0], buttons=[0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0])
NAN_JOYS = [
    Joy(axes=[math.nan] * 6, buttons=HELD.buttons),
    Joy(axes=[0.0, math.inf, 0.0, 0.0, 0.0, 0.0], buttons=HELD.buttons),
    Joy(axes=[1.0], buttons=[]),
]
BROKEN_JOYS = [
    RawJoy(b""),
    RawJoy(_JOY_HEAD[:7]),
    RawJoy(_JOY_HEAD + struct.pack("<I", 2**31)),
    RawJoy(_JOY_HEAD[:12] + struct.pack("<I", 10**6)),
    RawJoy(_JOY_HEAD + bytes(100_000)),
]
NAN_TWISTS = [twist(x=math.nan), twist(z=math.inf), twist(x=-math.inf, y=math.nan)]
# Of what is too long rospy reads the beginning: here NaN, as zeros would be a command to stop.
BROKEN_TWISTS = [RawTwist(b""), RawTwist(bytes(20)), RawTwist(b"\xff" * 100_000)]


def sayings():
    """From a kind to (topic, type, messages)."""
    yield "second_joystick", ("joy", Joy, [HELD])
    yield "nan_joy", ("joy", Joy, NAN_JOYS)
    yield "broken_joy", ("joy", RawJoy, BROKEN_JOYS)
    # Sideways, where no wheel turns to: it is seen to go through, and moves nothing.
    yield "lower_input", (INPUTS["navi"], Twist, [twist(y=0.1)])
    for name, topic in INPUTS.items():
        yield f"nan_command:{name}", (topic, Twist, NAN_TWISTS)
        yield f"broken_command:{name}", (topic, RawTwist, BROKEN_TWISTS)


SAYINGS = dict(sayings())


def say(kind, seconds):
    """Say it all the time, on a topic advertised for this."""
    topic, message_class, messages = SAYINGS[kind]
    until, number = time.monotonic() + seconds, 0
    publisher = rospy.Publisher(topic, message_class, queue_size=10)
    while time.monotonic() < until:
        publisher.publish(messages[number % len(messages)])
        number += 1
        time.sleep(PERIOD_S)
    publisher.unregister()


def main():
    """Do as told until the standard input ends."""
    rospy.init_node("stranger", anonymous=True, disable_signals=True, disable_rosout=True)
    slow_s = [0.0]
    for topic, message_class in (
        ("odom", Odometry), ("joy", Joy), *[(topic, Twist) for topic in INPUTS.values()],
    ):  # fmt: skip
        if "--listens" in sys.argv:
            rospy.Subscriber(topic, message_class, lambda _: time.sleep(slow_s[0]), queue_size=10)
    print("ready", flush=True)
    for line in sys.stdin:
        word, *rest = line.split()
        if word == "slow":
            slow_s[0] = float(rest[0])
        else:
            threading.Thread(target=say, args=(rest[0], float(rest[1])), daemon=True).start()


if __name__ == "__main__":
    main()
