"""Random messages and events: of every kind, and never a dead-man where none may be held."""

import math
import struct
from random import Random

from gamepad.js_event import Decoder
from tutorial_faults.live.random_bytes import LB, RB, broken_joy, events, joy


def read(framed):
    """(axes, buttons) of a Joy on the wire."""
    (length,) = struct.unpack_from("<I", framed)
    assert length == len(framed) - 4
    at = 4 + 12
    at += 4 + struct.unpack_from("<I", framed, at)[0]
    axes = struct.unpack_from("<I", framed, at)[0]
    values = struct.unpack_from(f"<{axes}f", framed, at + 4)
    at += 4 + 4 * axes
    buttons = struct.unpack_from("<I", framed, at)[0]
    assert at + 4 + 4 * buttons == len(framed)
    return values, struct.unpack_from(f"<{buttons}i", framed, at + 4)


def test_a_joy_is_whole_and_of_many_shapes():
    random = Random(1)
    made = [read(joy(random, may_hold=True)) for _ in range(500)]
    assert {len(axes) for axes, _ in made} > {0, 1, 2, 6, 8}
    assert any(len(buttons) > RB and buttons[LB] for _, buttons in made)
    assert any(math.isnan(value) for axes, _ in made for value in axes)


def test_no_dead_man_where_none_may_be_held():
    random = Random(2)
    for _ in range(500):
        _, buttons = read(joy(random, may_hold=False))
        assert not any(buttons[LB : RB + 1])


def test_broken_ones_are_cut_oversized_or_lie_about_a_length():
    random = Random(3)
    made = [broken_joy(random) for _ in range(200)]
    assert max(map(len, made)) > 100_000
    assert any(struct.unpack_from("<I", one)[0] != len(one) - 4 for one in made)
    assert any(len(one) < 30 for one in made)


def test_events_are_events_or_noise():
    random, decoder = Random(4), Decoder()
    made = [events(random, 8) for _ in range(100)]
    assert any(len(one) % 8 for one in made)
    assert {event.type for one in made for event in decoder.feed(one)} > {1, 2, 0x81, 0x82}
