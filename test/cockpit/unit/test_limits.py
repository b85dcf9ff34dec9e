"""What pages may cost. Times are numbers."""

import pytest

from cockpit_server.limits import SHARE, Budget
from tutorial_testing.claims import claim


@claim("Messages of pages ...", because="the budget")
def test_a_budget_allows_a_burst_and_then_makes_pages_wait():
    budget = Budget(SHARE, SHARE)  # the first message is free, each further one costs a second
    for now, wait_s in ((100.0, 0.0), (100.0, 0.0), (100.0, 1.0), (101.0, 1.0), (103.5, 0.0)):
        assert budget.wait_s(now) == pytest.approx(wait_s)
    budget.spend(2 * SHARE)
    for now, wait_s in ((103.5, 2.5), (1000.0, 0.0), (1000.0, 0.0), (1000.0, 1.0)):
        assert budget.wait_s(now) == pytest.approx(wait_s)  # at most one burst is saved up
