"""Which messages of a recording are due."""

import pytest

from cockpit_server.driving.player import Player
from tutorial_testing.claims import claim

MESSAGES = [(0.0, "a", 0), (0.5, "b", 0), (1.0, "c", 0)]


# After load() at 10.0: the messages that are due at each of these times.
@claim("A recording takes ...", because="the times of its messages")
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
    player = Player(1.2, rate, loop, position)
    assert (player.due(9.0), player.position(9.0) < 1.2, player.is_over(99.0)) == ((), True, False)
    player.load(MESSAGES, [], 10.0)
    for now, names in due.items():
        assert "".join(name for name, _ in player.due(now)) == names
