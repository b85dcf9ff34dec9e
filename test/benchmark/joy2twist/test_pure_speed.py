"""The pure path: from axes and buttons to a velocity, with all safety on."""

import itertools

from joy_to_twist.parameters import load
from joy_to_twist.teleoperation import Teleoperation

SAFE = {
    "enable_button": 4,
    "enable_turbo_button": 5,
    "arm_on_neutral": True,
    "max_joy_age": 0.5,
    "max_linear_speed": 0.7,
    "max_angular_speed": 3.0,
    "gamepad_axes": 6,
}
AXES = (0.3, 0.6, 0.0, 0.0, 0.0, 0.0)
HELD = (0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0)
RELEASED = (0,) * 12


def driven(**given):
    """A Teleoperation that drives, and a source of times."""
    machine = Teleoperation(load(given), print, wake=lambda: None)
    machine.joy((0.0,) * 6, RELEASED, 0.0)
    machine.joy(AXES, HELD, 0.001)
    return machine, map((0.001).__mul__, itertools.count(2))


def test_as_in_the_tutorial(benchmark):
    machine, times = driven()
    velocity = benchmark(lambda: machine.joy(AXES, HELD, next(times)))
    assert velocity == (0.6, 0, 0, 0, 0, 0.3)


def test_with_all_safety_on(benchmark):
    machine, times = driven(**SAFE)
    velocity = benchmark(lambda: machine.joy(AXES, HELD, next(times)))
    assert velocity == (0.6, 0, 0, 0, 0, 0.3)


def test_with_limits_on_acceleration(benchmark):
    machine, times = driven(**SAFE, max_linear_acceleration=1.0, output_rate=1000)

    def joy_and_tick():
        now = next(times)
        machine.joy(AXES, HELD, now)
        return machine.safety.tick(now + 0.0005)  # clearly later than it is due

    assert benchmark(joy_and_tick) is not None
