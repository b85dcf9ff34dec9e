"""The kinematics against closed forms."""

from math import cos, pi, sin

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from fake_turtlebot_sim.simulator.differential_drive import arc, limit, ramp, wrap_angle
from tutorial_testing.claims import claim

pytestmark = claim("Each path is an exact arc, or an exact ramp under limits of acceleration")
ORIGIN = (0.0, 0.0, 0.0)
POSE = st.tuples(st.floats(-1, 1), st.floats(-1, 1), st.floats(-3.14, 3.14))
VELOCITY = st.tuples(st.floats(-1, 1), st.floats(-4, 4))


@pytest.mark.parametrize("exponent", range(-13, -2))
@pytest.mark.parametrize("sign", [1, -1])
def test_slow_turns_keep_their_digits(sign, exponent):
    w, v, dt = sign * 10.0**exponent, 0.7, 0.02
    x, y, yaw = arc(ORIGIN, (v, w), dt)
    # Series of sin(a)/a and (1 - cos(a))/a; a is at most 2e-5, so the next terms are below 1e-20.
    a = w * dt
    assert x == pytest.approx(v * dt * (1 - a * a / 6), rel=1e-12)
    assert y == pytest.approx(v * dt * (a / 2 - a**3 / 24), rel=1e-12)
    assert yaw == pytest.approx(a, rel=1e-12)


@given(pose=POSE, velocity=VELOCITY, dt=st.floats(0, 10), share=st.floats(0, 1))
def test_two_parts_make_the_whole(pose, velocity, dt, share):
    halfway = arc(pose, velocity, share * dt)
    parts, whole = arc(halfway, velocity, dt - share * dt), arc(pose, velocity, dt)
    assert parts[:2] == pytest.approx(whole[:2], abs=1e-12)
    assert wrap_angle(parts[2] - whole[2]) == pytest.approx(0, abs=1e-12)


@example(-pi)
@given(st.floats(-1e6, 1e6))
def test_wrapped_angles_are_in_the_half_open_circle(angle):
    wrapped = wrap_angle(angle)
    assert -pi < wrapped <= pi
    assert cos(wrapped) == pytest.approx(cos(angle), abs=1e-9)
    assert sin(wrapped) == pytest.approx(sin(angle), abs=1e-9)


def test_a_ramp_is_the_limit_of_many_short_arcs():
    pose, steps, dt = ORIGIN, 100_000, 2.0
    for k in range(steps):
        share = (k + 0.5) / steps
        pose = arc(pose, (0.6 - 0.8 * share, -1.0 + 3.0 * share), dt / steps)
    assert ramp(ORIGIN, (0.6, -1.0), (-0.2, 2.0), dt) == pytest.approx(pose, abs=1e-9)


fast = st.floats(-10, 10) | st.floats(-1e300, 1e300)


@given(fast, fast)
def test_both_parts_are_scaled_alike(v, w):
    scale = 1.0 / max(1.0, abs(v) / 0.7, abs(w) / pi)
    assert limit((v, w), 0.7, pi) == pytest.approx((v * scale, w * scale), rel=1e-12, abs=0.0)
