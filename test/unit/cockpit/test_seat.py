"""The seat: who drives, and when the operator is lost. Times are numbers; nothing waits."""

import pytest

from cockpit_server.seat import (
    AWAY_S,
    BAG,
    FROZEN_S,
    LATE_S,
    PAGE,
    SILENCE_S,
    Input,
    RefusedError,
    is_neutral,
    neutral_of,
)
from tutorial_testing.seat_room import ANNA, BOB, DRIVE, PERIOD_S, REST, Room


@pytest.fixture
def room():
    return Room()


def assert_stopped_until_released(room):
    """One neutral message, then silence, whatever the hand does; LB released, and it drives."""
    assert room.sent == [("ada", *REST)]
    room.sent.clear()
    for _ in range(10):
        room.say(DRIVE)
    assert room.sent == []
    room.say(REST)
    room.say(DRIVE)
    assert room.sent == [("ada", *REST), ("ada", *DRIVE)]


def test_every_fresh_input_is_published_at_once(room):
    room.drive()
    for _ in range(3):
        room.say(DRIVE)
    assert room.sent == 3 * [("ada", *DRIVE)]


def test_nothing_before_all_was_seen_released(room):
    room.seat.take(ANNA, "ada", PAGE, room.now)
    for _ in range(5):
        room.say(DRIVE)
    assert room.sent == []


def test_silence_is_a_loss(room):
    room.drive()
    room.pass_time(SILENCE_S - 0.01)
    assert room.sent == []
    room.pass_time(0.03)
    assert room.lost == [(ANNA, "no input from the page for 0.2 s")]
    assert_stopped_until_released(room)


def test_a_silence_that_no_tick_noticed_is_noticed_by_the_next_input(room):
    room.drive()
    room.now += 1.0
    room.say(DRIVE)
    assert_stopped_until_released(room)


def test_what_the_page_says_of_itself_is_a_loss(room):
    room.drive()
    room.seat.release(ANNA, "hidden")
    assert room.lost == [(ANNA, "hidden")]
    assert_stopped_until_released(room)


def test_a_page_that_is_closed_loses_the_seat(room):
    room.drive()
    room.seat.gone(ANNA)
    assert room.sent == [("ada", *REST)]
    assert room.seat.driver is None
    room.say(DRIVE)
    assert room.sent == [("ada", *REST)]


def test_an_input_after_all_that_while_takes_no_seat(room):
    room.seat.take(ANNA, "", PAGE, room.now)
    room.say(REST)
    room.now += AWAY_S  # and no tick: the server itself was away
    room.say(REST)
    assert room.seat.driver is None
    assert not room.seat.armed
    assert room.sent == [("", *REST), ("", *REST)]  # the one that stops, and none of nobody's


def test_late_input_is_dropped_and_is_no_sign_of_life(room):
    room.drive()
    for i in range(6):  # as from a queue: each is older
        room.say(DRIVE, delay_s=LATE_S + 0.01 + PERIOD_S * i)
    assert room.sent == [("ada", *REST)]
    assert len(room.lost) == 1


def test_a_page_that_sees_no_beats_is_lost(room):
    room.drive()
    seen = room.beats
    for _ in range(6):
        room.say(DRIVE, beat=seen)
    fresh = int(SILENCE_S / PERIOD_S)
    assert room.sent[:fresh] == fresh * [("ada", *DRIVE)]
    room.pass_time(SILENCE_S)
    assert room.sent[fresh:] == [("ada", *REST)]


def test_an_input_counts_once(room):
    room.drive()
    room.say(DRIVE)
    room.say(DRIVE, n=room.n)
    room.say(DRIVE, n=room.n - 2)
    assert room.sent == [("ada", *DRIVE)]


def test_a_pad_that_stands_still_is_a_loss(room):
    room.drive()
    for i in range(10):
        room.say(DRIVE, pad=1000.0 + i)
    room.sent.clear()
    for _ in range(int(FROZEN_S / PERIOD_S) + 2):
        room.say(DRIVE, pad=1009.0)
    assert room.lost == [(ANNA, "the gamepad sends nothing new: it is frozen or out of reach")]
    assert room.sent[-1] == ("ada", *REST)


def test_a_pad_that_is_back_drives_after_a_release(room):
    test_a_pad_that_stands_still_is_a_loss(room)
    room.sent.clear()
    room.say(DRIVE, pad=2000.0)
    assert room.sent == []
    room.say(REST, pad=2001.0)
    room.say(DRIVE, pad=2002.0)
    assert room.sent[-1] == ("ada", *DRIVE)


def test_a_pad_that_nobody_touches_may_stand_still(room):
    room.drive()
    room.say(REST, pad=1000.0)
    for _ in range(100):
        room.say(REST, pad=1000.0)
    assert room.lost == []


def test_a_hand_over_stops_the_robot_and_wants_the_new_hand_released(room):
    room.drive()
    room.seat.hand_over(ANNA, BOB, room.now)
    assert room.seat.driver == BOB and room.seat.robot == "ada"
    assert room.sent == [("ada", *REST)]
    room.n = 0
    room.say(DRIVE, client=BOB)
    room.say(DRIVE, client=ANNA)
    assert room.sent == [("ada", *REST)]
    room.say(REST, client=BOB)
    room.say(DRIVE, client=BOB)
    assert room.sent[1:] == [("ada", *REST), ("ada", *DRIVE)]


def test_another_robot_leaves_the_first_one_at_rest(room):
    room.drive()
    room.seat.take(ANNA, "bob", PAGE, room.now)
    assert room.sent == [("ada", *REST)]


def test_standing_up_leaves_the_robot_at_rest(room):
    room.drive()
    room.seat.leave(ANNA)
    assert room.sent == [("ada", *REST)]
    assert room.seat.driver is None and room.lost == []


def test_the_end_of_the_server(room):
    room.drive()
    room.seat.end()
    room.say(REST)
    room.say(DRIVE)
    assert room.sent == [("ada", *REST)]
    with pytest.raises(RefusedError, match="shut down"):
        room.seat.take(ANNA, "ada", PAGE, room.now)


def test_a_recording_takes_the_same_place(room):
    room.seat.take(ANNA, "ada", BAG, room.now)
    room.seat.play(*DRIVE)
    room.say(DRIVE)  # a hand beside it has no say
    assert room.sent == [("ada", *DRIVE)]
    with pytest.raises(RefusedError):
        room.seat.take(BOB, "ada", PAGE, room.now)
    room.seat.release(ANNA, "hidden")
    room.seat.play(*DRIVE)
    assert room.sent == [("ada", *DRIVE), ("ada", *REST)]
    assert room.seat.driver is None


def test_a_recording_needs_no_beats(room):
    room.seat.take(ANNA, "ada", BAG, room.now)
    room.pass_time(2 * AWAY_S)
    assert room.seat.driver == ANNA


def test_neutral_of_x_mode_has_its_triggers_at_one():
    axes, buttons = neutral_of((0.0, 1.0, 1.0, 0.0, 0.0, -1.0, 0.0, 0.0), (1,) * 11)
    assert axes == (0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0)
    assert buttons == (0,) * 11
    assert is_neutral(axes, buttons)
    assert not is_neutral((0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0), buttons)  # RT half pulled
    assert not is_neutral(*DRIVE)
    for axis, is_released in ((0.1, True), (-0.1, True), (0.1001, False), (-0.1001, False)):
        assert is_neutral((axis, 0.0, 0.0, 0.0, 0.0, 0.0), REST[1]) == is_released


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
