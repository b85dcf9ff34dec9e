"""How much may come of one page, and what all of them may cost. Times are numbers."""

import pytest

from cockpit_server.limits import LONGEST_FLOOD, SHARE, Budget
from tutorial_testing.session_room import page


def test_a_budget_allows_a_burst_and_then_makes_pages_wait():
    budget = Budget(SHARE, SHARE)  # one is free, and each waits for a second
    for now, wait_s in ((100.0, 0.0), (100.0, 0.0), (100.0, 1.0), (101.0, 1.0), (103.5, 0.0)):
        assert budget.wait_s(now) == pytest.approx(wait_s)
    budget.spend(2 * SHARE)
    for now, wait_s in ((103.5, 2.5), (1000.0, 0.0), (1000.0, 0.0), (1000.0, 1.0)):
        assert budget.wait_s(now) == pytest.approx(wait_s)  # no more than a burst is saved


def test_flood_is_dropped_and_then_closes_the_connection():
    client, sent = page()
    taken = sum(client.allows(100.0) for _ in range(LONGEST_FLOOD))
    assert taken < 300 and sent == []
    for _ in range(taken + 1):
        client.allows(100.0)
    assert sent == ["closed"]
