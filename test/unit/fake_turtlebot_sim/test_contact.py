"""Where and when a round robot touches walls, posts and other robots."""

from math import acos, asin, cos, inf, pi, sqrt

import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from fake_turtlebot_sim.simulator.contact import Piece, drive_among, first_contact, gap
from fake_turtlebot_sim.simulator.differential_drive import drive

R = 0.178
WALL = (1.0, -5.0, 1.0, 5.0, 0.0)  # x = 1
EXACT = 1e-9


def post(x, y, radius):
    return x, y, x, y, radius


# Pose, velocity, obstacle, and when they touch [s], worked out by hand.
CASES = {
    "a wall met straight": ((0, 0, 0), (0.5, 0), WALL, (1 - R) / 0.5),
    # x = 0.5 / 0.4 sin(0.4 t) = 1 - R
    "on an arc": ((0, 0, 0), (0.5, 0.4), WALL, asin((1 - R) * 0.4 / 0.5) / 0.4),
    # The circle around (0, 2) of radius 2 comes no nearer to x = 3 than 1.
    "past a wall": ((0, 0, 0), (2, 1), (3.0, -5.0, 3.0, 5.0, 0.0), inf),
    # y = 2 (1 - cos t) = 3 - R, on the way around that circle.
    "a wall across": ((0, 0, 0), (2, 1), (-9.0, 3.0, 9.0, 3.0, 0.0), acos(1 - (3 - R) / 2)),
    "a corner by its end": ((0, 0, 0), (1, 0), (1.0, 0.1, 1.0, 3.0, 0.0), 1 - sqrt(R**2 - 0.1**2)),
    # On the circle around (0, 1), a chord of R + 0.1 before (1, 1).
    "a post on an arc": ((0, 0, 0), (1, 1), post(1.0, 1.0, 0.1), pi / 2 - 2 * asin((R + 0.1) / 2)),
    "nothing": ((0, 0, 0), (1, 0), (5.0, 1.0, 5.0, 2.0, 0.0), inf),
}


@pytest.mark.parametrize("name", CASES)
def test_the_time_of_contact_is_the_closed_forms(name):
    pose, velocity, obstacle, after_s = CASES[name]
    met = first_contact(pose, Piece(velocity, velocity, 60.0), R, [obstacle])
    assert (met[0] if met else inf) == pytest.approx(after_s, abs=EXACT)


places = st.floats(-2, 2)
walls = st.tuples(places, places, places, places, st.just(0.0))
posts = st.builds(post, places, places, st.floats(0.0, 0.4))
velocities = st.tuples(
    st.floats(-1, 1) | st.sampled_from([0.7, -0.7, 0.0]),
    st.floats(-3, 3) | st.sampled_from([0.0, 1e-9, pi]),
)


@settings(max_examples=100, deadline=None)
@example(  # a circle of 0.1 um beside the end of a wall, whose gap is a rounding
    [post(0.0, 0.0, 0.0), (0.0, 0.0, 0.0, -1.0, 0.0)], (-1.0, 0.0, 0.0),
    [((1.0, 0.0), (1.0, 0.0), 1.0), ((-1.4901161193847696e-07, pi),) * 2 + (2.0,)],
)  # fmt: skip
@example([WALL], (1 - R - 1e-11, 0.0, pi / 2), [((0.0, 0.0), (0.7, 0.0), 1.0)])  # along it
@given(
    st.lists(walls | posts, min_size=1, max_size=8),
    st.tuples(places, places, st.floats(-pi, pi)),
    st.lists(
        st.tuples(velocities, velocities, st.floats(0.001, 3.0))
        | st.tuples(velocities, st.floats(0.001, 3.0)).map(lambda one: (one[0], *one)),
        min_size=1,
        max_size=6,
    ),
)
def test_a_robot_is_never_inside_and_stops_only_where_it_touches(obstacles, pose, commands):
    clear = lambda x, y: min(gap(x, y, R, one) for one in obstacles)  # noqa: E731
    assume(clear(*pose[:2]) > 0.0)
    for velocity, end_velocity, dt in commands:
        pieces, contact = drive_among(pose, Piece(velocity, end_velocity, dt), R, obstacles)
        for piece in pieces:
            for part in range(1, 10):
                before = piece.until(piece.dt * part / 10)
                x, y, _ = drive(pose, *before[:2], before.dt)
                assert clear(x, y) > -EXACT
            pose = drive(pose, *piece[:2], piece.dt)
        assert sum(piece.dt for piece in pieces) == pytest.approx(dt)
        assert contact is None or abs(clear(*pose[:2])) < EXACT
        # It drives towards what it touches: backing off is never kept.
        if contact is not None and velocity == end_velocity:
            ahead = pose[2] if velocity[0] > 0 else pose[2] + pi
            assert cos(contact - ahead) > -EXACT
