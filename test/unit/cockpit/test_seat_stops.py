"""Why a robot stands, as the seat knows it, and when the seat begins to drive."""

import pytest

from cockpit_server.seat import PAGE, Input
from tutorial_testing.seat_room import ANNA, DRIVE, REST, Room


@pytest.fixture
def room():
    return Room()


@pytest.mark.parametrize("lost", [lambda seat: seat.free("a rival"), lambda seat: seat.lose("x")])
def test_what_stopped_nothing_is_not_why_a_robot_stands(room, lost):
    room.seat.take(ANNA, "ada", PAGE, room.now)
    lost(room.seat)
    assert (room.seat.why, room.seat.stopped) == ("", None)
    room.seat.take(ANNA, "ada", PAGE, room.now)
    room.beat()
    room.say(REST)
    assert room.seat.armed
    lost(room.seat)
    assert (room.seat.why, room.seat.stopped) == ("", None)


def test_nobody_drives_before_those_who_hear_it_saw_that_all_is_released(room):
    room.seat.take(ANNA, "ada", PAGE, room.now)
    for n, (position, may_arm) in enumerate([(REST, False), (DRIVE, True), (REST, True)], 1):
        room.beat()
        said = Input(n, 1000 * room.now, room.beats, *position)
        assert room.sent == [] and not room.seat.armed
        room.seat.input(ANNA, said, room.now, may_arm)
    assert room.seat.armed and room.sent == [("ada", *REST)]


def test_why_a_robot_stands_is_old_once_anything_moves_it(room):
    room.drive()
    room.seat.free("the network is down")
    room.seat.moves_on("bob")
    assert (room.seat.why, room.seat.stopped) == ("the network is down", "ada")
    room.seat.moves_on("ada")
    assert (room.seat.why, room.seat.stopped) == ("", None)


def test_why_it_was_lost_is_worth_reading_until_it_moves_again(room):
    room.drive()
    room.seat.lose("hidden")
    room.say(REST)
    assert (room.seat.armed, room.seat.why) == (True, "hidden")
    room.say(DRIVE)
    assert room.seat.why == ""
