"""draw_square: the corners of a square, driven by the rules of the field."""

import runpy

import pytest
import rospkg

from simulated_turtles.field import START, Field


def test_four_sides_return_to_the_start():
    field, corners = Field(lambda: (0, 0, 0), 0.0), []
    side = runpy.run_path(f"{rospkg.RosPack().get_path('turtlesim')}/scripts/draw_square")["SIDE"]
    for now_s, (ahead, turn) in enumerate(4 * side):
        field.call("turtle1/command", {"ahead": ahead, "left": 0.0, "turn": turn}, now_s)
        field.step(now_s + 1.0)
        corners += [field.turtles["turtle1"].pose[:2]] if now_s % 6 == 1 else []
    x, y = START[:2]
    assert corners == [pytest.approx((x + k, y + n)) for k, n in [(2, 0), (2, 2), (0, 2), (0, 0)]]
