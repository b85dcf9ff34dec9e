"""The seat's bounds, in numbers: to the last moment that is still well, and what comes after it."""

import pytest

from cockpit_server.seat import BAG, PAGE, Input, RefusedError
from tutorial_testing.seat_room import ANNA, BOB, DRIVE, REST, Room

LOWER = 0  # a client that came before the others
SILENT = (ANNA, "no input from the page for 0.2 s")
FROZEN = (ANNA, "the gamepad sends nothing new: it is frozen or out of reach")
STICK = ((0.0, 0.5, 0.0, 0.0, 0.0, 0.0), DRIVE[1])


@pytest.fixture
def room():
    return Room()


def sit(room, now=0.0):
    """Anna sits down, and the server beats once, with the number 1."""
    room.seat.take(ANNA, "ada", PAGE, now)
    room.seat.beat(1, now)


def hand(room, n, now, position=REST, *, t=None, beat=1, pad=None):
    """One input, as it is; t: 1000 now, unless it was on its way for a while."""
    message = Input(n, 1000 * now if t is None else t, beat, *position, pad)
    room.seat.input(ANNA, message, now)


def test_a_seat_that_nobody_took(room):
    assert room.seat.state == (None, "", PAGE, False, "")
    assert room.seat.newest == 0
    hand(room, 1, 0.0)
    room.seat.tick(1000.0)
    room.seat.play(*DRIVE)
    room.seat.lose("hidden")
    room.seat.free("away")
    assert (room.sent, room.lost) == ([], [])
    assert room.seat.state == (None, "", PAGE, False, "")


def test_what_all_pages_are_told(room):
    room.seat.take(ANNA, "ada", PAGE, room.now)
    assert room.seat.state == (ANNA, "ada", PAGE, False, "")
    room.say(REST)
    assert room.seat.state == (ANNA, "ada", PAGE, True, "")
    room.say(DRIVE)
    room.seat.release(ANNA, "hidden")
    assert room.seat.state == (ANNA, "ada", PAGE, False, "hidden")
    assert room.seat.stopped == "ada"
    room.seat.gone(ANNA)  # the robot stands for the first reason
    assert room.seat.state == (None, "", PAGE, False, "hidden")
    why = "the page was closed, or the network is down"
    assert room.lost == [(ANNA, "hidden"), (ANNA, why)]
    room.seat.take(BOB, "bob", BAG, room.now)
    assert room.seat.state == (BOB, "bob", BAG, True, "")
    assert room.seat.stopped is None


def test_after_a_fifth_of_a_second_without_input_the_operator_is_lost(room):
    sit(room)
    hand(room, 1, 0.0)
    room.seat.tick(0.2)
    assert room.lost == [] and room.seat.armed
    room.seat.tick(0.201)
    assert room.lost == [SILENT] and not room.seat.armed


FRESH = {  # inputs after the beat 1 at the time 0 -> the number of the last that is taken
    "number 0": ([{"n": 0, "now": 0.0}], 0),
    "others were lost on the way": ([{"n": 1, "now": 0.0}, {"n": 7, "now": 0.0}], 7),
    "a beat of 0.2 s ago": ([{"n": 1, "now": 0.2}], 1),
    "an older beat": ([{"n": 1, "now": 0.2}, {"n": 2, "now": 0.201}], 1),
    "no beat that was sent": ([{"n": 1, "now": 0.1, "beat": 2}], 0),
    "0.1 s later than the fastest": (
        [{"n": 1, "now": 0.1, "t": 100.0}, {"n": 2, "now": 0.1, "t": 0.0}], 2),
    "later": ([{"n": 1, "now": 0.1, "t": 100.0}, {"n": 2, "now": 0.1, "t": -1.0}], 1),
}  # fmt: skip


@pytest.mark.parametrize("case", FRESH)
def test_inputs_that_are_fresh(room, case):
    inputs, newest = FRESH[case]
    sit(room)
    for one in inputs:
        hand(room, **one)
    assert room.seat.newest == newest
    assert set(room.sent) <= {("ada", *REST)}


def test_of_the_beats_the_newest_sixteen_count(room):
    sit(room)
    for number in range(2, 17):
        room.seat.beat(number, 0.0)
    hand(room, 1, 0.0, beat=1)
    assert room.seat.newest == 1
    for number in range(17, 40):
        room.seat.beat(number, 0.0)
        hand(room, 2 * number, 0.0, beat=number - 15)
        hand(room, 2 * number + 1, 0.0, beat=number - 16)
        assert room.seat.newest == 2 * number


def test_the_beats_of_the_last_driver_are_none_of_the_next_one(room):
    sit(room)
    room.seat.take(ANNA, "bob", PAGE, 0.0)
    hand(room, 1, 0.0)
    assert room.seat.newest == 0


def inputs_of_a_page_whose_clock_is_slow_by(share, room):
    sit(room)
    for n in range(1, 101):
        room.seat.beat(n, 4.0 * n)
        hand(room, n, 4.0 * n, t=(1 - share) * 4000.0 * n, beat=n)
        if room.seat.newest < n:
            return n - 1
    return 100


@pytest.mark.parametrize(("share", "taken"), [(0.9e-3, 100), (2.0e-3, 26)])  # 25 times 4 ms: 0.1 s
def test_a_clock_that_is_slow_by_less_than_a_thousandth_is_no_delay(room, share, taken):
    assert inputs_of_a_page_whose_clock_is_slow_by(share, room) == taken


def test_five_seconds_without_input_free_the_seat(room):
    sit(room)
    room.seat.tick(5.0)
    assert room.seat.driver == ANNA
    room.seat.tick(5.001)
    assert room.seat.state == (None, "", PAGE, False, "")  # it stood before
    assert room.lost[-1] == (ANNA, "no input from the page for 5 s")


def ticking(room, ticks, pad=0.0):
    """A stick is held while the gamepad's own time goes on so often, all at time 0.

    The number of the last input, and the gamepad's time in it.
    """
    hand(room, 1, 0.0)
    for tick in range(ticks + 1):
        hand(room, 2 + tick, 0.0, STICK, pad=pad + tick)
    return 2 + ticks, pad + ticks


@pytest.mark.parametrize(("ticks", "lost"), [(7, []), (8, [FROZEN])])
def test_a_gamepad_whose_time_went_on_eight_times_is_frozen_after_a_fifth_of_a_second(
    room, ticks, lost
):
    sit(room)
    n, pad = ticking(room, ticks)
    hand(room, n + 1, 0.2, STICK, pad=pad)
    assert room.lost == []
    room.seat.beat(2, 0.2)
    hand(room, n + 2, 0.201, STICK, beat=2, pad=pad)
    assert room.lost == lost
    assert room.sent[-1] == ("ada", *(REST if lost else STICK))


def test_the_fifth_of_a_second_begins_when_its_time_stands_still(room):
    sit(room, 10.0)
    hand(room, 1, 10.0)
    for n in range(2, 11):
        hand(room, n, 10.0, STICK, pad=n)
    hand(room, 11, 10.19, STICK, pad=10)
    assert room.lost == []
    room.seat.beat(2, 10.2)
    hand(room, 12, 10.21, STICK, beat=2, pad=10)
    assert room.lost == [FROZEN]


def test_the_time_of_another_gamepad_may_be_earlier(room):
    sit(room)
    n, _ = ticking(room, 8, pad=1000.0)
    hand(room, n + 1, 0.15, STICK, pad=5.0)
    room.seat.beat(2, 0.15)
    hand(room, n + 2, 0.25, STICK, beat=2, pad=5.0)
    assert room.lost == []


@pytest.mark.parametrize(("ticks", "lost"), [(7, []), (8, [FROZEN])])
def test_when_its_time_stood_still_the_eight_are_counted_anew(room, ticks, lost):
    sit(room)
    n, pad = ticking(room, 7)
    hand(room, n + 1, 0.0, STICK, pad=pad)
    for tick in range(1, ticks + 1):
        hand(room, n + 1 + tick, 0.0, STICK, pad=pad + tick)
    room.seat.beat(2, 0.2)
    hand(room, n + 20, 0.2, STICK, pad=pad + ticks)
    hand(room, n + 21, 0.201, STICK, beat=2, pad=pad + ticks)
    assert room.lost == lost


def test_what_moves_or_has_no_time_of_its_own_is_not_counted(room):
    sit(room)
    hand(room, 1, 0.0)
    for n in range(2, 22):  # moves with every input
        hand(room, n, 0.0, ((0.0, n / 50, 0.0, 0.0, 0.0, 0.0), DRIVE[1]), pad=float(n))
    for n in range(22, 42):  # a finger on glass, now and then
        hand(room, n, 0.0, STICK, pad=None if n % 2 else float(n))
    room.seat.beat(2, 0.2)
    hand(room, 42, 0.2, STICK, pad=40.0)
    hand(room, 43, 0.201, STICK, beat=2, pad=40.0)
    assert room.lost == []


@pytest.mark.parametrize("other", [LOWER, BOB])
def test_who_does_not_sit_there_has_no_say(room, other):
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


def test_a_recording_is_not_handed_over(room):
    room.seat.take(ANNA, "ada", BAG, room.now)
    with pytest.raises(RefusedError, match="only the page that drives may hand over"):
        room.seat.hand_over(ANNA, BOB, room.now)
    assert room.seat.driver == ANNA


def test_a_recording_that_ends_before_its_first_message_sends_nothing(room):
    room.seat.take(ANNA, "ada", BAG, room.now)
    room.seat.leave(ANNA)
    room.seat.take(ANNA, "ada", BAG, room.now)
    room.seat.lose("the recording is over")
    assert room.sent == []
    assert room.lost == [(ANNA, "the recording is over")]
    assert room.seat.driver is None


def test_what_is_lost_is_told_once(room):
    room.drive()
    room.seat.lose("hidden")
    room.seat.lose("hidden")
    room.seat.release(ANNA, "frozen")
    assert room.lost == [(ANNA, "hidden")]
    assert room.seat.why == "hidden"
    assert room.sent == [("ada", *REST)]


def test_a_seat_that_is_taken_again_is_released_first(room):
    room.drive()
    room.seat.take(ANNA, "ada", PAGE, room.now)
    room.seat.beat(1, room.now)
    assert room.seat.newest == 0 and not room.seat.armed
    room.n = 0
    room.say(DRIVE)
    assert room.sent == [("ada", *REST)]
