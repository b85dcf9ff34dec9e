"""Who has to go when all places are taken: nobody locks out a class."""

from cockpit_server.access import DRIVER, VIEWER
from cockpit_server.admission import connection_to_close, page_to_close


def test_the_oldest_connection_of_the_fullest_address_goes():
    assert connection_to_close([]) is None
    assert connection_to_close([("a", "x"), ("b", "y"), ("c", "y")]) == "b"
    assert connection_to_close([("a", "x"), ("b", "x")]) == "a"  # a newcomer always comes in


def test_a_driver_comes_in_as_long_as_anybody_only_looks():
    pages = [("a", DRIVER, "x"), ("b", VIEWER, "x"), ("c", VIEWER, "y"), ("d", VIEWER, "y")]
    assert page_to_close(pages, DRIVER, "y") == "d"
    assert page_to_close(pages[:2], DRIVER, "x") == "b"
    assert page_to_close(pages[:1], DRIVER, "z") is None


def test_a_viewer_comes_in_where_another_address_has_more():
    pages = [("a", VIEWER, "x"), ("b", VIEWER, "x"), ("c", VIEWER, "y")]
    assert page_to_close(pages, VIEWER, "z") == "b"
    assert page_to_close(pages, VIEWER, "y") is None  # each would take the other's place for ever
    assert page_to_close(pages, VIEWER, "x") is None
    assert page_to_close([("a", VIEWER, "x")], VIEWER, "y") is None
