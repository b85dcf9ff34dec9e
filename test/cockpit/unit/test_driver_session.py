"""The session: who drives, and when the operator is lost. Times are numbers; nothing waits."""

import pytest

from cockpit_server.driving.driver_session import PageInput, is_neutral, neutral_of
from cockpit_server.errors import RefusedError
from tutorial_testing.claims import claim
from tutorial_testing.session_room import ANNA, BOB, DRIVE, REST, Room

SILENT = "no input from the page for 0.2 s"
CLOSED = "the page was closed, or the network is down"


@pytest.fixture
def room():
    return Room()


LOSSES = {
    "silence": (lambda room: room.pass_time(0.21), SILENT),
    "a silence that no tick noticed": (lambda room: setattr(room, "now", room.now + 1.0), SILENT),
    "the page says so": (lambda room: room.session.release(ANNA, "hidden"), "hidden"),
}


@claim(
    "Each loss of the operator sends one neutral message, then nothing until all was seen "
    "released, a gamepad too"
)
@pytest.mark.parametrize("case", LOSSES)
def test_a_loss_sends_one_neutral_message_and_then_nothing_until_all_is_released(room, case):
    lose, why = LOSSES[case]
    room.drive()
    lose(room)
    for _ in range(10):
        room.say(DRIVE)
    assert room.lost == [(ANNA, why)]
    assert (room.session.state, room.session.stopped) == ((ANNA, "ada", False, False, why), "ada")
    room.session.lose("hidden")  # already lost: nothing changes
    at_rest = room.sent.index(("ada", *REST))
    assert room.sent[:at_rest] == at_rest * [("ada", *DRIVE)]
    room.say(REST)
    assert room.session.state == (ANNA, "ada", False, True, why)  # the reason stays until it moves
    room.say(DRIVE)
    assert room.sent[at_rest:] == [("ada", *position) for position in (REST, REST, DRIVE)]
    assert (room.session.why, room.session.stopped) == ("", None)
    assert room.lost == [(ANNA, why)]


ENDS = {
    "the page is closed": (lambda session, _: session.gone(ANNA), None, [CLOSED]),
    "another joystick": (lambda session, _: session.free("a rival"), None, ["a rival"]),
    "the server ends": (lambda session, _: session.end(), None, ["the cockpit was shut down"]),
    "it stands up": (lambda session, _: session.leave(ANNA), None, []),
    "hand over": (lambda session, now: session.hand_over(ANNA, BOB, now), BOB, []),
    "another robot": (lambda session, now: session.take(ANNA, "bob", now), ANNA, []),
    "the same robot": (lambda session, now: session.take(ANNA, "ada", now), ANNA, []),
}


@claim(
    "The end of a drive (closed page, other joystick, server, hand-over) leaves the robot at rest"
)
@pytest.mark.parametrize("case", ENDS)
def test_the_end_of_a_drive_leaves_the_robot_at_rest(room, case):
    end, driver, lost = ENDS[case]
    room.drive()
    end(room.session, room.now)
    assert (room.session.driver, room.session.armed, room.session.newest) == (driver, False, 0)
    assert room.session.why == "".join(lost)
    assert ("shut down" in room.session.refusal(BOB)) == (case == "the server ends")
    room.n = 0
    for client in (ANNA, BOB):
        room.say(DRIVE, client=client)
    assert room.sent == [("ada", *REST)]
    assert room.lost == [(ANNA, why) for why in lost]


@claim("One page drives: others ...", because="every message of others")
@pytest.mark.parametrize("other", [0, BOB])
def test_other_clients_change_nothing(room, other):
    room.drive()
    room.session.leave(other)
    room.session.release(other, "hidden")
    room.session.gone(other)
    room.say(DRIVE, client=other)
    with pytest.raises(RefusedError, match="only the page that drives may hand over"):
        room.session.hand_over(other, other, room.now)
    with pytest.raises(RefusedError, match="another page drives; its driver may hand over"):
        room.session.take(other, "ada", room.now)
    assert (room.sent, room.lost) == ([], [])
    assert room.session.state == (ANNA, "ada", False, True, "")


@claim("A recording takes the same session, needs no beats, and plays from where it was put")
def test_a_recording_takes_the_same_place_and_needs_no_beats(room):
    room.session.take(ANNA, "ada", room.now, plays=True)
    room.pass_time(10.0)
    assert room.session.state == (ANNA, "ada", True, True, "")
    room.session.play(*DRIVE)
    room.say(DRIVE)  # the page's own input is ignored meanwhile
    assert room.sent == [("ada", *DRIVE)]
    with pytest.raises(RefusedError, match="only the page that drives may hand over"):
        room.session.hand_over(ANNA, BOB, room.now)
    room.session.release(ANNA, "hidden")
    room.session.play(*DRIVE)
    assert room.sent == [("ada", *DRIVE), ("ada", *REST)]
    assert room.session.driver is None


def test_neutral_has_the_triggers_of_x_mode_at_one():
    axes, buttons = neutral_of((0.0, 1.0, 1.0, 0.0, 0.0, -1.0, 0.0, 0.0), (1,) * 11)
    assert (axes, buttons) == ((0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0), (0,) * 11)
    assert is_neutral(axes, buttons)
    assert not is_neutral((0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0), buttons)  # RT half pulled
    for axis, is_released in ((0.1, True), (-0.1, True), (0.1001, False), (-0.1001, False)):
        assert is_neutral((axis, 0.0, 0.0, 0.0, 0.0, 0.0), REST[1]) == is_released


FROZEN = "the gamepad sends nothing new: it is frozen or out of reach"
STICK = ((0.0, 0.5, 0.0, 0.0, 0.0, 0.0), DRIVE[1])


def sit(room):
    """Give Anna the session, and send beat 1."""
    room.session.take(ANNA, "ada", 0.0)
    room.session.beat(1, 0.0)


def hand(room, n, now, position=REST, *, t=None, beat=1, pad=None):
    """Send one input. t: the page's time [ms], by default now: no time on the way."""
    message = PageInput(n, 1000 * now if t is None else t, beat, *position, pad)
    room.session.input(ANNA, message, now)


@claim("0.2 s of silence is a loss, 5 s free the session")
def test_silence_for_a_fifth_of_a_second_is_a_loss_and_for_five_frees_the_session(room):
    sit(room)
    hand(room, 1, 0.0)
    for now, lost, driver in (
        (0.2, [], ANNA),
        (0.201, [SILENT], ANNA),
        (5.0, [SILENT], ANNA),
        (5.001, [SILENT, "no input from the page for 5 s"], None),
    ):
        room.session.tick(now)
        assert [why for _, why in room.lost] == lost
        assert (room.session.driver, room.session.armed) == (driver, not lost)
    assert room.session.why == ""  # it was at rest before


FRESH = {  # inputs after beat 1 at 0 s -> the last number that is accepted; how many are sent on
    "others were lost on the way": ([{"n": 1, "now": 0.0}, {"n": 7, "now": 0.0}], 7, 2),
    "the same and an older one come after it": ([{"n": n, "now": 0.0} for n in (7, 7, 6)], 7, 1),
    "a beat of 0.2 s ago": ([{"n": 1, "now": 0.2}], 1, 1),
    "an older beat": ([{"n": 1, "now": 0.2}, {"n": 2, "now": 0.201}], 1, 1),
    "no beat that was sent": ([{"n": 1, "now": 0.1, "beat": 2}], 0, 0),
    "0.1 s later than the fastest": (
        [{"n": 1, "now": 0.1, "t": 100.0}, {"n": 2, "now": 0.1, "t": 0.0}], 2, 2),
    "later": ([{"n": 1, "now": 0.1, "t": 100.0}, {"n": 2, "now": 0.1, "t": -1.0}], 1, 1),
    "after 5 s without a tick": ([{"n": 1, "now": 0.1}, {"n": 2, "now": 5.2}], 0, 2),
}  # fmt: skip


@claim("What makes an input fresh: its number, its beat, its time on the way")
@pytest.mark.parametrize("case", FRESH)
def test_inputs_that_are_fresh(room, case):
    inputs, newest, sent = FRESH[case]
    sit(room)
    for fields in inputs:
        hand(room, **fields)
    assert room.session.newest == newest
    assert room.sent == sent * [("ada", *REST)]


def test_of_many_beats_sixteen_are_kept(room):
    sit(room)
    for number in range(2, 19):
        room.session.beat(number, 0.0)
    hand(room, 1, 0.0, beat=3)
    hand(room, 2, 0.0, beat=2)
    assert room.session.newest == 1


@pytest.mark.parametrize(("share", "taken"), [(0.9e-3, 100), (2.0e-3, 26)])  # 25 times 4 ms: 0.1 s
def test_a_page_clock_may_be_slow_by_a_thousandth(room, share, taken):
    sit(room)
    for n in range(1, taken + 1 + (taken < 100)):
        room.session.beat(n, 4.0 * n)
        hand(room, n, 4.0 * n, t=(1 - share) * 4000.0 * n, beat=n)
    assert room.session.newest == taken


def held(*pads, now=0.0):
    """Return inputs of a stick held still, one for each of these times of the gamepad."""
    return [(now, STICK, pad) for pad in pads]


def still(pad):
    """Return the same input after a fifth of a second, and a moment later."""
    return held(pad, now=0.2) + held(pad, now=0.201)


MOVED = [(0.0, ((0.0, 0.5 + n / 100, 0.0, 0.0, 0.0, 0.0), DRIVE[1]), n) for n in range(20)]
PADS = {  # (time, position, the gamepad's own time) -> whether the last input shows it frozen
    "it went on 7 times": (held(*range(8)) + still(7), False),
    "8 times": (held(*range(9)) + still(8), True),
    "more often": (held(*range(20)) + still(19), True),
    "another gamepad, with an earlier time": (
        held(*range(1000, 1009)) + held(5, now=0.15) + held(5, now=0.25), False),
    "7 times after a rest": (held(*range(8), 7, *range(8, 15)) + still(14), False),
    "while it moved": (MOVED + still(19), False),
    "released": ([(now, REST, pad) for now, _, pad in held(*range(9)) + still(8)], False),
}  # fmt: skip


@claim("A gamepad that stands still is frozen after 0.2 s, if its time went on by itself")
@pytest.mark.parametrize("case", PADS)
def test_a_gamepad_whose_time_went_on_eight_times_is_frozen_after_a_fifth_of_a_second(room, case):
    inputs, is_frozen = PADS[case]
    sit(room)
    hand(room, 1, 0.0)
    for n, (now, position, pad) in enumerate(inputs, 2):
        assert room.lost == []
        room.session.beat(n, now)
        hand(room, n, now, position, beat=n, pad=pad)
    assert room.lost == [(ANNA, FROZEN)] * is_frozen
    assert room.sent[-1] == ("ada", *(REST if is_frozen else inputs[-1][1]))
