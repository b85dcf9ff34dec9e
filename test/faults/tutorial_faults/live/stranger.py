"""Another program on the robot's master: it sends what it should not, or listens without reading.

It reads lines `KIND SECONDS`, see sayings().
"""

import io
import math
import struct
import sys
import threading
import time
from random import Random

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
LB, RB = 4, 5
ODD = (math.nan, math.inf, -math.inf, 0.0, 1.0, -1.0, 1e38, 1e-45, 2.0, 1e6)
TEXT_AT = 12  # in a serialized Joy: where the length of its frame_id stands


class Raw:
    """The bytes of a message, as they go over the wire after its length."""

    def __init__(self, data=b""):
        super().__init__()
        self._data = data

    def serialize(self, buff):
        buff.write(self._data)


RawJoy = type("RawJoy", (Raw, Joy), {})
RawTwist = type("RawTwist", (Raw, Twist), {})


def odd_joy(random):
    """Return a Joy of any shape and any values that holds no dead-man button."""
    axes = random.choice((6, 6, 8, 0, 1, 2, random.randrange(40)))
    buttons = [random.choice((0, 1, -1, 2**31 - 1)) for _ in range(random.choice((12, 12, 5, 0)))]
    buttons[LB : RB + 1] = [0] * len(buttons[LB : RB + 1])
    odd = random.random() < 0.5
    values = [random.choice(ODD) if odd else random.uniform(-1, 1) for _ in range(axes)]
    return Joy(axes=values, buttons=buttons)


def broken_joy(random):
    """Return a Joy that cannot be read: cut, with a length that lies, noise, or oversized."""
    buff = io.BytesIO()
    odd_joy(random).serialize(buff)
    whole = buff.getvalue()
    lie = struct.pack("<I", random.randrange(10**6, 2**32))
    cut = whole[: random.randrange(len(whole))]
    noise = random.getrandbits(800).to_bytes(100, "little")
    lying, oversized = whole[:TEXT_AT] + lie + whole[TEXT_AT + 4 :], whole + bytes(100_000)
    return RawJoy(random.choice((cut, noise, lying, oversized)))


def twist(x=0.0, y=0.0, z=0.0):
    message = Twist()
    message.linear.x, message.linear.y, message.angular.z = x, y, z
    return message


HELD = Joy(axes=[0.0, 1.0, 0.0, 0.0, 0.0, 0.0], buttons=[0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0])
NAN_TWISTS = [twist(x=math.nan), twist(z=math.inf), twist(x=-math.inf, y=math.nan)]
# Of what is too long rospy reads the beginning: here NaN, as zeros would be a command to stop.
BROKEN_TWISTS = [RawTwist(b""), RawTwist(bytes(20)), RawTwist(b"\xff" * 100_000)]


def sayings():
    """Yield a kind and its (topic, type, function from a random.Random to a message)."""
    yield "second_joystick", ("joy", Joy, lambda random: HELD)
    yield "odd_joy", ("joy", Joy, odd_joy)
    yield "broken_joy", ("joy", RawJoy, broken_joy)
    # Sideways, where no wheel turns to: it is seen to pass, and moves nothing.
    yield "lower_input", (INPUTS["navi"], Twist, lambda random: twist(y=0.1))
    for name, topic in INPUTS.items():
        yield f"nan_command:{name}", (topic, Twist, lambda random: random.choice(NAN_TWISTS))
        broken = (topic, RawTwist, lambda random: random.choice(BROKEN_TWISTS))
        yield f"broken_command:{name}", broken


SAYINGS = dict(sayings())


def say(kind, seconds):
    """Publish for so long, on a topic advertised for this."""
    topic, message_class, make = SAYINGS[kind]
    until, random = time.monotonic() + seconds, Random(f"{kind} {seconds}")
    publisher = rospy.Publisher(topic, message_class, queue_size=10)
    while time.monotonic() < until:
        publisher.publish(make(random))
        time.sleep(PERIOD_S)
    publisher.unregister()


def main():
    """Obey the lines until the standard input ends."""
    rospy.init_node("stranger", anonymous=True, disable_signals=True, disable_rosout=True)
    topics = {"odom": Odometry, "joy": Joy, **dict.fromkeys(INPUTS.values(), Twist)}
    if "--listens" in sys.argv:
        for topic, message_class in topics.items():
            rospy.Subscriber(topic, message_class, queue_size=10)
    print("ready", flush=True)
    for line in sys.stdin:
        kind, seconds = line.split()
        threading.Thread(target=say, args=(kind, float(seconds)), daemon=True).start()


if __name__ == "__main__":
    main()
