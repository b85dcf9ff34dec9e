"""Which commands are obeyed, and how far."""

from dataclasses import FrozenInstanceError
from math import inf, nan, pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fake_turtlebot_sim.simulator.velocity_command import (
    VelocityLimits,
    between,
    is_finite,
    limit,
    ramp_time,
)

KOBUKI = VelocityLimits()
FINITE = st.floats(allow_nan=False, allow_infinity=False)


@pytest.mark.parametrize("bad", [nan, inf, -inf])
def test_a_velocity_with_a_part_that_is_not_finite_is_none(bad):
    assert not is_finite((bad, 0.0))
    assert not is_finite((0.0, bad))
    assert is_finite((1e300, -1e300))


@pytest.mark.parametrize("velocity", [(0.7, pi), (-0.7, -pi), (0.0, 0.0), (0.3, -1.0)])
def test_what_the_robot_can_do_is_not_touched(velocity):
    assert limit(velocity, KOBUKI) == velocity


@pytest.mark.parametrize(
    ("asked", "given_"),
    [
        ((1.4, 1.0), (0.7, 0.5)),
        ((-1.4, 1.0), (-0.7, 0.5)),
        ((0.5, 2 * pi), (0.25, pi)),
        ((0.5, 1.25 * pi), (0.4, pi)),
        ((1.4, 1.25 * pi), (0.7, 0.625 * pi)),  # within the limit of w once v is
        ((7.0, 20 * pi), (0.35, pi)),
        ((1e300, 0.0), (0.7, 0.0)),
        ((1e300, -1e300), (0.7, -0.7)),
        ((0.0, -1e300), (0.0, -pi)),
    ],
)
def test_both_parts_are_scaled_alike(asked, given_):
    assert limit(asked, KOBUKI) == pytest.approx(given_, rel=1e-15)


@given(FINITE, FINITE)
def test_limited_velocities_are_within_the_limits_and_keep_their_signs(v, w):
    limited_v, limited_w = limit((v, w), KOBUKI)
    assert abs(limited_v) <= min(abs(v), 0.7 * (1 + 1e-15))
    assert abs(limited_w) <= min(abs(w), pi * (1 + 1e-15))
    assert limited_v * v >= 0
    assert limited_w * w >= 0


@given(st.floats(-1e6, 1e6), st.floats(-1e6, 1e6))
def test_the_curvature_is_kept(v, w):
    limited_v, limited_w = limit((v, w), KOBUKI)
    assert limited_v * w == pytest.approx(limited_w * v, rel=1e-12, abs=1e-300)


def test_without_acceleration_limits_every_velocity_is_reached_at_once():
    assert ramp_time((0.7, -pi), (-0.7, pi), KOBUKI) == 0.0


def test_the_slower_part_sets_the_time():
    limits = VelocityLimits(linear_acceleration=0.5, angular_acceleration=2.0)
    assert ramp_time((0.0, 0.0), (0.5, 1.0), limits) == 1.0
    assert ramp_time((0.0, 1.0), (0.5, -3.0), limits) == 2.0


def test_a_ramp_takes_as_long_as_the_change_is_and_not_as_the_velocity():
    linear = VelocityLimits(linear_acceleration=0.5)
    assert ramp_time((0.25, 5.0), (0.625, -5.0), linear) == 0.75
    assert ramp_time((0.625, 0.0), (0.25, 0.0), linear) == 0.75
    assert ramp_time((0.25, 0.0), (-0.5, 0.0), linear) == 1.5
    angular = VelocityLimits(angular_acceleration=2.0)
    assert ramp_time((5.0, 0.25), (-5.0, 1.5), angular) == 0.625


def test_between_two_velocities():
    assert between((0.0, 2.0), (1.0, -2.0), 0.25) == (0.25, 1.0)
    assert between((0.5, 1.5), (-1.0, 4.5), 0.25) == (0.125, 2.25)
    assert between((0.5, 1.5), (-1.0, 4.5), 0.0) == (0.5, 1.5)
    assert between((0.5, 1.5), (-1.0, 4.5), 1.0) == (-1.0, 4.5)


def test_a_base_that_cannot_do_the_one_may_still_do_the_other():
    assert limit((0.0, 1.0), VelocityLimits(linear=0.0)) == (0.0, 1.0)
    assert limit((0.5, 0.0), VelocityLimits(angular=0.0)) == (0.5, 0.0)


def test_the_limits_of_a_robot_stay_as_they_are():
    with pytest.raises(FrozenInstanceError):
        VelocityLimits().linear = 1.0
