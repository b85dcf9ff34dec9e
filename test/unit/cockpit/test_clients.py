"""A page's connection: what is sent on it, and how much may come."""

import json

import pytest

from cockpit_server.clients import LONGEST_FLOOD, encoded
from tutorial_testing.seat_room import page


def test_message_is_json_without_infinity():
    assert json.loads(encoded("x", y=1)) == {"kind": "x", "y": 1}
    with pytest.raises(ValueError):
        encoded("x", y=float("inf"))


def test_flood_is_dropped_and_then_closes_the_connection():
    client, sent = page()
    taken = sum(client.allows(100.0) for _ in range(LONGEST_FLOOD))
    assert taken < 300 and sent == []
    for _ in range(taken + 1):
        client.allows(100.0)
    assert sent == ["closed"]


def test_refusals_are_bounded():
    client, sent = page()
    for _ in range(1000):
        client.refuse("drive", "no", 100.0)
    assert 1 < len(sent) <= 11
