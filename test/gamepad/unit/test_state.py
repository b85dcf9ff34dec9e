"""Bytes to events, and their effect on axes and buttons."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tutorial_testing.claims import claim
from tutorial_testing.gamepad_events import AXIS, BUTTON, INIT, driver, events


def upstream(sequence, deadzone, default_trig_val, sticky):
    """Return the messages of ROS Noetic's joy_node, if it publishes after each event."""
    axes, buttons, before, switched = {}, {}, {}, {}
    messages = []
    deadzone = min(deadzone, 0.9)
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
        positions = [axes.get(i, 0.0) for i in range(max(axes, default=-1) + 1)]
        pressed = [int(shown.get(i, 0)) for i in range(max(buttons, default=-1) + 1)]
        messages.append((positions, pressed))
    return messages


EVENTS = st.tuples(
    st.sampled_from((BUTTON, AXIS, BUTTON | INIT, AXIS | INIT, 0, 3, 0x42)),
    st.integers(0, 2),  # few enough that a button is pressed twice
    st.sampled_from((0, 1, -1, 1638, 1639, -1639, 32767, -32767, -32768))
    | st.integers(-32768, 32767),
)

DEADZONES = st.sampled_from((0.0, 0.05, 0.5, 1.0))


@claim("joy_node publishes what Noetic's does for the same events")
@given(st.lists(EVENTS, max_size=40), DEADZONES, st.booleans(), st.booleans())
def test_every_sequence_gives_what_upstream_gives(sequence, deadzone, trigger, sticky):
    given = {"deadzone": deadzone, "default_trig_val": trigger, "sticky_buttons": sticky}
    ours = driver(kernel_device=False, coalesce_interval=0.0, **given)
    messages = ours.read(events(*sequence), now=0.0)
    expected = upstream(sequence, deadzone, trigger, sticky)
    assert len(messages) == len(expected) == len(sequence) - ours.unknown_events
    for (axes, buttons), (expected_axes, expected_buttons) in zip(messages, expected):
        assert axes == pytest.approx(tuple(expected_axes), abs=1e-12)
        assert buttons == tuple(expected_buttons) and "-0.0" not in map(str, axes)
