"""What the hub sends and receives; no failure, flood or slow page delays the others."""

import json
import time
from types import SimpleNamespace

import pytest

from cockpit_server.access import DRIVER, VIEWER
from cockpit_server.hub import Hub
from cockpit_server.limits import MOST_PAGES
from cockpit_server.pages import TabSource
from tutorial_testing.claims import claim
from tutorial_testing.clock import Clock
from tutorial_testing.session_room import page


class Made(Hub):
    """A hub with these sources; its driver is the number of a page."""

    def __init__(self, *sources, tick=lambda now: None, clock=time):
        self.told, self.driver, self.closed = [], None, []
        driving = SimpleNamespace(
            tick=tick, beat=lambda now: None, gone=lambda client: None,
            is_driver=lambda client: client.number == self.driver,
        )  # fmt: skip
        super().__init__({}, driving, sources, self.told.append, clock)

    def opened(self, role=DRIVER):
        """Return (a page that has joined, what it is sent)."""
        client, sent = page(role, number=next(self.page_numbers))
        self.join(client)
        return client, sent


def broken(*_):
    raise KeyError("broken")


class Broken(TabSource):
    collect = send_to = broken


class Well(TabSource):
    def send_to(self, client, now):
        client.send("well")


def kinds(sent):
    return [message["kind"] for message in sent]


@pytest.fixture
def clock():
    return Clock(100.0)


@claim("One source that fails holds up no other")
def test_failure_does_not_hold_up_other_sources_and_pages(clock):
    hub = Made(Broken(), Well(), tick=broken, clock=clock)
    (unwritable, _), *others = [hub.opened() for _ in range(3)]
    unwritable.write = None
    for _ in range(2):
        clock.now += 0.1
        hub.tick()
    assert [kinds(sent) for _, sent in others] == [["hello", "well", "well"]] * 2
    assert len(hub.told) == 3  # one line each: for driving, the source and that page


@claim("Messages of pages that do not drive get 15 % of the thread, and wait for what they cost")
def test_page_waits_for_what_messages_cost_unless_it_drives(clock):
    hub = Made(clock=clock)
    (guest, _), (driver, _) = hub.opened(), hub.opened()
    hub.driver = driver.number
    clock.thread_time = iter(range(9)).__next__  # Each message takes a second.
    hub.receive(driver, "no message")
    assert hub.wait_s(guest) == 0.0
    hub.receive(guest, "no message")
    assert (hub.wait_s(guest) > 1.0, hub.wait_s(driver)) == (True, 0.0)


def test_page_waits_for_what_reading_its_messages_costs(clock):
    hub = Made(clock=clock)
    guest, _ = hub.opened()
    for _ in range(300):  # which take no time here
        wait_s = hub.wait_s(guest)
        hub.receive(guest, "no message")
    assert 0.9 < wait_s < 1.1


def test_a_page_that_is_behind_gets_the_newest_once_it_has_read(clock):
    hub = Made(Well(), clock=clock)
    client, sent = hub.opened()
    for is_behind in (True, False):
        client.is_behind = lambda is_behind=is_behind: is_behind
        clock.now += 0.1
        hub.tick()
        assert ("well" in kinds(sent)) != is_behind


@claim("HTTP requests wait for what they cost, 4 s at most")
def test_many_requests_wait_and_hold_up_others_for_a_while_only():
    hub = Made()
    waits = [hub.request_wait_s() for _ in range(1000)]
    assert waits[25] == 0.0  # a page loads as many files
    assert 1.0 < waits[-1] < 4.0


@claim("Only a viewer makes room, and only for a driver")
def test_only_a_viewer_makes_room_and_only_for_a_driver():
    hub = Made()
    pages = [hub.opened(VIEWER if n % 2 else DRIVER) for n in range(MOST_PAGES)]
    assert not hub.make_room(drives=False)
    for _, sent in pages[1::2]:
        assert hub.make_room(drives=True)
        assert sent[-1] == "closed"
        hub.opened()
    assert not hub.make_room(drives=True)


def test_a_malformed_message_is_refused():
    hub = Made()
    client, sent = hub.opened()
    hub.receive(client, json.dumps({"kind": "watch", "none": 1}))
    assert sent[-1]["why"] == "watch has no field 'none'"


def test_all_that_is_sent_is_json():
    with pytest.raises(ValueError, match="JSON"):
        page()[0].send("x", y=float("inf"))
