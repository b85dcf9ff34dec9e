"""The seat: who drives, and when the operator is lost. Times are numbers; nothing waits."""

import pytest

from cockpit_server.seat import BAG, PAGE, RefusedError, is_neutral, neutral_of
from tutorial_testing.seat_room import ANNA, BOB, DRIVE, REST, Room

SILENT = "no input from the page for 0.2 s"
CLOSED = "the page was closed, or the network is down"


@pytest.fixture
def room():
    return Room()


LOSSES = {
    "silence": (lambda room: room.pass_time(0.21), SILENT),
    "a silence that no tick noticed": (lambda room: setattr(room, "now", room.now + 1.0), SILENT),
    "the page says so": (lambda room: room.seat.release(ANNA, "hidden"), "hidden"),
}


@pytest.mark.parametrize("case", LOSSES)
def test_a_loss_sends_one_neutral_message_and_then_nothing_until_all_is_released(room, case):
    lose, why = LOSSES[case]
    room.drive()
    lose(room)
    for _ in range(10):
        room.say(DRIVE)
    assert room.lost == [(ANNA, why)]
    assert (room.seat.state, room.seat.stopped) == ((ANNA, "ada", PAGE, False, why), "ada")
    room.seat.lose("hidden")  # it is lost already: nothing changes
    at_rest = room.sent.index(("ada", *REST))
    assert room.sent[:at_rest] == at_rest * [("ada", *DRIVE)]
    room.say(REST)
    assert room.seat.state == (ANNA, "ada", PAGE, True, why)  # worth reading until it moves again
    room.say(DRIVE)
    assert room.sent[at_rest:] == [("ada", *position) for position in (REST, REST, DRIVE)]
    assert (room.seat.why, room.seat.stopped) == ("", None)
    assert room.lost == [(ANNA, why)]


ENDS = {
    "the page is closed": (lambda seat, _: seat.gone(ANNA), None, [CLOSED]),
    "another joystick": (lambda seat, _: seat.free("a rival"), None, ["a rival"]),
    "the server ends": (lambda seat, _: seat.end(), None, ["the cockpit was shut down"]),
    "it stands up": (lambda seat, _: seat.leave(ANNA), None, []),
    "hand over": (lambda seat, now: seat.hand_over(ANNA, BOB, now), BOB, []),
    "another robot": (lambda seat, now: seat.take(ANNA, "bob", PAGE, now), ANNA, []),
    "the same robot": (lambda seat, now: seat.take(ANNA, "ada", PAGE, now), ANNA, []),
}


@pytest.mark.parametrize("case", ENDS)
def test_the_end_of_a_drive_leaves_the_robot_at_rest(room, case):
    end, driver, lost = ENDS[case]
    room.drive()
    end(room.seat, room.now)
    assert (room.seat.driver, room.seat.armed, room.seat.newest) == (driver, False, 0)
    assert room.seat.why == "".join(lost)
    room.n = 0
    for client in (ANNA, BOB):
        room.say(DRIVE, client=client)
    assert room.sent == [("ada", *REST)]
    assert room.lost == [(ANNA, why) for why in lost]


def test_a_seat_that_has_ended_cannot_be_taken(room):
    room.seat.end()
    with pytest.raises(RefusedError, match="shut down"):
        room.seat.take(ANNA, "ada", PAGE, room.now)


@pytest.mark.parametrize("other", [0, BOB])
def test_other_clients_change_nothing(room, other):
    room.drive()
    room.seat.leave(other)
    room.seat.release(other, "hidden")
    room.seat.gone(other)
    room.say(DRIVE, client=other)
    with pytest.raises(RefusedError, match="only the page that drives may hand over"):
        room.seat.hand_over(other, other, room.now)
    with pytest.raises(RefusedError, match="another page drives; its driver may hand over"):
        room.seat.take(other, "ada", PAGE, room.now)
    assert (room.sent, room.lost) == ([], [])
    assert room.seat.state == (ANNA, "ada", PAGE, True, "")


def test_a_recording_takes_the_same_place_and_needs_no_beats(room):
    room.seat.take(ANNA, "ada", BAG, room.now)
    room.pass_time(10.0)
    assert room.seat.state == (ANNA, "ada", BAG, True, "")
    room.seat.play(*DRIVE)
    room.say(DRIVE)  # a hand beside it has no say
    assert room.sent == [("ada", *DRIVE)]
    with pytest.raises(RefusedError, match="only the page that drives may hand over"):
        room.seat.hand_over(ANNA, BOB, room.now)
    room.seat.release(ANNA, "hidden")
    room.seat.play(*DRIVE)
    assert room.sent == [("ada", *DRIVE), ("ada", *REST)]
    assert room.seat.driver is None


def test_neutral_has_the_triggers_of_x_mode_at_one():
    axes, buttons = neutral_of((0.0, 1.0, 1.0, 0.0, 0.0, -1.0, 0.0, 0.0), (1,) * 11)
    assert (axes, buttons) == ((0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0), (0,) * 11)
    assert is_neutral(axes, buttons)
    assert not is_neutral((0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0), buttons)  # RT half pulled
    for axis, is_released in ((0.1, True), (-0.1, True), (0.1001, False), (-0.1001, False)):
        assert is_neutral((axis, 0.0, 0.0, 0.0, 0.0, 0.0), REST[1]) == is_released
