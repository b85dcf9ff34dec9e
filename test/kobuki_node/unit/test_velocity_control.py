"""The velocity that the wheels of a Kobuki get, step by step."""

from math import inf, nan

import pytest

from kobuki_driver.robot.velocity_control import VelocityControl, VelocityResult
from tutorial_testing.claims import claim

pytestmark = claim(
    "A command expires; motors that are off, a robot that is offline and what is not finite move "
    "nothing"
)
AHEAD = (0.3, 0.5)
REST = (0.0, 0.0)


@pytest.fixture
def driving():
    made = VelocityControl(timeout_s=0.6)
    made.switch_robot(is_online=True)
    return made


def test_the_newest_command_drives(driving):
    assert driving.velocity(0.0) == REST
    assert driving.command(AHEAD, 1.0) is VelocityResult.OBEYED
    assert driving.velocity(1.02) == AHEAD
    assert driving.command((-0.1, 0.0), 1.1) is VelocityResult.OBEYED
    assert driving.velocity(1.1) == (-0.1, 0.0)


def test_a_command_expires_once(driving):
    driving.command(AHEAD, 1.0)
    assert not driving.expires(1.59)
    assert driving.velocity(1.59) == AHEAD
    assert driving.expires(1.6)
    assert not driving.expires(1.62)
    assert driving.velocity(1.62) == REST


def test_a_zero_that_expires_is_worth_no_line(driving):
    driving.command(REST, 1.0)
    assert not driving.expires(9.0)


@pytest.mark.parametrize("velocity", [(nan, 0.0), (0.0, inf), (-inf, nan)])
def test_what_is_not_finite_is_ignored_and_feeds_no_timeout(driving, velocity):
    driving.command(AHEAD, 1.0)
    assert driving.command(velocity, 1.5) is VelocityResult.NOT_FINITE
    assert driving.velocity(1.55) == AHEAD
    assert driving.velocity(1.7) == REST


@pytest.mark.parametrize("back", [True, False])
def test_a_robot_that_is_back_stands_until_the_next_command(driving, back):
    driving.command(AHEAD, 1.0)
    driving.switch_robot(is_online=False)
    assert driving.velocity(1.1) == REST
    assert driving.command(AHEAD, 1.2) is VelocityResult.OFFLINE
    driving.switch_robot(is_online=True)
    assert driving.velocity(1.3) == REST
    if back:
        driving.command(AHEAD, 1.4)
        assert driving.velocity(1.4) == AHEAD


def test_without_power_a_command_is_ignored_and_with_it_the_next_one_drives(driving):
    driving.command(AHEAD, 1.0)
    driving.switch_motors(False)
    assert driving.velocity(1.1) == REST
    assert driving.command(AHEAD, 1.2) is VelocityResult.POWERLESS
    driving.switch_motors(True)
    assert driving.velocity(1.3) == REST
    assert driving.command(AHEAD, 1.4) is VelocityResult.OBEYED
    assert driving.velocity(1.4) == AHEAD


def test_the_limiter_lets_a_velocity_grow_and_fall_gradually():
    driving = VelocityControl(timeout_s=0.6, is_limited=True)
    driving.switch_robot(is_online=True)
    driving.velocity(1.0)
    driving.command((0.3, 7.0), 1.0)
    assert driving.velocity(1.1) == pytest.approx((0.05, 0.35))  # 0.5 m/s2, 3.5 rad/s2
    assert driving.velocity(1.2) == pytest.approx((0.10, 0.70))
    assert driving.velocity(9.0) == REST  # what stops the robot stops it at once
    driving.command((-0.3, 0.0), 9.0)
    assert driving.velocity(9.1) == pytest.approx((-0.06, 0.0))  # 0.6 m/s2
