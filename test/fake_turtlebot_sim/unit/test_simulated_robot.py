"""A robot under commands: rates, timeout, limits, reset."""

import random
from math import hypot, inf, isfinite, nan

import pytest

from fake_turtlebot_sim.simulator.parameters import SimulatorParameters
from fake_turtlebot_sim.simulator.simulated_robot import CommandResult, SimulatedRobot
from tutorial_testing.claims import claim

KOBUKI = SimulatorParameters()
SECOND = 10**9  # [ns]
PERIOD = 20_000_000  # [ns], 50 Hz
RAMPS = {"max_linear_acceleration": 1.0, "max_angular_acceleration": 2.0}
RAMPING = SimulatorParameters(**RAMPS)


def command_log(seed, seconds):
    """Return commands about every 0.3 s, some after the timeout: (ns, velocity)."""
    rng, now_s, log = random.Random(seed), 0.0, []
    while now_s < seconds:
        log.append((round(now_s * 1e9), (rng.uniform(-0.9, 0.9), rng.uniform(-4, 4))))
        now_s += rng.uniform(0.01, 0.6) if rng.random() < 0.9 else 0.9
    return log


def drive(model, log, times, end_ns):
    """Obey the log, advance at the given times, and return the state at the end."""
    robot = SimulatedRobot(model)
    for now_ns, velocity in sorted([*log, *((time, None) for time in times)], key=lambda e: e[0]):
        if velocity is None:
            robot.advance(now_ns)
        else:
            robot.command(velocity, now_ns)
    robot.advance(end_ns)
    return robot.state()


LOOKS = {
    **{f"{hz} Hz": range(0, 60 * SECOND, SECOND // hz) for hz in (10, 30, 50, 100)},
    "at any time": random.Random(2).sample(range(60 * SECOND), 3000),
}


@claim("The pose depends on the commands and when they arrive, not on the rate")
@pytest.mark.parametrize("model", [KOBUKI, RAMPING], ids=["sudden", "ramping"])
@pytest.mark.parametrize("looks", LOOKS.values(), ids=LOOKS)
def test_the_pose_depends_on_the_commands_and_not_on_the_rate(model, looks):
    log = command_log(seed=1, seconds=60)
    looked_at = drive(model, log, looks, 62 * SECOND)
    left_alone = drive(model, log, [], 62 * SECOND)
    assert hypot(left_alone.x, left_alone.y) > 0.1
    assert looked_at == pytest.approx(left_alone, rel=0, abs=1e-9)


@claim("It stops by itself at the instant of the timeout")
@pytest.mark.parametrize("velocity", [(0.7, 1.0), (-0.7, 0.0), (0.0, 0.0)])
def test_the_robot_stops_at_the_instant_of_the_timeout(velocity):
    robot, moves = SimulatedRobot(KOBUKI), any(velocity)
    assert not robot.is_commanded
    robot.command(velocity, 0)
    assert not robot.advance(SECOND * 6 // 10 - 1)
    assert (robot.state()[3:5], robot.is_commanded, robot.is_moving) == (velocity, True, moves)
    assert robot.advance(SECOND * 6 // 10) == moves
    assert (robot.state()[3:5], robot.is_commanded, robot.is_moving) == ((0.0, 0.0), False, False)
    state = robot.state()
    robot.advance(SECOND // 2)  # an earlier time changes nothing
    assert robot.state() == state
    assert not robot.advance(SECOND) and not robot.is_commanded


def test_a_ramp_takes_as_long_as_the_slower_part():
    robot = SimulatedRobot(SimulatorParameters(**RAMPS, cmd_vel_timeout=1.0, wheel_noise=0.01))
    for second, target, halfway in (
        (0, (0.5, 2.0), (0.25, 1.0)),
        (1, (-0.5, 2.0), (0.0, 2.0)),
        (2, (-0.5, 0.0), (-0.5, 1.0)),
    ):
        robot.command(target, second * SECOND)
        for half, velocity in ((1, halfway), (2, target)):
            robot.advance(second * SECOND + half * SECOND // 2)
            assert robot.state()[3:5] == pytest.approx(velocity)
    for quarter, velocity in ((1, (-0.25, 0.0)), (2, (0.0, 0.0))):  # after the timeout
        robot.advance(3 * SECOND + quarter * SECOND // 4)
        assert robot.state()[3:5] == pytest.approx(velocity)


@claim("Too fast is scaled down, not finite is ignored and feeds no timeout, each is reported once")
@pytest.mark.parametrize("bad", [(nan, 0.0), (0.0, nan), (inf, 0.0), (0.0, -inf)])
def test_what_is_too_fast_is_limited_and_what_is_not_finite_feeds_no_timeout(bad):
    robot = SimulatedRobot(KOBUKI)
    for velocity in ((1e300, 0.0), (0.0, -4.0)):
        assert robot.command(velocity, 0) is CommandResult.LIMITED
    assert robot.command((0.7, 0.0), 0) is CommandResult.ACCEPTED
    for now_ns in range(PERIOD, SECOND, PERIOD):
        assert robot.command(bad, now_ns) is CommandResult.REJECTED
    robot.advance(10 * SECOND)  # a jump of time moves it no further than its timeout
    assert robot.state()[:4] == pytest.approx((0.42, 0.0, 0.0, 0.0))


def test_a_speed_without_a_limit_is_still_one_that_can_be_computed():
    no_limits = SimulatorParameters(
        max_linear_speed=0, max_angular_speed=0, max_linear_acceleration=1.0
    )
    robot = SimulatedRobot(no_limits)
    assert robot.command((1e308, 1e308), 0) is CommandResult.LIMITED
    robot.advance(SECOND // 10)
    assert all(map(isfinite, robot.state()))
