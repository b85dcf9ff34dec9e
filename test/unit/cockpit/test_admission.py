"""Which page makes room, how much may come of one, and what pages may cost. Times are numbers."""

import pytest

from cockpit_server.access import DRIVER, VIEWER
from cockpit_server.admission import page_to_close
from cockpit_server.budget import Budget
from cockpit_server.clients import LONGEST_FLOOD, Client
from tutorial_testing.session_room import page

ADA, BOB, CY = "10.0.0.1", "10.0.0.2", "10.0.0.3"
LONG = 60.1  # [s]
RATE = 0.25  # s/s
HERE = (DRIVER, ADA, LONG)


@pytest.mark.parametrize(
    ("pages", "role", "address", "closed"),
    [
        # a driver replaces the idlest viewer of the fullest address
        ([HERE, (VIEWER, ADA, 1), (VIEWER, BOB, 2), (VIEWER, BOB, 1)], DRIVER, BOB, 2),
        ([HERE, (VIEWER, ADA, 1)], DRIVER, ADA, 1),
        ([HERE], DRIVER, BOB, None),
        # a viewer replaces one of an address that has more
        ([(VIEWER, ADA, 1), (VIEWER, ADA, 2), (VIEWER, BOB, 3)], VIEWER, CY, 1),
        ([(VIEWER, ADA, 1), (VIEWER, ADA, 2), (VIEWER, BOB, 3)], VIEWER, BOB, None),
        # only an idle one from the same address; else two pages would replace each other again
        ([(VIEWER, ADA, 1), (VIEWER, ADA, LONG), (VIEWER, ADA, LONG + 1)], VIEWER, ADA, 2),
        ([(VIEWER, ADA, 1), (VIEWER, ADA, 60)], VIEWER, ADA, None),
    ],
)
def test_the_viewer_that_is_closed_for_a_new_page(pages, role, address, closed):
    clients = [
        Client(n, its, "", None, None, None, None, where, spoke_at=100.0 - idle_s)
        for n, (its, where, idle_s) in enumerate(pages)
    ]
    page = page_to_close(clients, role, address, 100.0)
    assert (page and page.number) == closed


def test_a_budget_allows_a_burst_and_then_makes_pages_wait():
    budget = Budget(1.0)
    assert budget.wait_s(100.0, RATE) == 0.0
    budget.spend(1.0)
    assert budget.wait_s(100.0, RATE) == 0.0
    budget.spend(0.5)
    for now, rate, wait_s in (
        (100.0, RATE, 2.0),
        (101.0, RATE, 1.0),
        (101.0, 2 * RATE, 0.5),
        (1000.0, RATE, 0.0),
    ):
        assert budget.wait_s(now, rate) == wait_s
    budget.spend(1.5)  # no more than a burst is saved
    assert budget.wait_s(1000.0, RATE) == pytest.approx(2.0)


def test_flood_is_dropped_and_then_closes_the_connection():
    client, sent = page()
    taken = sum(client.allows(100.0) for _ in range(LONGEST_FLOOD))
    assert taken < 300 and sent == []
    for _ in range(taken + 1):
        client.allows(100.0)
    assert sent == ["closed"]
