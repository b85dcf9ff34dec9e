"""A joystick that does not change. Times in seconds, as they would pass.

So is a radio gamepad out of range: its receiver repeats the last state without end.
"""

from joy_to_twist.parameters import load
from joy_to_twist.safety import DRIVING, Safety
from node_kit.arming import ZERO
from tutorial_testing.over_time import over_time

FORWARD = (0.5, 0.0, 0.0, 0.0, 0.0, 0.0)
BACKWARD = (-0.5, 0.0, 0.0, 0.0, 0.0, 0.0)
DEAD_MAN = {"enable_button": 4}
STILL = {**DEAD_MAN, "arm_on_neutral": True, "vigilance_timeout": 3.0, "stop_messages": 2}


def driven(warnings, **given):
    """Return a Safety that drives since 1.0 s, and whose joystick has not changed since."""
    machine = Safety(load({**STILL, **given}), lambda: None, warnings.append)
    machine.drive(None, True, 0.9)
    assert machine.drive(FORWARD, False, 1.0) == FORWARD
    return machine


def repeat(machine, start, end):
    """Send the same message at 20 Hz, and tick() when due; return what is sent, but FORWARD."""
    sent = []
    for i in range(round((end - start) * 20)):
        now = start + i * 0.05
        answers = over_time(machine, now - 0.05, now)
        answers.append((now, machine.drive(FORWARD, False, now, changed=False)))
        sent += [(round(at, 3), v) for at, v in answers if v not in (None, FORWARD)]
    return sent


def test_a_joystick_that_does_not_change_stops_like_any_loss():
    warnings = []
    machine = driven(warnings)
    assert repeat(machine, 1.05, 12.0) == [(4.0, ZERO), (4.05, ZERO)]
    assert "has not changed for 3 s" in machine.state
    assert [w.split(":")[0] for w in warnings] == ["The joystick does not change", "Stopped"]
    assert machine.drive(BACKWARD, False, 12.0) is None  # back in range: not yet released
    assert machine.drive(None, True, 12.1) is None
    assert machine.drive(FORWARD, False, 12.2) == FORWARD
    assert machine.state == DRIVING


def test_a_warning_comes_half_a_second_before():
    warnings = []
    machine = driven(warnings)
    repeat(machine, 1.05, 3.5)
    assert (warnings, machine.state) == ([], DRIVING)
    repeat(machine, 3.5, 3.6)
    assert "stops in 0.5 s" in warnings[0]
    assert machine.state.startswith(f"{DRIVING}: ")
    assert machine.drive(FORWARD, False, 3.7) == FORWARD  # a stick has moved
    assert machine.state == DRIVING
    assert repeat(machine, 3.75, 6.7) == []


def test_a_robot_that_stands_may_do_so_without_end():
    machine = driven([])
    for i in range(160):
        machine.drive(ZERO, False, 1.1 + i * 0.05, changed=i == 0)
    assert machine.due > 9.0
    assert machine.state == DRIVING


def test_by_default_it_is_off():
    machine = Safety(load(DEAD_MAN), lambda: None)
    for i in range(400):
        assert machine.drive(FORWARD, False, i * 0.05, changed=False) == FORWARD
