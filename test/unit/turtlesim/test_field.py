"""Names, pens, teleports and colors of the field, as upstream's."""

import pytest

from simulated_turtles.field import PERIOD_S, START, Field, wait_s
from simulated_turtles.turtle import Pen

BLUE, RED = (69, 86, 255), (255, 0, 0)
PEN = Pen().color


@pytest.fixture
def field():
    made = Field(BLUE)
    made.spawn("", *START, 0.0)
    return made


def test_names_are_chosen_or_given_once(field):
    assert field.spawn("turtle2", 1.0, 1.0, 0.0, 0.0) == "turtle2"
    assert field.spawn("", 1.0, 1.0, 0.0, 0.0) == "turtle3"
    with pytest.raises(ValueError, match=r"A turtled named \[turtle2\] already exists"):
        field.spawn("turtle2", 1.0, 1.0, 0.0, 0.0)
    for name in ("a b", "1st", "/", "ü"):
        with pytest.raises(ValueError, match="cannot name a turtle"):
            field.spawn(name, 1.0, 1.0, 0.0, 0.0)
    field.kill("turtle2")
    with pytest.raises(ValueError, match=r"Tried to kill turtle \[turtle2\], which does not exist"):
        field.kill("turtle2")
    assert field.spawn("", 1.0, 1.0, 0.0, 0.0) == "turtle4"  # not the free one, as upstream
    field.reset(BLUE)
    assert not field.turtles and field.spawn("", *START, 0.0) == "turtle1"


def test_velocities_are_published_without_a_sign_and_end_after_a_second(field):
    field.turtles["turtle1"].command(-3.0, 4.0, -1.0, 0.0)
    assert field.step(0.5)[0].pose[3:] == (5.0, -1.0)
    assert field.step(1.0)[0].pose[3:] == (0.0, 0.0)


def test_a_teleport_draws_the_way_and_the_drive_before_it(field):
    turtle, x, y = field.turtles["turtle1"], *START[:2]
    turtle.command(1.0, 0.0, 0.0, 0.0)
    field.teleport(turtle, lambda: turtle.jump_to(2.0, 2.0, 0.0), 1.0)
    assert field.paper.color_at(x + 0.5, y) == field.paper.color_at(2.0, 2.0) == PEN
    assert field.paper.color_at((x + 3.0) / 2, (y + 2.0) / 2) == PEN
    assert field.paper.color_at(x, 2.0) == BLUE


def test_a_lifted_pen_draws_nothing_and_keeps_its_color(field):
    turtle = field.turtles["turtle1"]
    field.set_pen(turtle, RED, 0, 0, 0.0)
    field.set_pen(turtle, (0, 0, 0), 9, 1, 0.0)
    assert turtle.pen == (RED, 1, False)
    field.teleport(turtle, lambda: turtle.jump_to(2.0, 2.0, 0.0), 0.0)
    assert field.step(0.1)[0].color == BLUE
    field.set_pen(turtle, RED, 3, 0, 0.2)
    field.teleport(turtle, lambda: turtle.jump_by(1.0, 0.0), 0.2)
    assert field.paper.color_at(2.5, 2.0) == RED


def test_steps_keep_their_rate_and_a_late_one_is_not_made_up_for():
    assert wait_s(5.0, 4.99) == pytest.approx((0.01, 5.0 + PERIOD_S))
    assert wait_s(5.0, 7.0) == (0.0, 7.0 + PERIOD_S)
