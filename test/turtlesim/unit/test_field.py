"""Names, pens, teleports, colors and lines of the field, as upstream's; motion within 1e-6."""

import cmath
import math
from io import BytesIO

import pytest
from PIL import Image, ImageChops, ImageDraw

from simulated_turtles.field import COLORS, FIELD_M, START, Field, Turtle
from tutorial_testing.claims import claim

pytestmark = claim("A turtle's motion is exact; names, pens, walls and colors are upstream's")
BLUE, RED = (69, 86, 255), (255, 0, 0)
PEN = (179, 184, 255)  # as upstream's DEFAULT_PEN
PIXEL_M = 1 / 45


@pytest.fixture
def field():
    return Field(lambda: BLUE, 0.0)


def spawn(field, name, x=1.0, y=1.0, theta=0.0):
    return field.call("spawn", {"x": x, "y": y, "theta": theta, "name": name}, 0.0)


def pen(field, color, width, off=0):
    values = dict(zip("rgb", color), width=width, off=off)
    field.call("turtle1/set_pen", values, 0.0)


def jump(field, x, y, now_s=0.0, theta=0.0):
    field.call("turtle1/teleport_absolute", {"x": x, "y": y, "theta": theta}, now_s)


def color_at(field, x, y):
    return field._paper.getpixel((round(45 * x), round(499 - 45 * y)))


def drive(field, ahead, left=0.0, turn=0.0):
    field.call("turtle1/command", {"ahead": ahead, "left": left, "turn": turn}, 0.0)


def test_names_are_chosen_or_given_once(field):
    assert spawn(field, "turtle2") == "turtle2"
    assert spawn(field, "") == "turtle3"
    with pytest.raises(ValueError, match=r"A turtled named \[turtle2\] already exists"):
        spawn(field, "turtle2")
    for name in ("a b", "1st", "/", "ü"):
        with pytest.raises(ValueError, match="cannot name a turtle"):
            spawn(field, name)
    field.call("kill", {"name": "turtle2"}, 0.0)
    with pytest.raises(ValueError, match=r"Tried to kill turtle \[turtle2\], which does not exist"):
        field.call("kill", {"name": "turtle2"}, 0.0)
    with pytest.raises(ValueError, match=r"there is no turtle \[turtle2\]"):
        field.call("turtle2/command", {}, 0.0)
    assert spawn(field, "") == "turtle4"  # not the free name, as upstream
    field.call("reset", {}, 0.0)
    assert [*field.turtles] == ["turtle1"]
    # As upstream's wiki has it.
    assert field.turtles["turtle1"].pose[:3] == pytest.approx((5.544445, 5.544445, 0.0), abs=1e-6)


def test_velocities_are_published_without_a_sign_and_end_after_a_second(field):
    turtle = field.turtles["turtle1"]
    drive(field, -3.0, 4.0, -1.0)
    for now_s, velocities in ((0.5, (5.0, -1.0)), (1.0, (0.0, 0.0))):
        field.step(now_s)
        assert (turtle.pose[3:], turtle.seen) == (velocities, BLUE)  # seen before the line is drawn


def test_a_teleport_draws_the_way_and_the_drive_before_it(field):
    x, y = START[:2]
    drive(field, 1.0)
    jump(field, 2.0, 2.0, now_s=1.0)
    assert color_at(field, x + 0.5, y) == color_at(field, 2.0, 2.0) == PEN
    assert color_at(field, (x + 3.0) / 2, (y + 2.0) / 2) == PEN
    assert color_at(field, x, 2.0) == BLUE


def test_a_lifted_pen_draws_nothing_and_keeps_its_color(field):
    turtle = field.turtles["turtle1"]
    pen(field, RED, 0)
    pen(field, (0, 0, 0), 9, off=1)
    assert (turtle.color, turtle.width, turtle.is_down) == (RED, 1, False)
    jump(field, 2.0, 2.0)
    field.step(0.1)
    assert turtle.seen == BLUE
    pen(field, RED, 3)
    field.call("turtle1/teleport_relative", {"linear": 1.0, "angular": 0.0}, 0.2)
    assert color_at(field, 2.5, 2.0) == RED


@pytest.mark.parametrize("value", [math.nan, math.inf, -1e39])
def test_what_no_message_holds_is_refused_and_moves_nothing(field, value):
    for call in (
        lambda: drive(field, value),
        lambda: jump(field, 1.0, value),
        lambda: field.call("turtle1/teleport_relative", {"linear": 0.0, "angular": value}, 0.0),
        lambda: spawn(field, "", x=value),
    ):
        with pytest.raises(ValueError, match="is not a length"):
            call()
    field.step(1.0)
    poses = {name: turtle.pose[:3] for name, turtle in field.turtles.items()}
    assert poses == {"turtle1": START}


@pytest.mark.parametrize(("width", "reach"), [(1, 0), (3, 1), (9, 4), (None, 1)])
def test_a_line_is_as_wide_as_its_pen_and_has_square_ends(field, width, reach):
    field.call("kill", {"name": "turtle1"}, 0.0)
    spawn(field, "turtle1", 1.0, 2.0)
    if width:
        pen(field, PEN, width)
    jump(field, 3.0, 2.0)
    around = [(k, n) for k in range(-20, 111) for n in range(-20, 21)]
    drawn = {(k, n) for k, n in around if color_at(field, 1 + k * PIXEL_M, 2 + n * PIXEL_M) == PEN}
    ends = range(-reach, 91 + reach)
    assert drawn == {(k, n) for k in ends for n in range(-reach, reach + 1)}


def test_lines_to_far_away_are_cut_at_the_edge(field):
    pen(field, RED, 3)
    jump(field, 1e38, START[1])
    assert color_at(field, FIELD_M, START[1]) == RED and color_at(field, 0.0, START[1]) == BLUE
    spawn(field, "b", *START[:2])
    field.call("b/teleport_absolute", {"x": -1e38, "y": -1e38, "theta": 0.0}, 0.0)
    assert color_at(field, 1.0, 1.11) == PEN  # to 20,000 pixels left and below


def test_the_picture_is_new_while_turtles_move_and_shows_them(field):
    def picture():
        return field.version, Image.open(BytesIO(field.picture("PNG"))).getpixel((250, 250))

    before = picture()
    field.step(1.0)
    assert picture() == before and before[1] not in (BLUE, PEN)
    pen(field, PEN, 3)
    assert field.version > before[0]
    drive(field, 5.0)
    field.step(1.5)
    assert picture()[0] > before[0] and picture()[1] == PEN


HALF = (22, 15 - 5j, 13 - 14j, 7 - 11j, -9 - 11j, -16 - 14j)  # ahead + right * j [pixels]


def test_the_picture_is_the_lines_with_turtles_as_they_head_and_their_names(field):
    for k in range(4):
        spawn(field, "", 2.0 + k, 3.1, 0.7 * k)
    expected = Image.new("RGB", (500, 500), BLUE)
    draw = ImageDraw.Draw(expected)
    for (name, turtle), color in zip(field.turtles.items(), (*COLORS, COLORS[0])):
        x, y, theta = turtle.pose[:3]
        at, turn = complex(45 * x, 499 - 45 * y), cmath.rect(1.0, -theta)
        corners = (*HALF, -20, *(p.conjugate() for p in HALF[:0:-1]))
        outline = [at + turn * corner for corner in corners]
        draw.polygon([(p.real, p.imag) for p in outline], color, "#222")
        for shift, shade in ((17, "#222"), (16, "white")):
            draw.text((at.real + shift, at.imag + shift), name, shade)
    shown = Image.open(BytesIO(field.picture("PNG")))
    assert ImageChops.difference(shown, expected).getbbox() is None


MIDDLE = FIELD_M / 2


def approx(*values):
    return pytest.approx(values, abs=1e-6)


def pose(turtle):
    return turtle.pose[:3]


def driven(command, *times, theta=0.0):
    """Return a turtle that got a command at 0 s and drove from time to time [s]."""
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
