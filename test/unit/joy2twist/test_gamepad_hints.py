"""Hints that a gamepad is switched to another mode."""

from joy_to_twist.gamepad_hints import GamepadHints
from joy_to_twist.parameters import load


def hints(messages, **given):
    looker = GamepadHints(load(given))
    return [hint for hint in map(looker.hint, messages) if hint]


def six(**values):
    return tuple(values.get(f"a{i}", 0.0) for i in range(6))


def test_another_number_of_axes_than_the_preset_expects_is_said_once():
    (hint,) = hints([(0.0,) * 8] * 3, gamepad_axes=6)
    assert "8 axes and not 6" in hint
    assert "D/X switch" in hint


def test_the_expected_number_of_axes_needs_no_hint():
    assert hints([(0.0,) * 6] * 3, gamepad_axes=6) == []


def test_without_an_expectation_any_number_is_fine():
    assert hints([(0.0,) * n for n in range(12)]) == []


def test_a_stick_that_moves_axes_4_and_5_is_said_once():
    (hint,) = hints([six(), six(a5=0.4), six(a5=0.9), six(a4=-0.5)])
    assert "MODE" in hint


def test_worn_sticks_are_no_hint_and_end_no_search():
    assert hints([six(a1=0.1, a4=0.1, a5=-0.1)]) == []
    (hint,) = hints([six(a1=0.1), six(a5=0.11)])
    assert "MODE" in hint


def test_nothing_more_is_looked_for_once_the_stick_has_moved():
    looker = GamepadHints(load({}))
    assert not looker.finished
    looker.hint(six())
    assert not looker.finished
    looker.hint(six(a1=-0.5))
    assert looker.finished
    looker.hint((0.0,) * 8)
    assert looker.finished  # of 8 axes nothing can be swapped


def test_a_swapped_stick_gives_whole_steps_as_a_d_pad_does():
    (hint,) = hints([six(), six(a5=1.0), six(a4=-1.0), six()])
    assert "left stick" in hint


def test_once_the_stick_has_moved_there_is_no_hint():
    assert hints([six(a1=0.5), six(a5=0.4)]) == []


def test_axes_4_and_5_may_be_in_use():
    assert hints([six(a5=0.4)], axis_linear=5, axis_angular=4) == []


def test_a_pad_with_other_than_six_axes_has_no_such_led():
    assert hints([(0.0,) * 5 + (0.5, 0.0, 0.0)]) == []


def test_a_message_without_the_axes_in_use_is_no_trouble():
    assert hints([six(a4=0.5)], axis_linear=7) != []


def test_an_axis_just_beyond_those_that_are_there_is_not_looked_at():
    assert hints([six(), six(a1=0.5)], axis_linear=6) == []
