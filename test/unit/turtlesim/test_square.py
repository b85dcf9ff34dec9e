"""draw_square: the corners of a square, driven by the rules of the field."""

import pytest

from simulated_turtles.field import PERIOD_S, START, Field
from simulated_turtles.square import NEAR_M, SIDE_M, Square


def test_four_sides_return_to_the_start():
    field, square, goals, now_s = Field((0, 0, 0)), Square(), [], 0.0
    field.spawn("turtle1", *START, 0.0)
    while len(goals) < 9:
        now_s += PERIOD_S
        assert now_s < 60.0
        ((_, pose, *_),) = field.step(now_s)
        ahead, turn = square.step(pose)
        field.turtles["turtle1"].command(ahead, 0.0, turn, now_s)
        if square.goal not in goals:
            goals.append(square.goal)
    x, y = START[:2]
    corners = [(x + SIDE_M, y), (x + SIDE_M, y + SIDE_M), (x, y + SIDE_M), (x, y)]
    for goal, corner in zip(goals[:8:2], corners):
        assert goal[:2] == pytest.approx(corner, abs=4 * NEAR_M)
