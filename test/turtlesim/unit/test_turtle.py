"""Motion against closed forms, to 1e-6: straight, on arcs, sideways; teleports and walls."""

import cmath
import math

import pytest

from simulated_turtles.field import FIELD_M, Field, Turtle
from tutorial_testing.claims import claim

pytestmark = claim("A turtle's motion ...", because="the motion and the walls")
MIDDLE = FIELD_M / 2


def approx(*values):
    return pytest.approx(values, abs=1e-6)


def pose(turtle):
    return turtle.pose[:3]


def driven(command, *times, theta=0.0):
    """Return a turtle that got a command at 0 s and drove until each of these times [s]."""
    turtle = Turtle(MIDDLE, MIDDLE, theta)
    turtle.command(*command)
    for before_s, now_s in zip((0.0, *times), times):
        turtle.advance(now_s - before_s)
    return turtle


@pytest.mark.parametrize("theta", [0.0, 0.7, -3.0])
@pytest.mark.parametrize("times", [(1.0,), (3.0,), [k * 0.016 for k in range(100)]])
def test_a_command_is_an_arc_of_one_second_however_it_is_cut(times, theta):
    v, left, w = 2.0, -0.5, 1.8
    way = complex(v, left) / (1j * w) * (cmath.rect(1, theta + w) - cmath.rect(1, theta))
    turtle = driven((v, left, w), *times, theta=theta)
    end = math.remainder(theta + w, math.tau)
    assert pose(turtle) == approx(MIDDLE + way.real, MIDDLE + way.imag, end)
    assert turtle.velocity == turtle.turn == 0


def test_a_new_command_replaces_the_old_one_where_the_turtle_is_then():
    turtle = driven((1.0, 0.0, 0.0), 0.1, 0.25)
    turtle.command(0.0, 0.0, 1.0)
    turtle.advance(9.0)
    assert pose(turtle) == approx(MIDDLE + 0.25, MIDDLE, 1.0)


def test_the_wall_holds_and_says_from_where_with_y_from_the_top(caplog):
    field = Field(lambda: (0, 0, 0), 0.0)
    for x, y, place in ((20.0, -1.0, (FIELD_M, 0.0)), (1.0, 20.0, (1.0, FIELD_M))):
        field.turtles["turtle1"].teleport_absolute(x, y, 0.0)
        field.step(0.0)
        assert pose(field.turtles["turtle1"])[:2] == place
    said = [line.partition("from ")[2] for line in caplog.messages if "wall" in line]
    assert said == [f"[x=20.000000, y={FIELD_M + 1.0:f}])"]


@pytest.mark.parametrize("turn", [0.0, 1e38])
def test_the_largest_command_leaves_a_pose_in_the_field(turn):
    field = Field(lambda: (0, 0, 0), 0.0)
    field.call("turtle1/command", {"ahead": 1e38, "left": 1e38, "turn": turn}, 0.0)
    field.step(1.0)
    x, y, theta = pose(field.turtles["turtle1"])
    assert (x == y == FIELD_M) is (turn == 0.0)
    assert 0.0 <= min(x, y) <= max(x, y) <= FIELD_M and abs(theta) < 3.15
