"""The seat's bounds, in numbers: the last moment that is still well, and what comes after it."""

import pytest

from cockpit_server.seat import PAGE, Input
from tutorial_testing.seat_room import ANNA, DRIVE, REST, Room

SILENT = "no input from the page for 0.2 s"
FROZEN = "the gamepad sends nothing new: it is frozen or out of reach"
STICK = ((0.0, 0.5, 0.0, 0.0, 0.0, 0.0), DRIVE[1])


@pytest.fixture
def room():
    return Room()


def sit(room):
    """Let Anna sit down, and the server beat once, with the number 1."""
    room.seat.take(ANNA, "ada", PAGE, 0.0)
    room.seat.beat(1, 0.0)


def hand(room, n, now, position=REST, *, t=None, beat=1, pad=None):
    """Say one input as it is. t: 1000 now, unless it was on its way for a while."""
    message = Input(n, 1000 * now if t is None else t, beat, *position, pad)
    room.seat.input(ANNA, message, now)


def test_silence_for_a_fifth_of_a_second_is_a_loss_and_for_five_frees_the_seat(room):
    sit(room)
    hand(room, 1, 0.0)
    for now, lost, driver in (
        (0.2, [], ANNA),
        (0.201, [SILENT], ANNA),
        (5.0, [SILENT], ANNA),
        (5.001, [SILENT, "no input from the page for 5 s"], None),
    ):
        room.seat.tick(now)
        assert [why for _, why in room.lost] == lost
        assert (room.seat.driver, room.seat.armed) == (driver, not lost)
    assert room.seat.why == ""  # it stood before


FRESH = {  # inputs after the beat 1 at the time 0 -> the number of the last that is taken
    "others were lost on the way": ([{"n": 1, "now": 0.0}, {"n": 7, "now": 0.0}], 7),
    "a beat of 0.2 s ago": ([{"n": 1, "now": 0.2}], 1),
    "an older beat": ([{"n": 1, "now": 0.2}, {"n": 2, "now": 0.201}], 1),
    "no beat that was sent": ([{"n": 1, "now": 0.1, "beat": 2}], 0),
    "0.1 s later than the fastest": (
        [{"n": 1, "now": 0.1, "t": 100.0}, {"n": 2, "now": 0.1, "t": 0.0}], 2),
    "later": ([{"n": 1, "now": 0.1, "t": 100.0}, {"n": 2, "now": 0.1, "t": -1.0}], 1),
    "after 5 s without a tick": ([{"n": 1, "now": 0.1}, {"n": 2, "now": 5.2}], 0),
}  # fmt: skip


@pytest.mark.parametrize("case", FRESH)
def test_inputs_that_are_fresh(room, case):
    inputs, newest = FRESH[case]
    sit(room)
    for one in inputs:
        hand(room, **one)
    assert room.seat.newest == newest
    assert set(room.sent) <= {("ada", *REST)}


@pytest.mark.parametrize(("share", "taken"), [(0.9e-3, 100), (2.0e-3, 26)])  # 25 times 4 ms: 0.1 s
def test_a_page_clock_may_be_slow_by_a_thousandth(room, share, taken):
    sit(room)
    for n in range(1, taken + 1 + (taken < 100)):
        room.seat.beat(n, 4.0 * n)
        hand(room, n, 4.0 * n, t=(1 - share) * 4000.0 * n, beat=n)
    assert room.seat.newest == taken


def held(*pads, now=0.0):
    """Hold the stick still while the gamepad's own time is this."""
    return [(now, STICK, pad) for pad in pads]


def still(pad):
    """Hold it for a fifth of a second, and for a moment longer."""
    return held(pad, now=0.2) + held(pad, now=0.201)


MOVED = [(0.0, ((0.0, 0.5 + n / 100, 0.0, 0.0, 0.0, 0.0), DRIVE[1]), n) for n in range(20)]
PADS = {  # (time, position, the gamepad's own time) -> whether it is frozen at the last, not before
    "it went on 7 times": (held(*range(8)) + still(7), False),
    "8 times": (held(*range(9)) + still(8), True),
    "another gamepad, with an earlier time": (
        held(*range(1000, 1009)) + held(5, now=0.15) + held(5, now=0.25), False),
    "7 times after it stood still": (held(*range(8), 7, *range(8, 15)) + still(14), False),
    "while it moved": (MOVED + still(19), False),
    "released": ([(now, REST, pad) for now, _, pad in held(*range(9)) + still(8)], False),
}  # fmt: skip


@pytest.mark.parametrize("case", PADS)
def test_a_gamepad_whose_time_went_on_eight_times_is_frozen_after_a_fifth_of_a_second(room, case):
    inputs, is_frozen = PADS[case]
    sit(room)
    hand(room, 1, 0.0)
    for n, (now, position, pad) in enumerate(inputs, 2):
        assert room.lost == []
        room.seat.beat(n, now)
        hand(room, n, now, position, beat=n, pad=pad)
    assert room.lost == [(ANNA, FROZEN)] * is_frozen
    assert room.sent[-1] == ("ada", *(REST if is_frozen else inputs[-1][1]))
