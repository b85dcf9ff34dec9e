"""common/doc/FROM_STICK_TO_WHEEL.md names the rooms that a Joy passes: all, in their order."""

import re
from pathlib import Path

import pytest
from test_layers import ALL, imported, path_of

PAGE = Path(__file__).resolve().parents[2] / "common/doc/FROM_STICK_TO_WHEEL.md"
# The legs of the way, in their order; each ends with its node.
LEGS = ("gamepad.", "joy_to_twist.", "fake_turtlebot_sim.mux.", "fake_turtlebot_sim.simulator.")
NOT_ON_THE_WAY = ("gamepad.virtual.", "gamepad.arguments")
# What the page says to stand beside the way, by its last name.
BESIDE = {"parameters", "report", "diagnostics", "console", "gamepad_hints"}
# A room that imports another has been passed after it, but for these: they hand on to it.
HANDS_ON = {
    ("joy_to_twist.mapping", "joy_to_twist.limits"),
    ("node_kit.prompt_publisher", "node_kit.newest_only"),
}
ROWS = re.findall(
    r"^\| (\d+) \| `([\w.]+)` \| (.+) \| \[(.+)\]\((.+)\) \|$", PAGE.read_text(), re.M
)
ROOMS = [room for _, room, *_ in ROWS]


def leg(room):
    """The number of a room's leg; None for one of the kit, which serves all."""
    return next((n for n, start in enumerate(LEGS) if room.startswith(start)), None)


def test_the_rows_are_numbered():
    assert [int(number) for number, *_ in ROWS] == list(range(1, len(ROWS) + 1))
    assert PAGE.read_text().count("](") - len(ROWS) >= len(LEGS)  # no row escaped the pattern
    assert len(re.findall(r"^\| \d", PAGE.read_text(), re.M)) == len(ROWS)


@pytest.mark.parametrize("row", ROWS, ids=ROOMS)
def test_a_room_exists_and_has_its_file_and_idea(row):
    _, room, idea, name, link = row
    assert room in ALL
    assert (PAGE.parent / link).resolve() == path_of(room)
    assert name == path_of(room).name
    assert idea.strip()


def test_no_room_on_the_way_is_left_out():
    on_the_way = {
        room
        for room in ALL
        if leg(room) is not None
        and not room.startswith(NOT_ON_THE_WAY)
        and room.split(".")[-1] not in BESIDE
    }
    assert {room for room in ROOMS if leg(room) is not None} == on_the_way
    beside = PAGE.read_text().split("Beside the way")[1]
    assert all(f"`{name}`" in beside for name in BESIDE)


def test_the_legs_follow_each_other_and_end_with_their_nodes():
    legs = [leg(room) for room in ROOMS if leg(room) is not None]
    assert legs == sorted(legs)
    for number, start in enumerate(LEGS):
        assert [room for room in ROOMS if leg(room) == number][-1].endswith(".node"), start


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_comes_after_those_that_it_is_made_of(room):
    for other in imported(path_of(room)):
        same = other.split(".")[0] == room.split(".")[0]
        if other in ROOMS and same and (room, other) not in HANDS_ON:
            assert ROOMS.index(other) < ROOMS.index(room), other
