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
