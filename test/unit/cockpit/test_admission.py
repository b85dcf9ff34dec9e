"""Which connection or page is closed when all places are taken: nobody locks out a class."""

import pytest

from cockpit_server.access import DRIVER, VIEWER
from cockpit_server.admission import IDLE_S, Page, connection_to_close, page_to_close

ADA, BOB = "10.0.0.1", "10.0.0.2"
LONG = IDLE_S + 1


@pytest.mark.parametrize(
    ("unused", "closed"),
    [([], None), ([("a", ADA), ("b", BOB), ("c", BOB)], "b"), ([("a", ADA), ("b", ADA)], "a")],
)
def test_the_oldest_connection_of_the_fullest_address_is_closed(unused, closed):
    assert connection_to_close(unused) == closed


@pytest.mark.parametrize(
    ("pages", "role", "address", "closed"),
    [
        # a driver replaces the idlest viewer of the fullest address
        (
            [(DRIVER, ADA, LONG), (VIEWER, ADA, 1), (VIEWER, BOB, 2), (VIEWER, BOB, 1)],
            DRIVER,
            BOB,
            2,
        ),
        ([(DRIVER, ADA, LONG), (VIEWER, ADA, 1)], DRIVER, ADA, 1),
        ([(DRIVER, ADA, LONG)], DRIVER, BOB, None),
        # a viewer replaces one of an address that has more
        ([(VIEWER, ADA, 1), (VIEWER, ADA, 2), (VIEWER, BOB, 3)], VIEWER, "10.0.0.3", 1),
        ([(VIEWER, ADA, 1), (VIEWER, ADA, 2), (VIEWER, BOB, 3)], VIEWER, BOB, None),
        # of one address, one that is idle; else two pages would replace each other again and again
        ([(VIEWER, ADA, 1), (VIEWER, ADA, LONG), (VIEWER, ADA, LONG + 1)], VIEWER, ADA, 2),
        ([(VIEWER, ADA, 1), (VIEWER, ADA, IDLE_S)], VIEWER, ADA, None),
    ],
)
def test_the_viewer_that_is_closed_for_a_new_page(pages, role, address, closed):
    pages = [Page(number, *page) for number, page in enumerate(pages)]
    page = page_to_close(pages, role, address)
    assert (page and page.number) == closed
