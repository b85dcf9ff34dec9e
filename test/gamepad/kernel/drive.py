"""A virtual F710 in the kernel drives the simulated robot through launch_joy_node.launch."""

import time
from math import copysign
from pathlib import Path

import numpy as np
import rospy
from sensor_msgs.msg import Joy

from gamepad.gamepads import F710_D, F710_X
from gamepad.io.pads import UinputPad
from gamepad.virtual.controls import Controls, positions
from tutorial_testing.nodes import init_node
from tutorial_testing.processes import Program
from tutorial_testing.robot import PERIOD_S, Robot
from tutorial_testing.waiting import tolerance, wait_for

DEVICE = Path("/dev/input/js0")
COMMAND = ("roslaunch", "joy2twist", "launch_joy_node.launch", "rviz:=false")
PROMPT_S = 0.1  # until a released LB or a lost gamepad has its effect
DEADZONE, METRES_PER_S = 0.05, 0.35  # the latter at full deflection: config/f710_d.yaml
FORWARD = Controls(left_stick=(0.0, 1.0))
HELD = Controls(left_stick=(0.0, 1.0), held=frozenset(["LB"]))
SHOWN = (
    Controls(dpad=(1, -1), held=frozenset(["X", "RIGHT"])),
    Controls(left_stick=(0.02, -0.04), right_stick=(0.33, 0.77)),
    Controls(left_stick=(1.0, -1.0), right_stick=(-0.5, 0.06)),
)


def check_stop(robot, end, within_s):
    """Check that the robot is at rest soon after end() was called."""
    since, late_s = time.time(), tolerance()
    end()
    assert robot.wait_for_rest(since) - since < within_s + PERIOD_S + late_s()


def show_on_joy(pad, joy, controls):
    """Hold a position, and wait for it on /joy, as the kernel rounds it."""
    axes, buttons = positions(F710_D, controls)
    pad.show((axes, buttons))
    raw = [-axis.js_value(axis.raw(place)) / 32767 for axis, place in zip(F710_D.axes, axes)]
    axes = [copysign(max(0.0, abs(axis) - DEADZONE) / (1 - DEADZONE), axis) for axis in raw]
    shown = [*axes, *buttons]
    seen = lambda: np.allclose([*joy[-1].axes, *joy[-1].buttons], shown, atol=1e-7)  # noqa: E731
    wait_for(seen, f"{shown} on /joy")


def drive(pad, robot, joy):
    """Release all, then drive forward."""
    show_on_joy(pad, joy, Controls())
    pad.show(positions(F710_D, HELD))
    wait_for(lambda: abs(robot.now.v - METRES_PER_S) < 1e-6, f"speed {METRES_PER_S} m/s")


def check_unplugged(pad, launch, robot, joy):
    """Check a lost gamepad: neutral at once, no other gamepad, no motion before neutral again."""
    drive(pad, robot, joy)
    check_stop(robot, lambda: pad.show(None), PROMPT_S)
    neutral = joy[-1]
    assert not any((*neutral.axes, *neutral.buttons))
    wait_for(lambda: not DEVICE.exists(), "end of the device")
    with UinputPad(F710_X) as other:
        wait_for(DEVICE.exists, "other gamepad")
        other.show(positions(F710_X, HELD))
        wait_for(lambda: "is now" in launch.output, "refusal of the other gamepad")
        assert joy[-1] is neutral and not robot.moves
    wait_for(lambda: not DEVICE.exists(), "end of the other gamepad")
    pad.show(positions(F710_D, HELD))  # while it is plugged in
    wait_for(lambda: launch.output.count("Opened joystick") == 2, "reconnection")
    show_on_joy(pad, joy, Controls(left_stick=(0.0, 0.5), held=HELD.held))
    assert robot.stays_at_rest()


if __name__ == "__main__":
    with UinputPad(F710_D) as pad, Program(*COMMAND) as launch:
        wait_for(lambda: "F710 in D mode" in launch.output, "line on the mode")
        init_node("drive")
        joy = []
        rospy.Subscriber("joy", Joy, joy.append)
        with Robot() as robot:
            wait_for(lambda: joy and robot.odometry, "joystick and robot")
            for controls in SHOWN:
                show_on_joy(pad, joy, controls)
            drive(pad, robot, joy)
            check_stop(robot, lambda: pad.show(positions(F710_D, FORWARD)), PROMPT_S)
            check_unplugged(pad, launch, robot, joy)
            drive(pad, robot, joy)
        launch.interrupt()
        assert launch.wait() == 0 and "Traceback" not in launch.output, launch.output
    print("drive: passed", flush=True)
