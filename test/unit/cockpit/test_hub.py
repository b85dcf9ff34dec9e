"""What the hub sends and receives; a failure, a flood or a slow page does not hold up others."""

import json
from types import SimpleNamespace

import pytest

from cockpit_server import hub as hub_module
from cockpit_server.access import DRIVER, VIEWER
from cockpit_server.clients import LOOKS_ONLY, Source
from cockpit_server.driving_status import NO_ROBOT
from cockpit_server.graph import JOY, Graph
from cockpit_server.hub import CONNECT_S, Hub
from tutorial_testing.session_room import DRIVE, REST, page

ROBOT = {"robot": "", "mode": "D"}


class Made(Hub):
    """A hub of these sources that knows the robot "", and what goes in and out of it."""

    def __init__(self, *sources, player=None):
        self.told, self.published, self.heard_by, self.rival = [], [], {"/joy2twist"}, None
        self.graphs = SimpleNamespace(
            graph=Graph(subscribers={"/joy": {"/joy2twist"}}, types={"/joy": JOY}),
            joystick_listeners=lambda _: {"/joy2twist"},
        )
        joysticks = SimpleNamespace(
            send=lambda *message: self.published.append(message),
            keep=lambda _: None,
            listeners=lambda _: self.heard_by,
        )
        pads = SimpleNamespace(driven=None, rival=lambda *_: self.rival)
        super().__init__(None, self.graphs, joysticks, pads, self.told.append)
        self.add(sources, player or SimpleNamespace(play=lambda now: None))

    def opened(self, role=DRIVER):
        """(a page that has joined, what it is sent)."""
        client, sent = page(role, number=self.number())
        self.join(client)
        return client, sent

    def say(self, client, kind, **fields):
        self.hear(client, json.dumps({"kind": kind, **fields}))

    def hold(self, client, sent, position):
        """Let the driver's page answer the next beat with this position."""
        self.tick()
        beat = [one for one in sent if one["kind"] == "beat"][-1]["n"]
        axes, buttons = position
        self.say(client, "input", n=beat, t=1e3 * hub_module.time.monotonic(), beat=beat, pad=None,
                 axes=axes, buttons=buttons, source="keys")  # fmt: skip


class Broken(Source):
    def collect(self, clients, now):
        raise KeyError("collect")

    def send_to(self, client, now):
        raise OSError("send_to")

    def play(self, now):
        raise ZeroDivisionError("play")


class Well(Source):
    def send_to(self, client, now):
        client.send("well")


def kinds(sent):
    return [message["kind"] for message in sent]


@pytest.fixture
def clock(monkeypatch):
    """The time now, and how long the thread has worked [s]."""
    clock = SimpleNamespace(now=100.0, worked=0.0, time=lambda: 0.0)
    clock.monotonic, clock.thread_time = (lambda: clock.now), (lambda: clock.worked)
    monkeypatch.setattr(hub_module, "time", clock)
    return clock


def test_failure_does_not_hold_up_other_sources_and_pages(clock):
    hub = Made(Broken(), Well(), player=Broken())
    (unwritable, _), *others = [hub.opened() for _ in range(3)]
    unwritable.write = None
    for _ in range(2):
        clock.now += 0.1
        hub.tick()
    assert [kinds(sent) for _, sent in others] == [["hello", "session", "well", "well"]] * 2
    assert len(hub.told) == 4  # each once: the player, the source, and two for that page


def test_page_waits_for_what_its_messages_cost_unless_it_drives(clock, monkeypatch):
    hub = Made(Well())
    (guest, to_guest), (other, to_other), (driver, _) = [hub.opened() for _ in range(3)]
    hub.say(driver, "drive", **ROBOT)
    with monkeypatch.context() as slow:
        slow.setattr(clock, "thread_time", iter(range(9)).__next__)  # each message takes a second
        for one in (guest, driver):
            hub.hear(one, "no message")
    assert (hub.wait_s(guest) > 1.0, hub.wait_s(driver)) == (True, 0.0)
    assert other.budget.wait_s(clock.now, 1.0) == 0.0
    hub.tick()
    assert "well" not in kinds(to_guest)  # it gets the newest once that is paid
    assert "well" in kinds(to_other)


def test_many_requests_delay_only_their_own_address():
    hub = Made()
    waits = [hub.request_wait_s("10.0.0.1") for _ in range(1000)]
    assert waits[25] == 0.0  # a page loads as many files
    assert waits[-1] > 10.0
    assert hub.request_wait_s("10.0.0.2") == 0.0


@pytest.mark.parametrize(
    ("heard_by", "after_s", "drives"),
    [((), CONNECT_S, False), (("/joy2twist",), 0.0, True), ((), CONNECT_S + 0.1, True)],
)
def test_page_drives_once_all_subscribers_are_connected_or_after_a_while(
    clock, heard_by, after_s, drives
):
    hub = Made()
    hub.heard_by = set(heard_by)
    driver, sent = hub.opened()
    hub.say(driver, "drive", **ROBOT)
    clock.now += after_s
    hub.hold(driver, sent, REST)
    assert hub.session.armed == drives


@pytest.fixture
def driven(clock):
    """A hub, and a page that drives, with what it is sent."""
    hub = Made()
    driver, sent = hub.opened()
    hub.say(driver, "drive", **ROBOT)
    for position in (REST, DRIVE):
        clock.now += 0.1
        hub.hold(driver, sent, position)
    assert hub.published.pop() == ("", *DRIVE)
    hub.published.clear()
    return hub, driver, sent


def test_stop_of_another_page_stops_the_driver_and_a_viewers_does_nothing(driven):
    hub, driver, to_driver = driven
    viewer, to_viewer = hub.opened(VIEWER)
    hub.say(viewer, "stop")
    assert LOOKS_ONLY in to_viewer[-1]["why"] and hub.session.armed
    hub.say(hub.opened()[0], "stop")
    assert (hub.published, hub.session.driver) == ([("", *REST)], driver.number)
    assert not hub.session.armed  # its hands must let go first
    assert "pressed Stop" in to_driver[-1]["text"]
    hub.say(driver, "stop")
    assert hub.session.driver is None


def test_another_joystick_frees_the_session(driven, clock):
    hub, _, to_driver = driven
    hub.rival = "/player"
    clock.now += 0.1
    hub.tick()
    assert (hub.published, hub.session.driver) == ([("", *REST)], None)
    [lost] = [one for one in to_driver if one["kind"] == "lost"]
    assert "/player also drives this robot" in lost["why"]


@pytest.mark.parametrize(
    ("role", "robot", "rival", "driver", "refusal"),
    [
        (DRIVER, "", None, None, ""),
        (DRIVER, "ada", None, None, "there is no robot 'ada'"),
        (VIEWER, "", None, None, LOOKS_ONLY),
        (DRIVER, "", "/player", None, "/player publishes the joystick topic of this robot"),
        (DRIVER, "", None, 1, "another page drives"),
        (DRIVER, "", "/player", 2, ""),  # the own session
    ],
)
def test_page_is_told_beforehand_what_drive_would_be_refused_for(
    role, robot, rival, driver, refusal
):
    hub = Made()
    _, (client, sent) = hub.opened(), hub.opened(role)
    if driver is not None:
        hub.session.take(driver, "", 0.0)
    hub.rival = rival
    said = hub.refusal(client, robot, 0.0)
    assert said.startswith(refusal) and bool(said) == bool(refusal)
    hub.say(client, "drive", **{**ROBOT, "robot": robot})
    assert [one["why"] for one in sent if one["kind"] == "refused"] == [said] * bool(refusal)
    hub.graphs.graph = Graph()
    assert hub.refusal(client, robot, 0.0) == NO_ROBOT


def test_refusals_are_few_however_much_a_page_asks_for_and_all_that_is_sent_is_json():
    client, sent = Made().opened()
    for _ in range(100):
        client.refuse("drive", "no", 9.0)
    assert 1 < len(sent) < 15
    with pytest.raises(ValueError, match="JSON"):
        client.send("x", y=float("inf"))
