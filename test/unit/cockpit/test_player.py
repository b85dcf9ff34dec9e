"""When which recorded message is due."""

import pytest

from cockpit_server.player import Player

MESSAGES = [(0.0, "a", 0), (0.5, "b", 0), (1.0, "c", 0)]


# After seek(position, 10.0): what is due at these times, one after the other.
@pytest.mark.parametrize(
    ("position", "rate", "loop", "due"),
    [
        (0.0, 1.0, False, {10.01: "a", 10.49: "", 10.51: "b", 11.3: "c"}),
        (0.0, 2.0, False, {10.3: "ab"}),
        (0.5, 1.0, False, {10.1: "b"}),
        (5.0, 1.0, False, {10.1: "a"}),  # beyond the end: from the beginning
        (0.0, 1.0, True, {11.19: "abc", 11.21: "", 11.22: "a"}),
    ],
)
def test_each_message_is_due_once_at_its_time(position, rate, loop, due):
    player = Player(MESSAGES, 1.2, rate, loop)
    player.seek(position, 10.0)
    for now, names in due.items():
        assert "".join(axes for axes, _ in player.due(now)) == names


def test_the_position_and_the_end_of_a_recording():
    player = Player(MESSAGES, 1.2, 1.0, loop=False)
    player.seek(0.0, 10.0)
    assert [player.position(now) for now in (10.75, 12.0)] == [0.75, 1.2]
    assert [player.is_over(now) for now in (11.1, 11.3)] == [False, True]
    player.due(10.1)
    player.seek(0.9, 10.1)
    assert player.due(10.25) == [("c", 0)]
    assert not Player(MESSAGES, 1.2, 1.0, loop=True).is_over(100.0)
