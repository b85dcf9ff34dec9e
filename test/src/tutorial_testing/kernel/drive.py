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
from sensor_msgs.msg import Joy

from gamepad.gamepads import F710_D, F710_X
from gamepad.virtual.controls import Controls, positions
from gamepad.virtual.pads import UinputPad
from tutorial_testing.nodes import init_node
from tutorial_testing.processes import Program
from tutorial_testing.robot import PERIOD_S, Robot
from tutorial_testing.waiting import wait_for

DEVICE = Path("/dev/input/js0")
DEADLINE_S = 90.0  # of the guest's time: an emulated processor is some ten times slower
PROMPT_S = 0.1  # how soon a released dead-man or a lost gamepad must have its effect
DEADZONE = 0.05
METRES_PER_S = 0.35  # at full deflection: config/f710_d.yaml
STICKS = (  # some in the deadzone, some at the ends
    (0.0, 0.0), (1.0, -1.0), (0.02, -0.04), (0.06, -0.5), (-1.0, 1.0), (0.33, 0.77), (0.0, 0.0),
)  # fmt: skip
FORWARD = Controls(left_stick=(0.0, 1.0))
HELD = Controls(left_stick=(0.0, 1.0), held=frozenset(["LB"]))


def report(text):
    print(f"drive: {text}", flush=True)


def wait(condition, what):
    return wait_for(condition, what, DEADLINE_S)


class RawReader:
    """The newest state of the joystick device, read beside the driver."""

    def __init__(self):
        self.axes, self.buttons = {}, {}
        self.lost = False  # whether the kernel reported to this reader that the gamepad is gone
        self._file = DEVICE.open("rb", buffering=0)
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self):
        try:
            while True:
                _, value, kind, number = struct.unpack("=IhBB", self._file.read(8))
                (self.buttons if kind & 1 else self.axes)[number] = value
        except OSError:
            self.lost = True

    def values(self):
        """Return the axes as the kernel has them."""
        return [self.axes[n] for n in sorted(self.axes)]

    def is_as_on(self, joy):
        """Return whether joy_node published this state, but for rounding to 32 bits."""
        axes, buttons = map(scaled, self.values()), [self.buttons[n] for n in sorted(self.buttons)]
        close = all(abs(a - b) < 1e-7 for a, b in zip(joy.axes, axes))
        return close and len(joy.axes) == len(self.axes) and list(joy.buttons) == buttons


def scaled(value):
    """Return an axis on /joy, from the value of the kernel."""
    size = max(0.0, abs(value) - 32767 * DEADZONE) / (32767 * (1 - DEADZONE))
    return math.copysign(size, -value)


class Driven(Robot):
    """The robot, and the messages of /joy, oldest first."""

    def begin(self):
        self.joy = []
        rospy.Subscriber("joy", Joy, self.joy.append)
        self.listen()

    def check_stands(self, since, what):
        """The robot stood soon after a time [s]."""
        took_s = self.wait_for_rest(since) - since
        report(f"{what}: the robot stands after {1e3 * took_s:.0f} ms")
        assert took_s < PROMPT_S + PERIOD_S


def check_positions(pad, raw, robot):
    """Every position appears on /joy exactly as the kernel reports it."""
    for stick in STICKS:
        for controls in (
            Controls(left_stick=stick, right_stick=stick[::-1]),
            Controls(dpad=(round(stick[1]), round(stick[0])), held=frozenset(["X", "RIGHT"])),
        ):
            axes, buttons = positions(F710_D, controls)
            pad.show((axes, buttons))
            values = [axis.js_value(axis.raw(p)) for axis, p in zip(F710_D.axes, axes)]
            wait(lambda values=values: raw.values() == values, f"events with {values}")
            wait(lambda: raw.is_as_on(robot.joy[-1]), "same state on /joy")
    report(
        f"{2 * len(STICKS)} positions of 6 axes and 12 buttons are on /joy as the kernel has them"
    )


def drive(pad, robot):
    """Let go of everything, then drive forward."""
    pad.show(positions(F710_D, Controls()))
    wait(lambda: not any((*robot.joy[-1].buttons, *robot.joy[-1].axes)), "released gamepad")
    pad.show(positions(F710_D, HELD))
    wait(lambda: abs(robot.now.v - METRES_PER_S) < 1e-6, f"speed {METRES_PER_S} m/s")


def check_unplugged(pad, raw, launch, robot):
    """Neutral at once, no other gamepad, and no motion before neutral was seen again."""
    seen, since = len(robot.joy), time.time()
    pad.show(None)
    wait(lambda: raw.lost, "end of the raw stream")
    robot.check_stands(since, "unplugged while driving")
    neutral = next(joy for joy in robot.joy[seen:] if not any(joy.axes) and not any(joy.buttons))
    delay_s = neutral.header.stamp.to_sec() - since
    report(f"neutral message after {1e3 * delay_s:.0f} ms")
    assert delay_s < PROMPT_S and robot.joy[-1] is neutral

    with UinputPad(F710_X) as other:
        wait(DEVICE.exists, "other gamepad")
        other.show(positions(F710_X, HELD))
        wait(lambda: "is now" in launch.output, "refusal of the other gamepad")
        assert robot.joy[-1] is neutral and not robot.moves
    wait(lambda: not DEVICE.exists(), "end of the other gamepad")
    report("another gamepad in its place was not opened")

    pad.show(positions(F710_D, HELD))  # while it is plugged in
    wait(lambda: launch.output.count("Opened joystick") == 2, "reconnection")
    count = len(robot.joy)
    pad.show(positions(F710_D, Controls(left_stick=(0.0, 0.5), held=HELD.held)))
    wait(lambda: len(robot.joy) > count + 20, "messages")
    assert robot.joy[-1].axes[1] > 0 and robot.joy[-1].buttons[4]
    assert not any(moment.moves for moment in robot.odometry[-20:])
    report("plugged in with LB held and the stick pushed: nothing moves")


def check_all(pad, raw, launch):
    """Check what the launch file's nodes make of the gamepad."""
    wait(lambda: "Opened joystick" in launch.output, "driver")
    init_node("drive")
    robot = Driven().__enter__()  # to the end of this program
    wait(lambda: robot.joy and robot.odometry, "joystick and robot")
    wait(lambda: "This is a Logitech F710 in D mode" in launch.output, "line on the mode")
    check_positions(pad, raw, robot)
    drive(pad, robot)
    since = time.time()
    pad.show(positions(F710_D, FORWARD))
    robot.check_stands(since, "LB released")
    drive(pad, robot)
    check_unplugged(pad, raw, launch, robot)
    drive(pad, robot)
    report("released and held again: it drives")
    rospy.signal_shutdown("done")
    launch.interrupt()
    assert launch.wait(DEADLINE_S) == 0
    assert "Traceback" not in launch.output


def main():
    """Run all checks."""
    report(f"Linux {platform.release()}, {platform.machine()}")
    with UinputPad(F710_D) as pad:
        # udev grants the right to read it a little later.
        wait(lambda: os.access(DEVICE, os.R_OK), f"{DEVICE} to be read")
        raw = RawReader()
        with Program("roslaunch", "joy2twist", "launch_joy_node.launch", "rviz:=false") as launch:
            try:
                check_all(pad, raw, launch)
            except BaseException:
                print(launch.output)
                raise
    report("passed")


if __name__ == "__main__":
    main()
