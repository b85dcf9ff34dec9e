"""The driver without ROS and without a device: bytes and times in, axes and buttons out."""

import math
import random
import struct

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gamepad.driver.driver import LONGEST_LIFELESS_S, SHORTEST_SILENCE_S, Driver
from gamepad.driver.parameters import DriverParameters
from gamepad.driver.schedule import Schedule
from gamepad.js_event import SIGN_OF_LIFE_MS, Decoder, JsEvent, pack

BUTTON, AXIS, INIT = 1, 2, 0x80


def driver(kernel_device=True, triggers=(), **parameters):
    new = Driver(DriverParameters(**parameters))
    new.opened(triggers, kernel_device)
    return new


def events(*fields):
    """Bytes of events, given as (type, number, value)."""
    return b"".join([struct.pack("=IhBB", 0, value, kind, n) for kind, n, value in fields])


# ------------------------------------------------------------------------------------------ bytes


def test_an_event_is_read_field_by_field():
    assert Decoder().feed(bytes.fromhex("78563412 0180 02 05")) == [
        JsEvent(time_ms=0x12345678, value=-32767, type=2, number=5)
    ]


def test_the_time_of_a_sign_of_life_is_the_last_that_the_clock_can_show():
    assert SIGN_OF_LIFE_MS == 0xFFFF_FFFF


def test_unless_told_otherwise_the_state_at_opening_stays_one():
    """Only of a kernel's device it is known that it means a change, once there was one."""
    told = Decoder().feed(events((BUTTON, 0, 1)) + events((BUTTON | INIT, 0, 1)))
    assert [event.type for event in told] == [BUTTON, BUTTON | INIT]


@given(st.lists(st.binary(max_size=20)))
def test_reads_may_be_cut_anywhere(pieces):
    decoder = Decoder()
    one_by_one = [event for piece in pieces for event in decoder.feed(piece)]
    assert one_by_one == Decoder().feed(b"".join(pieces))


@given(st.binary())
def test_bytes_to_events_and_back(data):
    assert b"".join(map(pack, Decoder().feed(data))) == data[: len(data) - len(data) % 8]


def test_a_million_random_bytes_in_random_pieces():
    source = random.Random(5)
    noise, position, published = source.getrandbits(8_000_000).to_bytes(1_000_000, "little"), 0, 0
    noisy = driver()
    while position < len(noise):
        size = source.randrange(1, 600)
        for axes, buttons in noisy.read(noise[position : position + size], position * 1e-5):
            published += 1
            assert len(axes) <= 256 and all(-1.0001 <= axis <= 1.0001 for axis in axes)
            assert len(buttons) <= 256 and set(buttons) <= {0, 1}
        position += size
    assert published > 0 and noisy.unknown_events > 100_000


# ------------------------------------------------------------------------------------------ state


def upstream(sequence, deadzone, default_trig_val, sticky):
    """The messages of ROS Noetic's joy_node, if it publishes after each event, written plainly."""
    axes, buttons, before, switched = {}, {}, {}, {}
    messages = []
    for kind, number, value in sequence:
        if kind in (BUTTON, BUTTON + INIT):
            buttons[number] = 1 if value else 0
        elif kind == AXIS or (kind == AXIS + INIT and default_trig_val):
            size = max(0.0, abs(value) - 32767 * deadzone) / (32767 * (1 - deadzone))
            axes[number] = -size if value > 0 else size
        elif kind == AXIS + INIT:
            axes.setdefault(number, 0.0)
        else:
            continue
        for i, pressed in buttons.items():
            if pressed and not before.get(i):
                switched[i] = not switched.get(i, False)
        before = dict(buttons)
        shown = switched if sticky else buttons
        messages.append(
            (
                [axes.get(i, 0.0) for i in range(max(axes, default=-1) + 1)],
                [int(shown.get(i, 0)) for i in range(max(buttons, default=-1) + 1)],
            )
        )
    return messages


EVENTS = st.tuples(
    st.sampled_from((BUTTON, AXIS, BUTTON | INIT, AXIS | INIT, 0, 3, 0x42)),
    st.integers(0, 9),
    st.sampled_from((0, 1, -1, 1638, 1639, -1639, 32767, -32767, -32768))
    | st.integers(-32768, 32767),
)


@settings(max_examples=500)
@given(
    st.lists(EVENTS, max_size=40),
    st.sampled_from((0.0, 0.05, 0.5, 0.9)),
    st.booleans(),
    st.booleans(),
)
def test_every_sequence_gives_what_upstream_gives(sequence, deadzone, trigger, sticky):
    ours = driver(
        kernel_device=False,
        deadzone=deadzone,
        default_trig_val=trigger,
        sticky_buttons=sticky,
        coalesce_interval=0.0,
    )
    messages = [message for event in sequence for message in ours.read(events(event), now=0.0)]
    expected = upstream(sequence, deadzone, trigger, sticky)
    assert len(messages) == len(expected)
    for (axes, buttons), (expected_axes, expected_buttons) in zip(messages, expected):
        assert axes == pytest.approx(tuple(expected_axes), abs=1e-12)
        assert buttons == tuple(expected_buttons)


@pytest.mark.parametrize(
    ("value", "deadzone", "axis"),
    [
        (32767, 0.05, -1.0),
        (-32767, 0.05, 1.0),
        (1638, 0.05, 0.0),  # 0.05 of 32767 is 1638.35
        (-16384, 0.0, 16384 / 32767),
        (-16384, 0.05, (16384 / 32767 - 0.05) / 0.95),
        (29490, 1.0, 0.0),  # capped at 0.9
        (32767, 1.0, -1.0),
    ],
)
def test_left_and_up_are_positive_and_the_deadzone_is_rescaled(value, deadzone, axis):
    ours = driver(deadzone=deadzone)
    ours.read(events((AXIS, 0, value)), now=0.0)
    [(axes, _)] = ours.tick(0.5)
    assert axes == (pytest.approx(axis, abs=1e-12),)


def test_the_state_told_again_after_an_overrun_counts_for_a_kernel_device():
    burst = events((AXIS | INIT, 0, 5), (AXIS, 0, -32767), (AXIS | INIT, 0, 0))
    for kernel_device, axis in ((True, 0.0), (False, 1.0)):
        ours = driver(kernel_device)
        ours.read(burst, 0.0)
        assert ours.tick(0.001) == [((axis,), ())]


# ------------------------------------------------------------------------------------------- time


def test_axes_within_the_interval_go_out_together():
    ours = driver(coalesce_interval=0.01)
    assert ours.read(events((AXIS, 0, -32767)), now=1.0) == []
    assert ours.read(events((AXIS, 1, 32767)), now=1.009) == []
    assert ours.due == pytest.approx(1.01)  # counted from the first
    assert ours.tick(1.009) == []
    assert ours.tick(1.0101) == [((1.0, -1.0), ())]


def test_a_button_goes_out_at_once_and_takes_waiting_axes_along():
    ours = driver(autorepeat_rate=0)
    ours.read(events((AXIS, 0, -32767)), now=1.0)
    assert ours.read(events((BUTTON, 0, 1), (BUTTON, 0, 0)), now=1.0) == [
        ((1.0,), (1,)),
        ((1.0,), (0,)),
    ]
    assert ours.due == float("inf")


def test_the_first_state_waits_for_all_of_it():
    ours = driver()
    first = events((BUTTON | INIT, 0, 0), (BUTTON | INIT, 1, 1), (AXIS | INIT, 1, -9000))
    assert ours.read(first, now=0.0) == []
    assert ours.tick(0.001) == [((0.0, 0.0), (0, 1))]


def test_autorepeat_counts_from_the_last_message():
    ours = driver(autorepeat_rate=20)
    ours.read(events((BUTTON, 0, 1)), now=1.0)
    assert ours.due == pytest.approx(1.05)
    ours.read(events((BUTTON, 0, 0)), now=1.04)
    assert ours.tick(1.0501) == []
    assert ours.tick(1.0901) == [((), (0,))]


@pytest.mark.parametrize(("rate", "due"), [(0.5, 3.0), (1, 2.0), (0, math.inf), (-1, math.inf)])
def test_the_repetition_may_be_slow_or_off(rate, due):
    schedule = Schedule(0.001, rate)
    schedule.published(1.0)
    assert schedule.due == due


class Simulated:
    """A driver whose waits end on time. Times are whole numbers, so that their sums are exact."""

    def __init__(self, **parameters):
        self.driver = driver(deadzone=0.0, **parameters)
        self.now, self.sent = 0, 0
        self.untold = []  # when the changes were read that no message has told yet
        self.ages = []  # of the oldest untold change, for each message

    def change(self, after, pressed=False):
        """After a time an axis changes to the number of changes so far, and maybe a button."""
        self.now += after
        while self.driver.due < self.now:
            due = self.driver.due
            self.published(self.driver.tick(due), due)
        self.sent += 1
        self.untold.append(self.now)
        new = [(AXIS, 0, self.sent)] + [(BUTTON, 0, self.sent % 2)] * pressed
        self.published(self.driver.read(events(*new), self.now), self.now)

    def published(self, messages, now):
        for axes, _ in messages:
            assert round(-axes[0] * 32767) == self.sent, "not the newest state"
            self.ages.append(now - min(self.untold, default=now))
            self.untold = []


@settings(max_examples=500)
@given(
    st.lists(st.tuples(st.integers(0, 30), st.booleans()), max_size=60),
    st.integers(0, 20),
    st.sampled_from((0, 1 / 4, 1 / 32)),
)
def test_every_message_tells_the_newest_state_and_none_is_older_than_the_interval(
    changes, interval, autorepeat_rate
):
    simulated = Simulated(coalesce_interval=interval, autorepeat_rate=autorepeat_rate)
    for change in changes:
        simulated.change(*change)
        assert all(age <= interval for age in simulated.ages)
        assert simulated.driver.due <= min(simulated.untold, default=float("inf")) + interval


def test_a_burst_is_coalesced_to_one_message_in_an_interval():
    simulated = Simulated(coalesce_interval=5, autorepeat_rate=0)
    for _ in range(1000):  # one event in every unit of time
        simulated.change(1)
    assert simulated.ages == [5] * 166  # 6 units from one message to the next


# ------------------------------------------------------------------------------------------- loss


def test_a_lost_gamepad_gives_one_neutral_message_with_released_triggers():
    ours = driver(triggers=(2, 5))
    ours.read(events((AXIS, 5, 32767), (AXIS, 1, -32767), (BUTTON, 4, 1)), now=0.0)
    assert ours.lost(0.1) == [((0.0, 0.0, 1.0, 0.0, 0.0, 1.0), (0,) * 5)]
    assert ours.due == float("inf")
    assert ours.lost(0.2) == []  # still nobody to be told


def test_triggers_of_an_unknown_gamepad_are_told_by_the_number_of_axes():
    ours = driver(kernel_device=False, triggers=None)
    ours.read(events((AXIS, 7, 32767), (BUTTON, 4, 1)), now=0.0)
    assert ours.lost(0.1)[0][0] == (0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0)


def test_after_a_loss_it_is_silent_until_the_user_touches_the_gamepad():
    ours = driver()
    ours.read(events((BUTTON, 4, 1)), now=0.0)
    ours.lost(1.0)
    assert ours.opens_at == 1.0 + SHORTEST_SILENCE_S
    ours.opened((), kernel_device=True)
    assert ours.read(events((BUTTON | INIT, 4, 0), (AXIS | INIT, 0, 0)), now=2.0) == []
    assert ours.due == float("inf")
    assert ours.tick(9.0) == []
    assert ours.read(events((BUTTON, 4, 1)), now=9.5) == [((0.0,), (0, 0, 0, 0, 1))]


def test_sticky_buttons_are_released_by_a_loss():
    ours = driver(sticky_buttons=True)
    ours.read(events((BUTTON, 0, 1), (BUTTON, 0, 0)), now=0.0)
    assert ours.lost(0.1) == [((), (0,))]
    ours.opened((), kernel_device=True)
    assert ours.read(events((BUTTON, 0, 1)), now=1.0) == [((), (1,))]


# ------------------------------------------------------------------------------------ signs of life


def sign(*fields):
    """Bytes of a sign of life, given as (type, number, value)."""
    return b"".join(
        [struct.pack("=IhBB", SIGN_OF_LIFE_MS, value, kind | INIT, n) for kind, n, value in fields]
    )


STATE = ((BUTTON, 4, 1), (AXIS, 1, -32767))


def with_signs(kernel_device=False):
    """A driver that drives, and has heard a sign of life at 1.0 s."""
    one = driver(kernel_device, autorepeat_rate=0)
    one.read(events(*STATE), 0.9)
    one.tick(0.95)
    one.read(sign(*STATE), 1.0)
    return one


def test_a_source_that_gave_signs_and_gives_none_any_more_is_lifeless():
    one = with_signs()
    assert not one.is_lifeless(1.0 + LONGEST_LIFELESS_S - 0.01)
    assert one.due == 1.0 + LONGEST_LIFELESS_S
    assert one.is_lifeless(1.0 + LONGEST_LIFELESS_S)


def test_only_a_sign_is_a_sign_of_life():
    """A byte that was lost makes noise of all that comes after it, and noise is no life."""
    one = with_signs()
    one.read(b"?" + sign(*STATE), 1.2)
    one.read(events((AXIS, 0, 5)), 1.3)
    assert one.is_lifeless(1.0 + LONGEST_LIFELESS_S)


def test_every_sign_is_one_for_the_time_that_follows():
    one = with_signs()
    one.read(sign(*STATE), 1.4)
    assert not one.is_lifeless(1.5)
    assert one.is_lifeless(1.4 + LONGEST_LIFELESS_S)


def test_a_source_that_never_gave_a_sign_may_be_silent_for_ever():
    one = driver(kernel_device=False)
    one.read(events(*STATE), 1.0)
    assert not one.is_lifeless(1e9)


def test_a_kernel_device_gives_no_signs_whatever_its_clock_shows():
    one = driver(kernel_device=True)
    one.read(events(*STATE), 0.9)
    one.read(sign((AXIS, 1, 5)), 1.0)
    assert not one.is_lifeless(1e9)


def test_a_sign_publishes_nothing_and_moves_nothing():
    one = with_signs()
    assert one.read(sign((BUTTON, 4, 0), (AXIS, 1, 0)), 1.1) == []
    assert one.tick(1.2) == []
    ((axes, buttons),) = one.read(events((BUTTON, 0, 1)), 1.3)
    assert (axes[1], buttons[4]) == (pytest.approx(1.0), 1)


def test_a_reader_that_has_just_come_learns_the_size_of_the_gamepad():
    one = driver(kernel_device=False)
    one.read(sign(*((AXIS, n, 0) for n in range(6)), *((BUTTON, n, 0) for n in range(12))), 1.0)
    ((axes, buttons),) = one.read(events((BUTTON, 0, 1)), 1.1)
    assert (len(axes), len(buttons)) == (6, 12)


def test_after_a_loss_it_is_no_longer_lifeless():
    one = with_signs()
    one.lost(2.0)
    assert not one.is_lifeless(3.0)
    one.opened((), False)
    assert not one.is_lifeless(1e9)


def test_a_lifeless_source_is_lost_before_joy2twist_hears_silence_and_not_for_a_late_sign():
    assert 0.3 < LONGEST_LIFELESS_S < 0.5  # two signs of virtual_joystick; joy2twist's ~joy_timeout


def test_after_a_loss_it_is_silent_for_longer_than_joy2twist_waits():
    assert 0.5 < SHORTEST_SILENCE_S < 1.0  # joy2twist's ~joy_timeout


def test_before_the_first_gamepad_there_is_nothing_to_say():
    fresh = Driver(DriverParameters())
    assert fresh.due == float("inf")
    assert fresh.opens_at == -float("inf")
    assert fresh.tick(1.0) == []
    assert not fresh.is_lifeless(1e9)
    assert (fresh.events, fresh.unknown_events) == (0, 0)


def test_a_gamepad_that_never_said_anything_is_lost_without_a_word():
    ours = driver()
    assert ours.lost(1.0) == []
    assert ours.due == float("inf")


def test_the_events_are_counted():
    ours = driver()
    ours.read(events((BUTTON, 0, 1), (8, 0, 1), (AXIS, 0, 5)), 0.0)
    assert (ours.events, ours.unknown_events) == (3, 1)


def test_a_sticky_button_is_switched_off_by_the_second_press():
    ours = driver(sticky_buttons=True)
    shown = [ours.read(events((BUTTON, 1, value)), 0.1)[0][1] for value in (1, 0, 1, 0, 1)]
    assert shown == [(0, 1), (0, 1), (0, 0), (0, 0), (0, 1)]


def test_two_sticky_buttons_are_switched_apart():
    ours = driver(sticky_buttons=True)
    pressed = ((0, 1), (0, 0), (1, 1), (1, 0), (0, 1))
    shown = [ours.read(events((BUTTON, *press)), 0.1)[0][1] for press in pressed]
    assert shown == [(1,), (1,), (1, 1), (1, 1), (0, 1)]
