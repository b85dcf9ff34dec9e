"""A page's connection: what is sent on it, and how much may come."""

from cockpit_server.clients import LONGEST_FLOOD
from tutorial_testing.seat_room import page


def test_flood_is_dropped_and_then_closes_the_connection():
    client, sent = page()
    taken = sum(client.allows(100.0) for _ in range(LONGEST_FLOOD))
    assert taken < 300 and sent == []
    for _ in range(taken + 1):
        client.allows(100.0)
    assert sent == ["closed"]
