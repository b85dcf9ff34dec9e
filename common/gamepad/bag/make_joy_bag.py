"""Write joy.bag: a Logitech F710 (D mode) whose left stick drives a closed tour.

    ./tutorial run python3 common/gamepad/bag/make_joy_bag.py [FILE]

The default FILE is joy.bag beside this script.

The tour: a figure of eight, a turn on the spot, a way back and forth. It ends where it began, so
that `rosbag play --loop` traces it again and again. Driven at scale 1, as the handout's node does,
axis 1 is the forward speed in m/s and axis 0 the turn rate in rad/s. The same bytes come out on
every machine: no clock and no random number is read.
"""

import math
import sys
from pathlib import Path

import numpy as np
from rosbags.rosbag1 import Writer
from rosbags.typesys import Stores, get_typestore
from sensor_msgs.msg import Joy

RATE_HZ = 50  # messages, as from a hand that never rests
START_S = 1372636800  # stamp of the first message: 2013-07-01, the month of the workshop
FRAME_ID = "/dev/input/js0"  # what joy_node writes: the device
JS_FULL = 32767  # a stick at its end, in the events of the Linux joystick device
LB = 4  # the dead-man button of the F710
AXES, BUTTONS = 6, 12  # the F710 in D mode

# A heading that swings as 1 - cos closes to a figure of eight if the swing's half height [rad] is
# the first zero of the Bessel function J0 (Abramowitz and Stegun, table 9.5).
EIGHT_SWING_RAD = 2.404825557695773
EIGHT_LENGTH_M = 13.5
BACK_M = 1.2


def progress(time_s, duration_s, ramp_s):
    """Return how much of a move is done at a time: 0 to 1, starting and ending at rest.

    The speed rises and falls as a half cosine over ramp_s and is constant between.
    """

    def ramp(t):  # integral of (1 - cos(pi t / ramp_s)) / 2
        return t / 2 - ramp_s / (2 * math.pi) * math.sin(math.pi * t / ramp_s)

    if time_s <= ramp_s:
        done = ramp(time_s)
    elif time_s <= duration_s - ramp_s:
        done = ramp_s / 2 + (time_s - ramp_s)
    else:
        done = duration_s - ramp_s - ramp(duration_s - time_s)
    return done / (duration_s - ramp_s)


def eight(done):
    """Return (distance [m], heading [rad]) along the figure of eight. done: 0 to 1."""
    return EIGHT_LENGTH_M * done, EIGHT_SWING_RAD * (1 - math.cos(2 * math.pi * done))


def spin(done):
    """Return (distance [m], heading [rad]) of a turn on the spot, to the left. done: 0 to 1."""
    return 0.0, 2 * math.pi * done


def straight(length_m):
    """Return a move: (distance [m], heading [rad]) straight ahead, or back if negative."""
    return lambda done: (length_m * done, 0.0)


# The moves with their time and the time of their ramps, in seconds.
TOUR = (
    (eight, 30.0, 2.0),
    (spin, 9.0, 1.5),
    (straight(-BACK_M), 5.0, 1.0),
    (straight(BACK_M), 5.0, 1.0),
)


def sticks():
    """Yield (forward [m/s], turn [rad/s], LB held) for every message of the tour."""

    def rest(seconds, held):
        return [(0.0, 0.0, held)] * round(seconds * RATE_HZ)

    yield from rest(1.0, held=False)
    for move, duration_s, ramp_s in TOUR:
        yield from rest(0.3, held=True)
        distance, heading = move(0.0)
        for step in range(1, round(duration_s * RATE_HZ) + 1):
            # A command holds until the next one: the mean over the step gives the exact advance.
            end = move(progress(step / RATE_HZ, duration_s, ramp_s))
            yield (end[0] - distance) * RATE_HZ, (end[1] - heading) * RATE_HZ, True
            distance, heading = end
        yield from rest(0.3, held=True)
        yield from rest(0.7, held=False)


def axis(value, count):
    """Return what joy_node publishes for a stick position: one of the steps of the Linux device.

    Values are rounded down and up in turn, as a hand that holds a stick trembles.
    """
    return math.floor(value * JS_FULL + count % 2) / JS_FULL if value else 0.0


def write_bag(path):
    """Write the bag to a path that does not exist yet."""
    store = get_typestore(Stores.ROS1_NOETIC)
    joy_type = "sensor_msgs/msg/Joy"
    make = store.types
    bag = Writer(path)
    bag.set_compression(Writer.CompressionFormat.BZ2)
    with bag:
        # The definition as ROS itself records it, with which `rosbag check` compares.
        connection = bag.add_connection("/joy", joy_type, msgdef=Joy._full_text, md5sum=Joy._md5sum)
        for count, (forward, turn, held) in enumerate(sticks()):
            stamp_ns = START_S * 10**9 + count * 10**9 // RATE_HZ
            stamp = make["builtin_interfaces/msg/Time"](*divmod(stamp_ns, 10**9))
            axes = np.zeros(AXES, np.float32)
            axes[1], axes[0] = axis(forward, count), axis(turn, count)
            buttons = np.zeros(BUTTONS, np.int32)
            buttons[LB] = held
            header = make["std_msgs/msg/Header"](seq=count, stamp=stamp, frame_id=FRAME_ID)
            message = make[joy_type](header=header, axes=axes, buttons=buttons)
            bag.write(connection, stamp_ns, store.serialize_ros1(message, joy_type))


def main():
    path = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).with_name("joy.bag")
    path.unlink(missing_ok=True)
    write_bag(path)
    print(f"{path}: {path.stat().st_size} bytes")


if __name__ == "__main__":
    main()
