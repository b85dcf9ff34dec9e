"""The virtual gamepad: its model, how a held stick trembles, and the FIFO that it serves."""

import select
import struct

import pytest
from evdev import ecodes
from hypothesis import given
from hypothesis import strategies as st

from gamepad.driver.state import GamepadState
from gamepad.errors import DeviceError, PadError
from gamepad.gamepads import F710, F710_D, F710_X, mode_hint
from gamepad.io.device import Finder
from gamepad.io.pads import SIGN_OF_LIFE_S, StreamPad
from gamepad.js_event import SIGN_OF_LIFE_MS, Decoder
from gamepad.liveness import Trembling
from gamepad.virtual.controls import Controls, positions
from tutorial_testing.claims import claim

pytestmark = claim(
    "A held key or stick of ours trembles, so that it drives for as long as it is held, with "
    "Noetic's joy_node too"
)
REST = positions(F710_D, Controls())
PUSHED = positions(F710_D, Controls(left_stick=(0.0, 1.0), held=frozenset(["LB"])))
# Minimum, maximum and middle of an axis in hid-input.c or xpad.c.
BYTE, WORD, HAT = (0, 255, 127), (-32768, 32767, 0), (-1, 1, 0)


@pytest.mark.parametrize(
    ("mode", "usb_id", "axes", "ranges", "buttons", "triggers"),
    [
        ("D", "046d:c219", "X Y Z RZ HAT0X HAT0Y", [BYTE] * 4 + [HAT] * 2,
         "A B C X Y Z TL TR TL2 TR2 SELECT START", ()),
        ("X", "046d:c21f", "X Y Z RX RY RZ HAT0X HAT0Y", [WORD, WORD, BYTE] * 2 + [HAT] * 2,
         "A B X Y TL TR SELECT START MODE THUMBL THUMBR", (2, 5)),
    ],
)  # fmt: skip
def test_a_gamepad_is_what_the_kernel_shows(mode, usb_id, axes, ranges, buttons, triggers):
    pad = F710[mode]
    assert [ecodes.ecodes[f"ABS_{name}"] for name in axes.split()] == [a.code for a in pad.axes]
    assert [ecodes.ecodes[f"BTN_{name}"] for name in buttons.split()] == list(pad.button_codes)
    assert [(axis.raw(1.0), axis.high, axis.raw(0.0)) for axis in pad.axes] == ranges
    assert (pad.usb_id, pad.triggers) == (usb_id, triggers)
    assert f"in {mode} mode:" in mode_hint(usb_id)
    assert [mode_hint(other) for other in ("0000:0000", "046d:c21a", "ffff:ffff")] == [None] * 3


@given(st.sampled_from([*F710_D.axes, *F710_X.axes]), st.floats(-1, 1) | st.sampled_from([-1, 1]))
def test_an_axis_gives_the_part_of_its_way(axis, position):
    value, step = axis.js_value(axis.raw(position)), 65534 / (axis.high - axis.low)
    assert value == pytest.approx(-32767 * position, abs=0 if position in (-1, 0, 1) else step)


@pytest.mark.parametrize("pad", F710.values(), ids=F710)
def test_a_held_stick_trembles_by_one_step_and_nothing_else_does(pad):
    places = (1.0, -0.5, 1.0, 0.0, -1, 1, 1, 1)
    held = [axis.raw(place) for axis, place in zip(pad.axes, places)]
    steps = [new - old for new, old in zip(pad.trembled(held), held)]
    assert steps == ([1, -1, 1, 0, 0, 0] if pad is F710_D else [1, -1, 0, 0, -1, 0, 0, 0])


def test_one_of_many_equal_messages_trembles_by_the_last_bit():
    trembling, less = Trembling(), 1.0 - 2.0**-23
    for held in ((1.0, -0.5, 0.0), (0.5, -1.0, 0.0), (1.0, 0.0, 0.0)):
        shown = [struct.pack("<3f", *trembling.shown(held)) for _ in range(20)]
        changed = [k for k, data in enumerate(shown) if data != struct.pack("<3f", *held)]
        assert changed == [7, 15]
        assert struct.unpack("<3f", shown[7]) == tuple(less * axis for axis in held)


def events(device):
    """Read the new events as (time, value, type, number)."""
    return list(struct.iter_unpack("=IhBB", device.read()))


def test_a_fifo_has_the_state_at_opening_then_the_changes_and_signs_of_life(tmp_path):
    path, clock = tmp_path / "pad", [5.0]
    with StreamPad(F710_D, str(path), clock=lambda: clock[0]) as pad:
        pad.show(REST)
        for _ in range(2):  # a second reader gets everything, too
            assert not pad.connected
            device = Finder(str(path), "").open()
            pad.show(REST)
            first = events(device)
            opening = [(0, 0x81)] * 12 + [(0, 0x82)] * 6
            assert [(value, kind) for _, value, kind, _ in first] == opening
            pad.show(PUSHED)
            assert sorted(event[1:] for event in events(device)) == [(-32767, 2, 1), (1, 1, 4)]
            clock[0] += SIGN_OF_LIFE_S - 0.01
            pad.show(PUSHED)
            assert device.read() == b""  # nothing new, but not the end
            assert pad.watch(select.poll()) <= SIGN_OF_LIFE_S
            clock[0] += 0.02
            pad.show(PUSHED)
            signs = events(device)  # the whole state; its time marks it as a sign of life
            state = sorted(event[1:] for event in signs if event[1])
            assert state == [(-32767, 0x82, 1), (1, 0x81, 4)]
            assert [event[0] for event in signs] == [SIGN_OF_LIFE_MS] * 18
            device.close()
            pad.show(PUSHED)
        device = Finder(str(path), "").open()
        pad.show(PUSHED)
        device.read()
        pad.show(None)
        with pytest.raises(DeviceError, match="Lost"):
            device.read()
        device.close()
    assert not path.exists()


@pytest.mark.parametrize("pad", F710.values(), ids=F710)
def test_a_stick_held_through_a_fifo_trembles_for_the_joy_node_of_noetic(pad, tmp_path):
    """That joy_node ignores axes that are marked as the state at opening."""
    clock, joy, changes = [5.0], GamepadState(0.0, False, False), []
    axes, buttons = positions(pad, Controls(left_stick=(-0.4, 1.0), held=frozenset(["LB"])))
    with StreamPad(pad, str(tmp_path / "pad"), clock=lambda: clock[0]) as stream:
        device = Finder(str(tmp_path / "pad"), "").open()
        for k in range(80):  # 4 s
            clock[0] = 5.0 + k * 0.05
            stream.show((axes, buttons))
            before = joy.publish()
            for event in Decoder(late_init_is_change=False).feed(device.read()):
                joy.apply(event)
            changes += [k] if joy.publish() != before else []
        device.close()
    assert changes[0] == 0 and all(b - a <= 10 for a, b in zip(changes, [*changes[1:], 79]))
    shown, pressed = joy.publish()
    assert (shown[:2], pressed) == (pytest.approx(axes[:2], abs=0.01), buttons)


def test_a_fifo_is_served_by_one_gamepad_only(tmp_path):
    path = tmp_path / "pad"
    with StreamPad(F710_D, str(path)) as first:
        device = Finder(str(path), "").open()
        first.show(REST)
        assert first.connected
        with StreamPad(F710_D, str(path)) as second, pytest.raises(PadError, match="another"):
            second.show(REST)
        assert path.exists()
        device.close()
    assert not path.exists()
