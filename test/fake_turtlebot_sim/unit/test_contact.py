"""Where and when a round robot touches walls, posts and other robots."""

from math import cos, pi

import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from fake_turtlebot_sim.simulator.contact import Piece, direction_to, drive_among, gap
from fake_turtlebot_sim.simulator.differential_drive import drive
from tutorial_testing.claims import claim

R = 0.178
WALL = (1.0, -5.0, 1.0, 5.0, 0.0)  # x = 1
EXACT = 1e-9


def post(x, y, radius):
    return x, y, x, y, radius


places = st.floats(-2, 2)
walls = st.tuples(places, places, places, places, st.just(0.0))
posts = st.builds(post, places, places, st.floats(0.0, 0.4))
velocities = st.tuples(
    st.floats(-1, 1) | st.sampled_from([0.7, -0.7, 0.0]),
    st.floats(-3, 3) | st.sampled_from([0.0, 1e-9, pi]),
)


@claim("Contact with walls, posts and robots is exact, and the robot is never inside")
@example(  # a circle of 0.1 um beside the end of a wall; the gap is a rounding error
    [post(0.0, 0.0, 0.0), (0.0, 0.0, 0.0, -1.0, 0.0)], (-1.0, 0.0, 0.0),
    [((1.0, 0.0), (1.0, 0.0), 1.0), ((-1.4901161193847696e-07, pi),) * 2 + (2.0,)],
)  # fmt: skip
@example([WALL], (1 - R - 1e-11, 0.0, pi / 2), [((0.0, 0.0), (0.7, 0.0), 1.0)])  # along it
@example([WALL], (0.7, 0.0, 1.0), [((-0.4, 3.0), (-0.4, -0.5), 5.0)])  # turning there and back
@example([WALL], (0.622, 0.0, 1.6), [((0.6, -1.1), (0.6, -0.2), 1.0)])  # first away from it
@example([WALL], (0.422, 0.0, 0.0), [((0.3, 0.9), (0.3, 0.3), 3.0)])  # towards it, then along
@example([WALL], (0.4, 0.0, 0.0), [((0.7, 2.5), (0.7, 2.5), 3.0)])  # towards it, then away
@example([WALL], (0.8, 0.0, 1.0), [((0.5, 0.5), (0.5, 0.5), 4.0)])  # it turns there for a moment
@given(
    st.lists(walls | posts, min_size=1, max_size=8),
    st.tuples(places, places, st.floats(-pi, pi)),
    st.lists(
        st.tuples(velocities, velocities, st.floats(0.001, 3.0))
        | st.tuples(velocities, st.floats(0.001, 3.0)).map(lambda steady: (steady[0], *steady)),
        min_size=1,
        max_size=6,
    ),
)
def test_a_robot_is_never_inside_and_stops_only_where_it_touches(obstacles, pose, commands):
    clear = lambda x, y: min(gap(x, y, R, obstacle) for obstacle in obstacles)  # noqa: E731
    assume(clear(*pose[:2]) > 0.0)
    for velocity, end_velocity, dt in commands:
        pieces, contact = drive_among(pose, Piece(velocity, end_velocity, dt), R, obstacles)
        for piece in pieces:
            for part in range(1, 10):
                before = piece.until(piece.dt * part / 10)
                x, y, _ = drive(pose, *before[:2], before.dt)
                assert clear(x, y) > -EXACT
            pose = drive(pose, *piece[:2], piece.dt)
            if piece is not pieces[-1] and piece.is_blocked and piece.dt > EXACT:
                # It turns only until it can drive on.
                touched = [piece for piece in obstacles if gap(*pose[:2], R, piece) < EXACT]
                turned = [abs(cos(direction_to(pose, wall) - pose[2])) for wall in touched]
                assert min(turned) < 1e-6
        assert sum(piece.dt for piece in pieces) == pytest.approx(dt)
        assert contact is None or abs(clear(*pose[:2])) < EXACT
        # It drives towards what it touches: nothing prevents it from backing off.
        if contact is not None and velocity == end_velocity:
            ahead = pose[2] if velocity[0] > 0 else pose[2] + pi
            assert cos(contact - ahead) > -EXACT
