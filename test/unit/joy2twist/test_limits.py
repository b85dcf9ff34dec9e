"""Limits on speed and acceleration."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from joy_to_twist.mapping import approach, limit_speed
from node_kit.arming import ZERO

speeds = st.floats(-1e9, 1e9)
velocities = st.tuples(*[speeds] * 6)


def test_a_velocity_within_the_limits_stays():
    assert limit_speed((0.3, -0.4, 0, 0, 0, 0.2), 0.5, 0.2) == (0.3, -0.4, 0, 0, 0, 0.2)
    # Also at the very limit, where scaling would change the last digit.
    longest = (0.2, 0.3, 0.0, 0.2, 0.3, 0.0)
    length = math.hypot(0.2, 0.3)
    assert limit_speed(longest, length, length) == longest


def test_a_longer_velocity_keeps_its_direction():
    assert limit_speed((3.0, 0, -4.0, 0, 6.0, 8.0), 1.0, 5.0) == pytest.approx(
        (0.6, 0, -0.8, 0, 3.0, 4.0)
    )


def test_linear_and_angular_are_limited_apart():
    inf = math.inf
    assert limit_speed((2.0, 0, 0, 0, 0, -3.0), 0.7, inf) == pytest.approx((0.7, 0, 0, 0, 0, -3.0))
    assert limit_speed((2.0, 0, 0, 0, 0, -3.0), inf, 0.5) == pytest.approx((2.0, 0, 0, 0, 0, -0.5))


@given(velocities, st.floats(1e-3, 1e3), st.floats(1e-3, 1e3))
def test_limited_speed_is_within_the_limits(velocity, linear, angular):
    limited = limit_speed(velocity, linear, angular)
    assert math.hypot(*limited[:3]) <= linear * (1 + 1e-12)
    assert math.hypot(*limited[3:]) <= angular * (1 + 1e-12)


def test_a_step_changes_by_no_more_than_allowed():
    assert approach(ZERO, (1.0, 0, 0, 0, 0, 2.0), 0.1, 0.5) == pytest.approx((0.1, 0, 0, 0, 0, 0.5))
    assert approach((-0.3, 0, 0, 0, 0, 0), ZERO, 0.2, 0.2) == pytest.approx((-0.1, 0, 0, 0, 0, 0))


@given(velocities)
def test_the_last_step_meets_the_target_exactly(start):
    assert approach(start, ZERO, math.inf, math.inf) == ZERO


@given(st.tuples(*[st.floats(-2, 2)] * 6), st.tuples(*[st.floats(-2, 2)] * 6))
def test_the_target_is_reached_in_the_time_it_takes(start, target):
    velocity = start
    for _ in range(80):  # at most 2 * sqrt(3) * 2 apart, 0.1 a step
        velocity = approach(velocity, target, 0.1, 0.1)
    assert velocity == target
