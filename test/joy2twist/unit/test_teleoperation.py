"""The whole path of the rules: from axes and buttons to velocities and warnings.

Random messages and parameters are in test/suite/unit/test_stateful.py.
"""

import pytest

from joy_to_twist.parameters import load
from joy_to_twist.teleoperation import Teleoperation
from tutorial_testing.claims import claim
from tutorial_testing.over_time import over_time

pytestmark = claim("The table of reported faults")
NAN = float("nan")
HELD, RELEASED = ((0.0, 1.0), (1, 0, 0)), ((0.0, 0.0), (0, 0, 0))


def teleoperation(**given):
    """A Teleoperation and the list of its warnings."""
    warnings = []
    return Teleoperation(load(given), warnings.append, wake=lambda: None), warnings


def test_a_bad_message_is_reported_once_in_five_seconds():
    machine, warnings = teleoperation()
    for now, count in ((0.0, 1), (4.9, 1), (5.1, 2)):
        assert machine.joy((0.5, NAN), (), now) == (0,) * 6
        assert len(warnings) == count
    assert "nan" in warnings[0] and "\n" not in warnings[0]


def test_driving_that_reaches_no_subscriber_is_reported_once_until_there_is_one():
    machine, warnings = teleoperation(enable_button=0)
    for now in (0.0, 5.0):
        machine.listeners(0, "/carl/cmd_vel", now)  # it is not driving
    machine.joy((0.5, 0.7), (1,), 10.0)
    for count, now, reported in (
        (0, 10.0, 0), (0, 11.9, 0), (0, 12.0, 0),  # the robot may still be starting
        (0, 12.1, 1), (0, 20.0, 1), (1, 21.0, 1), (0, 22.0, 1), (0, 25.0, 2),
    ):  # fmt: skip
        machine.listeners(count, "/carl/cmd_vel", now)
        assert len(warnings) == reported, now
    assert "No node subscribes to /carl/cmd_vel" in warnings[0]


@pytest.mark.parametrize(("longest_s", "age_ns", "drives"), [
    (0.3, 300_000_000, True),
    (0.3, 300_000_001, False),
    (60, 60_000_000_001, False),
    (0.3, -5_000_000_000, True),  # another computer's clock is ahead
    (0, 10**18, True),  # off
])  # fmt: skip
def test_an_old_message_is_not_driven(longest_s, age_ns, drives):
    machine, warnings = teleoperation(max_joy_age=longest_s)
    assert (machine.joy((0.0, 1.0), (), 0.0, age_ns)[0] == 1.0) is drives
    assert drives or f"{longest_s:.1f} s old" in warnings[0]


@claim("A held key or ...", because="as long as it is held")
@pytest.mark.parametrize("step", [0.0, 2.0**-15])
def test_a_stick_held_for_eight_seconds_is_stopped_unless_it_trembles(step):
    """step: one of the 65,536 steps of an axis."""
    machine, warnings = teleoperation(arm_on_neutral=True, enable_button=0, vigilance_timeout=3.0)
    machine.joy(*RELEASED, 0.0)
    sent = []
    for i in range(1, 161):
        now = i * 0.05
        sent += [machine.tick(now), machine.joy((0.0, 1.0 - step * (i % 2)), (1, 0, 0), now)]
        if now == 2.6:  # shortly before the stop
            assert machine.summary(now)[1].startswith("driving: ") is (step == 0), "no warning"
    assert sent[2:].count((0,) * 6) == 5 * (step == 0)  # ~stop_messages
    said = ["The joystick does not change", "Stopped"] if step == 0 else []
    assert [line.split(":")[0] for line in warnings] == said
    assert ("has not changed for 3 s" in machine.summary(8.0)[1]) is (step == 0)


def test_the_stop_button_is_named_until_it_is_reset_and_sends_zeros_meanwhile():
    machine, warnings = teleoperation(enable_button=0, stop_button=1, stop_reset_button=2)
    machine.joy(*HELD, 0.1)
    assert machine.joy((NAN,), (1, 1), 0.2) == (0,) * 6  # in any message, even an unusable one
    assert machine.joy((NAN, 1.0), (1, 0, 1), 0.3) is None  # an unusable message resets nothing
    state = machine.summary(0.4)[1]
    assert state.startswith("stopped: the stop button") and "press button 2" in state
    # Zeros at ~output_rate keep other inputs of a multiplexer from driving meanwhile.
    zeros = over_time(machine, 0.6, 10.6)
    assert len(zeros) > 190 and {velocity for _, velocity in zeros} == {(0,) * 6}
    machine.joy((0.0, 1.0), (1, 0, 1), 11.0)
    over_time(machine, 11.0, 11.05)
    assert over_time(machine, 11.05, 20.0) == []
    assert machine.joy(*HELD, 20.0) is None  # reset, but not released
    machine.joy(*RELEASED, 20.2)
    assert machine.joy(*HELD, 20.3)[0] == 1.0
    assert sum("stop button" in line for line in warnings) == 1


def test_diagnostics_tell_the_state_the_rate_and_the_age():
    machine, warnings = teleoperation(enable_button=0, joy_timeout=0.5)
    rate, age, deadman = "Joy rate [Hz]", "Age of the last Joy [s]", "Dead-man button"
    details = {rate: "0.0", age: "none yet", deadman: "0"}
    assert machine.summary(100.0) == (False, "waiting for the joystick", details)
    for i in range(101):
        machine.joy((0.0, 1.0), (1,), 100.0 + i * 0.02)
    details = {rate: "42.1", age: "0.400", deadman: "0"}
    assert machine.summary(102.4) == (True, "driving", details)
    assert machine.summary(102.4)[2][rate] == "0.0"  # a second request at the same time
    machine.tick(105.0)
    assert machine.summary(105.5)[:2] == (False, "stopped: no message for 0.5 s")
    assert machine.suspended(1, 106.0) is None and "suspended" in warnings[-1]
