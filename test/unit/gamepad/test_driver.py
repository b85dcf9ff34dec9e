"""The driver without ROS and without a device: bytes and times in, axes and buttons out."""

import random

import pytest

from gamepad.driver.driver import LONGEST_LIFELESS_S, SHORTEST_SILENCE_S, Driver
from gamepad.driver.parameters import DriverParameters
from gamepad.js_event import SIGN_OF_LIFE_MS
from tutorial_testing.gamepad_events import AXIS, BUTTON, INIT, driver, events, sign


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


def test_the_state_told_again_after_an_overrun_counts_for_a_kernel_device():
    burst = events((AXIS | INIT, 0, 5), (AXIS, 0, -32767), (AXIS | INIT, 0, 0))
    for kernel_device, axis in ((True, 0.0), (False, 1.0)):
        ours = driver(kernel_device)
        ours.read(burst, 0.0)
        assert ours.tick(0.001) == [((axis,), ())]


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
    assert one.is_lifeless(1e9)


def test_only_a_sign_is_a_sign_of_life():
    """A byte that was lost makes noise of all that comes after it, and noise is no life."""
    one = with_signs()
    one.read(b"?" + sign(*STATE), 1.2)
    one.read(events((AXIS, 0, 5)), 1.3)
    assert one.is_lifeless(1.0 + LONGEST_LIFELESS_S)


def test_noise_without_any_sign_is_no_life_either():
    """As after a byte was lost, and the source then opened anew in the middle of an event."""
    one = driver(kernel_device=False)
    one.read(b"???" + sign(*STATE), 1.0)
    one.read(sign(*STATE), 1.3)
    assert one.due <= 1.0 + LONGEST_LIFELESS_S
    assert not one.is_lifeless(1.0 + LONGEST_LIFELESS_S - 0.01)
    assert one.is_lifeless(1.0 + LONGEST_LIFELESS_S)


def test_a_kernel_device_may_make_noise_for_ever():
    one = driver(kernel_device=True)
    one.read(events((8, 0, 1)), 1.0)
    assert not one.is_lifeless(1e9)


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


def test_a_change_is_no_sign_whatever_its_time():
    one = driver(kernel_device=False)
    change = events((BUTTON, 0, 1), time_ms=SIGN_OF_LIFE_MS)
    assert one.read(change, 1.0) == [((), (1,))]
    assert not one.is_lifeless(1e9)


def test_a_change_that_comes_with_a_sign_is_told():
    one = with_signs()
    ((axes, buttons),) = one.read(sign(*STATE) + events((BUTTON, 0, 1)) + sign(*STATE), 1.2)
    assert (len(axes), buttons) == (2, (1, 0, 0, 0, 1))


def test_a_sign_of_an_axis_or_button_not_told_before_makes_room_for_it():
    for new, sizes in (((AXIS, 2, 0), (3, 5)), ((AXIS, 4, 0), (5, 5)), ((BUTTON, 9, 0), (2, 10))):
        one = with_signs()
        one.read(sign(new), 1.1)
        ((axes, buttons),) = one.read(events((BUTTON, 0, 1)), 1.2)
        assert (len(axes), len(buttons)) == sizes
    many_axes = driver(kernel_device=False)
    many_axes.read(events((AXIS, 5, 0), (BUTTON, 0, 1)) + sign((BUTTON, 3, 0)), 1.0)
    assert many_axes.lost(2.0) == [((0.0,) * 6, (0,) * 4)]


def test_what_is_known_is_not_changed_by_a_sign():
    """Neither of the two is taken for the other."""
    one = driver(kernel_device=False, autorepeat_rate=0)
    one.read(events((AXIS, 5, -32767), (BUTTON, 0, 1)), 1.0)
    assert one.read(sign((AXIS, 5, 0), (BUTTON, 0, 0)), 1.1) == []
    assert one.tick(2.0) == []
    ((axes, buttons),) = one.read(events((BUTTON, 1, 1)), 3.0)
    assert (axes[5], buttons) == (1.0, (1, 1))


def test_a_gamepad_that_came_back_and_was_not_touched_is_lost_without_a_word():
    ours = driver()
    ours.read(events((BUTTON, 4, 1)), 0.0)
    ours.lost(1.0)
    ours.opened((), kernel_device=True)
    ours.read(events((BUTTON | INIT, 4, 1)), 2.0)
    assert ours.lost(3.0) == []
    assert ours.opens_at == 3.0 + SHORTEST_SILENCE_S


def test_it_goes_out_when_it_is_due_and_not_before():
    ours = driver(coalesce_interval=0.25, autorepeat_rate=2)
    ours.read(events((AXIS, 0, -32767)), 1.0)
    assert ours.due == 1.25
    assert ours.tick(1.2) == []
    assert ours.tick(1.25) == [((1.0,), ())]
    assert ours.due == 1.75
    assert ours.tick(9.0) == [((1.0,), ())]
