"""The virtual gamepad: which one it is, and the FIFO that it serves."""

import os
import struct

import pytest

from gamepad.gamepads import F710, F710_D, F710_X, mode_hint, trigger_axes
from gamepad.trembling import Trembling
from gamepad.virtual.controls import Controls, positions
from gamepad.virtual.pads import PadError, StreamPad


def test_axes_and_buttons_of_both_modes():
    assert (len(F710_D.axes), len(F710_D.buttons), F710_D.usb_id) == (6, 12, "046d:c219")
    assert (len(F710_X.axes), len(F710_X.buttons), F710_X.usb_id) == (8, 11, "046d:c21f")
    for pad in F710.values():
        assert (pad.buttons.index("LB"), pad.buttons.index("RB")) == (4, 5)
        assert len(pad.buttons) == len(pad.button_codes)


def test_triggers_are_told_from_the_right_stick():
    assert F710_D.triggers == ()
    assert F710_X.triggers == (2, 5)
    assert trigger_axes([0, 1, 3, 4, 2, 5]) == (4, 5)


@pytest.mark.parametrize("pad", F710.values(), ids=F710)
def test_the_ends_and_the_middle_of_every_axis(pad):
    for axis in pad.axes:
        ends = [axis.js_value(axis.raw(position)) for position in (1.0, -1.0)]
        assert ends == [-32767, 32767]
        assert axis.js_value(axis.raw(0.0)) == 0


def test_the_kernels_steps_between():
    # By hand from joydev_correct(): 64 * ((1 << 29) // 127) >> 14
    assert F710_D.axes[0].js_value(127 + 64) == 16513
    assert F710_D.axes[0].js_value(127 - 64) == -16514
    assert F710_X.axes[0].js_value(-16384) == -16384


def test_hints_by_usb_id():
    assert "D mode" in mode_hint("046d:c219")
    assert "X mode" in mode_hint("046d:c21f")
    assert mode_hint("045e:028e") is None


def test_a_fifo_is_served_by_one_gamepad_only(tmp_path):
    path = str(tmp_path / "fifo")
    rest = positions(F710_D, Controls())
    with StreamPad(F710_D, path) as first:
        reader = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
        first.show(rest)
        assert first.connected
        with StreamPad(F710_D, path) as second, pytest.raises(PadError, match="another"):
            second.show(rest)
        assert os.path.exists(path)
        os.close(reader)
    assert not os.path.exists(path)


@pytest.mark.parametrize("pad", F710.values(), ids=F710)
def test_a_held_stick_trembles_by_one_step_and_nothing_else_does(pad):
    held = [
        axis.raw(position) for axis, position in zip(pad.axes, (1.0, -0.5, 1.0, 0.0, -1, 1, 1, 1))
    ]
    steps = [new - old for new, old in zip(pad.trembled(held), held)]
    assert steps == ([1, -1, 1, 0, 0, 0] if pad is F710_D else [1, -1, 0, 0, -1, 0, 0, 0])


def test_one_of_many_equal_messages_trembles_by_the_last_bit():
    trembling, held = Trembling(), (1.0, -0.5, 0.0)
    shown = [struct.pack("<3f", *trembling.shown(held)) for _ in range(20)]
    told = [k for k, data in enumerate(shown) if data != struct.pack("<3f", *held)]
    assert told == [7, 15]
    assert struct.unpack("<3f", shown[7]) == pytest.approx(held, rel=2e-7)
    assert struct.unpack("<3f", shown[7])[2] == 0.0
    assert trembling.shown((0.5, 0.0, 0.0)) == (0.5, 0.0, 0.0)
