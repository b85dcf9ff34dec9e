"""A virtual F710 in the kernel drives the simulated robot through launch_joy_node.launch.

Starts its own master. Prints what it finds in lines that begin with "drive: ", the last of them
"drive: passed"; any failure is an exception.
"""

import math
import os
import platform
import struct
import threading
import time
from pathlib import Path

import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Joy

from gamepad.gamepads import F710_D, F710_X
from gamepad.virtual.controls import Controls, positions
from gamepad.virtual.pads import UinputPad
from tutorial_testing.nodes import init_node
from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for

DEVICE = Path("/dev/input/js0")
DEADLINE_S = 90.0  # of the guest's time: an emulated processor is some ten times slower
PROMPT_S = 0.1  # how soon a released dead-man or a lost gamepad must have its effect
VIGILANCE_S = 3.0  # of launch_joy_node.launch
DEADZONE = 0.05
METRES_PER_S, RADIANS_PER_S = 0.35, 1.2  # at full deflection: config/f710_d.yaml
STICKS = (  # some in the deadzone, some at the ends
    (0.0, 0.0), (1.0, -1.0), (0.02, -0.04), (0.06, -0.5), (-1.0, 1.0), (0.33, 0.77), (0.0, 0.0),
)  # fmt: skip
LB = frozenset(["LB"])


def tell(text):
    print(f"drive: {text}", flush=True)


class RawReader:
    """The newest state of the joystick device, read beside the driver."""

    def __init__(self):
        self.axes, self.buttons = {}, {}
        self.lost = False  # whether the kernel told this reader that the gamepad is gone
        self._file = DEVICE.open("rb", buffering=0)
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self):
        try:
            while True:
                _, value, kind, number = struct.unpack("=IhBB", self._file.read(8))
                (self.buttons if kind & 1 else self.axes)[number] = value
        except OSError:
            self.lost = True

    @property
    def as_on_joy(self):
        """(axes, buttons) as joy_node must publish them, but for rounding to 32 bits."""
        return (
            [scaled(self.axes[n]) for n in sorted(self.axes)],
            [self.buttons[n] for n in sorted(self.buttons)],
        )


def scaled(value):
    """An axis on /joy, from the value of the kernel."""
    size = max(0.0, abs(value) - 32767 * DEADZONE) / (32767 * (1 - DEADZONE))
    return math.copysign(size, -value)


class Robot:
    """The messages of /joy and /odom, oldest first."""

    def __init__(self):
        self.joy, self.odometry = [], []
        rospy.Subscriber("joy", Joy, self.joy.append)
        rospy.Subscriber("odom", Odometry, self.odometry.append)

    @property
    def speed(self):
        """(forward [m/s], turn [rad/s]) of the newest odometry."""
        twist = self.odometry[-1].twist.twist
        return twist.linear.x, twist.angular.z

    @property
    def stands(self):
        return self.speed == (0.0, 0.0)


def check_positions(pad, raw, robot):
    """Every position appears on /joy exactly as the kernel tells it."""
    for stick in STICKS:
        for controls in (
            Controls(left_stick=stick, right_stick=stick[::-1]),
            Controls(dpad=(round(stick[1]), round(stick[0])), held=frozenset(["X", "RIGHT"])),
        ):
            axes, buttons = positions(F710_D, controls)
            pad.show((axes, buttons))
            values = [axis.js_value(axis.raw(p)) for axis, p in zip(F710_D.axes, axes)]
            wait_for(
                lambda values=values: [raw.axes[n] for n in sorted(raw.axes)] == values,
                f"events of the kernel with {values}", DEADLINE_S,
            )  # fmt: skip
            wait_for(lambda: same(robot.joy[-1], raw.as_on_joy), "same state on /joy", DEADLINE_S)
    tell(f"{2 * len(STICKS)} positions of 6 axes and 12 buttons are on /joy as the kernel has them")


def same(joy, expected):
    axes, buttons = expected
    close = [abs(a - b) < 1e-7 for a, b in zip(joy.axes, axes)]
    return len(joy.axes) == len(axes) and all(close) and list(joy.buttons) == buttons


def check_drive(pad, robot, stick):
    """The robot drives as the stick says: the closed form of an arc, between two odometries."""
    pad.show(positions(F710_D, Controls(left_stick=stick, held=LB)))
    turn, forward = [
        full * scaled(axis.js_value(axis.raw(p)))
        for full, axis, p in zip((RADIANS_PER_S, METRES_PER_S), F710_D.axes, stick)
    ]
    wait_for(
        lambda: math.dist(robot.speed, (forward, turn)) < 1e-6,
        f"speed {forward:.3f} m/s, {turn:.3f} rad/s", DEADLINE_S,
    )  # fmt: skip
    first = robot.odometry[-1]
    wait_for(lambda: seconds_between(first, robot.odometry[-1]) > 1.0, "second", DEADLINE_S)
    last = robot.odometry[-1]
    time_s = seconds_between(first, last)
    angle = turn * time_s
    chord = forward * time_s * (math.sin(angle / 2) / (angle / 2) if angle else 1.0)
    a, b = first.pose.pose.position, last.pose.pose.position
    error_m = abs(math.hypot(b.x - a.x, b.y - a.y) - abs(chord))
    turned = 2 * (heading_half(last) - heading_half(first))
    error_rad = abs(math.remainder(turned - angle, 2 * math.pi))
    tell(
        f"stick {stick}: {time_s:.2f} s at {forward:.3f} m/s, {turn:.3f} rad/s; off the closed "
        f"form by {error_m:.1e} m, {error_rad:.1e} rad"
    )
    assert error_m < 1e-3 and error_rad < 1e-3


def seconds_between(first, last):
    return (last.header.stamp - first.header.stamp).to_sec()


def heading_half(odometry):
    q = odometry.pose.pose.orientation
    return math.atan2(q.z, q.w)


def check_stands(robot, since, what):
    """The robot stood within 100 ms since a time [s]."""
    wait_for(lambda: robot.stands, "standing robot", DEADLINE_S)
    moving = [m for m in robot.odometry if m.twist.twist != Twist()]
    stood = next(
        stamp
        for stamp in [m.header.stamp.to_sec() for m in robot.odometry]
        if stamp > moving[-1].header.stamp.to_sec()
    )
    tell(f"{what}: the robot stands after {1e3 * (stood - since):.0f} ms")
    assert stood - since < PROMPT_S


def check_released(pad, robot):
    """Without the dead-man the robot stands, though the stick is pushed."""
    since = time.time()
    pad.show(positions(F710_D, Controls(left_stick=(0.0, 1.0))))
    check_stands(robot, since, "LB released")


def release(pad, robot):
    """Let go of everything, and wait until that was published."""
    pad.show(positions(F710_D, Controls()))
    wait_for(
        lambda: not any((*robot.joy[-1].buttons, *robot.joy[-1].axes)), "released gamepad",
        DEADLINE_S,
    )  # fmt: skip


def check_radio_silence(pad, launch, robot):
    """A gamepad out of reach: the kernel keeps its last state, and no event comes any more."""
    since = time.time()
    pad.show(positions(F710_D, Controls(left_stick=(0.0, 0.9), held=LB)))
    wait_for(lambda: not robot.stands, "moving robot", DEADLINE_S)
    wait_for(lambda: robot.stands, "standing robot", DEADLINE_S)
    moved = [m.header.stamp.to_sec() for m in robot.odometry if m.twist.twist != Twist()]
    tell(f"radio silence: the robot stands after {moved[-1] - since:.2f} s")
    assert VIGILANCE_S - PROMPT_S < moved[-1] - since < VIGILANCE_S + 0.6 + PROMPT_S
    assert "does not change" in launch.output
    seen = len(robot.odometry)
    pad.show(positions(F710_D, Controls(left_stick=(0.0, 1.0), held=LB)))  # back in reach
    wait_for(lambda: len(robot.odometry) > seen + 50, "odometry", DEADLINE_S)
    assert all(m.twist.twist == Twist() for m in robot.odometry[seen:])
    tell("back in reach with LB held: nothing moves")
    release(pad, robot)


def check_unplugged(pad, raw, launch, robot):
    """Neutral at once, no other gamepad, and no motion before neutral was seen again."""
    pushed = positions(F710_D, Controls(left_stick=(0.0, 1.0), held=LB))
    seen, since = len(robot.joy), time.time()
    pad.show(None)
    wait_for(lambda: raw.lost, "end of the raw stream", DEADLINE_S)
    check_stands(robot, since, "unplugged while driving")
    neutral = next(joy for joy in robot.joy[seen:] if not any(joy.axes) and not any(joy.buttons))
    delay_s = neutral.header.stamp.to_sec() - since
    tell(f"neutral message after {1e3 * delay_s:.0f} ms")
    assert delay_s < PROMPT_S and robot.joy[-1] is neutral

    with UinputPad(F710_X) as other:
        wait_for(DEVICE.exists, "other gamepad", DEADLINE_S)
        other.show(positions(F710_X, Controls(left_stick=(0.0, 1.0), held=LB)))
        wait_for(lambda: "is now" in launch.output, "refusal of the other gamepad", DEADLINE_S)
        assert robot.joy[-1] is neutral and robot.stands
    wait_for(lambda: not DEVICE.exists(), "end of the other gamepad", DEADLINE_S)
    tell("another gamepad in its place was not opened")

    pad.show(pushed)  # the stick pushed and LB held while it is plugged in
    wait_for(lambda: launch.output.count("Opened joystick") == 2, "reconnection", DEADLINE_S)
    count = len(robot.joy)
    pad.show(positions(F710_D, Controls(left_stick=(0.0, 0.5), held=LB)))
    wait_for(lambda: len(robot.joy) > count + 20, "messages", DEADLINE_S)
    assert robot.joy[-1].axes[1] > 0 and robot.joy[-1].buttons[4]
    assert robot.stands and all(m.twist.twist.linear.x == 0 for m in robot.odometry[-20:])
    tell("plugged in with LB held and the stick pushed: nothing moves")
    release(pad, robot)


def check_all(pad, raw, launch):
    """What the launch file's nodes make of the gamepad."""
    wait_for(lambda: "Opened joystick" in launch.output, "driver", DEADLINE_S)
    init_node("drive")
    robot = Robot()
    wait_for(lambda: robot.joy and robot.odometry, "joystick and robot", DEADLINE_S)
    hint = "This is a Logitech F710 in D mode"
    wait_for(lambda: hint in launch.output, "line on the mode", DEADLINE_S)
    check_positions(pad, raw, robot)
    for stick in ((0.0, 0.5), (0.4, 1.0), (-1.0, 0.0)):
        check_drive(pad, robot, stick)
    check_drive(pad, robot, (0.0, 1.0))
    check_released(pad, robot)
    check_drive(pad, robot, (0.0, 1.0))
    check_radio_silence(pad, launch, robot)
    check_drive(pad, robot, (0.0, 1.0))
    check_unplugged(pad, raw, launch, robot)
    check_drive(pad, robot, (0.0, 1.0))
    rospy.signal_shutdown("done")
    launch.interrupt()
    assert launch.wait(DEADLINE_S) == 0
    assert "Traceback" not in launch.output


def main():
    tell(f"Linux {platform.release()}, {platform.machine()}")
    with UinputPad(F710_D) as pad:
        # udev gives the right to read it a little later.
        wait_for(lambda: os.access(DEVICE, os.R_OK), f"{DEVICE} to be read", DEADLINE_S)
        raw = RawReader()
        with Program("roslaunch", "joy2twist", "launch_joy_node.launch", "rviz:=false") as launch:
            try:
                check_all(pad, raw, launch)
            except BaseException:
                print(launch.output)
                raise
    tell("passed")


if __name__ == "__main__":
    main()
