"""What the hub sends and hears; a failure, a flood or a slow page does not hold up others."""

import json
from time import monotonic
from types import SimpleNamespace

import pytest
from rosgraph_msgs.msg import Log

from cockpit_server import hub as hub_module
from cockpit_server.access import DRIVER, VIEWER
from cockpit_server.clients import LOOKS_ONLY, Source
from cockpit_server.drives import NO_ROBOT
from cockpit_server.graph import Graph
from cockpit_server.guard import MOST_REPORTED, Guard
from cockpit_server.hub import CONNECT_S, GIVE_S, Hub
from cockpit_server.seat import PAGE
from cockpit_server.sources.logs import Logs
from tutorial_testing.seat_room import DRIVE, REST, page, serialised


class Broken(Source):
    def prepare(self, clients, now):
        raise KeyError("prepare")

    def give(self, client, now):
        raise OSError("give")

    def play(self, now):
        raise ZeroDivisionError("play")


class Well(Source):
    def give(self, client, now):
        client.send("well")


def made(*sources, player=None):
    """A hub of these sources that knows the robot "", and what it reported."""
    told = []
    graph = Graph(subscribers={"/joy": {"/j"}}, types={"/joy": "sensor_msgs/Joy"})
    pads = SimpleNamespace(driven=None, rival=lambda *_: None)
    joysticks = SimpleNamespace(send=None, keep=lambda robot: None)
    hub = Hub(None, SimpleNamespace(graph=graph), joysticks, pads, told.append)
    hub.add(sources, player or SimpleNamespace(play=lambda now: None))
    return hub, told


def join(hub):
    client, sent = page(number=hub.number())
    hub.join(client)
    return client, sent


def kinds(sent):
    return [message["kind"] for message in sent]


def test_a_failure_does_not_hold_up_other_sources_and_pages():
    hub, told = made(Broken(), Well(), player=Broken())
    (unwritable, _), *others = [join(hub) for _ in range(3)]
    unwritable.write = None
    hub.tick()
    assert [kinds(sent) for _, sent in others] == [["hello", "seat", "well"]] * 2
    assert len(told) == 4  # of each once: the player, the source, and of that page two


def test_a_failure_is_reported_once_for_each_thing():
    told, done = [], []
    guard = Guard(told.append)
    for _ in range(3):
        guard("a", int, "x")
        guard("b", [].pop)
        guard("c", done.append, 1)
    reasons = [line.split(": ")[1:3] for line in told]
    assert (reasons, done) == ([["a", "ValueError"], ["b", "IndexError"]], [1, 1, 1])
    for number in range(2 * MOST_REPORTED):
        guard(f"topic {number}", [].pop)
    assert len(told) == MOST_REPORTED


def test_a_page_in_debt_waits_unless_it_drives():
    hub, _ = made(Well())
    (guest, to_guest), (_, to_other), (driver, _) = [join(hub) for _ in range(3)]
    hub.seat.take(driver.number, "ada", PAGE, monotonic())
    for one in (guest, driver):
        one.budget.spend(10.0)
    assert hub.wait_s(guest) > 1.0
    assert hub.wait_s(driver) == 0.0
    hub.tick()
    assert kinds(to_guest) == ["hello"]  # it gets the newest once that is paid
    assert "well" in kinds(to_other)


def test_a_message_costs_the_page_that_sent_it(monkeypatch):
    time = SimpleNamespace(monotonic=lambda: 100.0, thread_time=iter(range(9)).__next__)
    monkeypatch.setattr(hub_module, "time", time)  # each message takes a second
    hub, _ = made()
    (one, _), (other, _) = join(hub), join(hub)
    assert hub.wait_s(one) == 0.0
    hub.hear(one, "no message")
    assert hub.wait_s(one) > 1.0
    assert other.budget.wait_s(100.0, 1.0) == 0.0


def test_many_requests_delay_only_their_own_address():
    hub, _ = made()
    waits = [hub.request_wait_s("10.0.0.1") for _ in range(1000)]
    assert waits[25] == 0.0  # a page loads as many files
    assert waits[-1] > 10.0
    assert hub.request_wait_s("10.0.0.2") == 0.0


def test_pages_that_one_tick_does_not_reach_come_next(monkeypatch):
    class Slow(Source):
        def give(self, client, now):
            clock[0] += 1.1 * GIVE_S
            given.append(client.number)

    clock, given = [0.0], []
    time = SimpleNamespace(monotonic=lambda: clock[0], thread_time=lambda: clock[0])
    monkeypatch.setattr(hub_module, "time", time)
    hub, _ = made(Slow())
    for _ in range(3):
        join(hub)
    for tick in (1, 2, 3):
        hub.tick()
        assert given == [1, 2, 3][:tick]


@pytest.mark.parametrize(
    ("hears", "after_s", "is_heard"),
    [((), CONNECT_S, False), (("/joy2twist",), 0.0, True), ((), CONNECT_S + 0.1, True)],
)
def test_a_page_drives_once_all_subscribers_are_connected_or_after_a_while(
    hears, after_s, is_heard
):
    hub, _ = made()
    hub._graphs.joystick_listeners = lambda robot: {"/joy2twist"}
    hub._joysticks.listeners = lambda robot: set(hears)
    assert hub._is_heard(after_s) == is_heard


def test_a_page_that_watches_the_log_gets_each_line_once():
    wanted = []
    logs = Logs(SimpleNamespace(want=lambda _, hears, every: wanted.extend(hears)))
    hub, _ = made(logs)
    assert wanted == ["/rosout"]  # whose publishers keep the line that was logged before
    client, sent = join(hub)

    def lines(text, **watch):
        for _ in range(2):  # a latched line comes again with a new connection
            logs._hear(SimpleNamespace(data=serialised(Log(msg=text))), "/rosout")
        hub.hear(client, json.dumps({"kind": "watch", **watch}))
        sent.clear()
        for _ in range(2):
            logs.give(client, 0.0)
        return [entry["text"] for message in sent for entry in message["entries"]]

    assert lines("a", log=True) == ["a"]
    assert lines("b", log=True) == ["b"]  # as a page does that was silent for a while
    assert lines("c", log=False) == []
    assert lines("d", log=True) == ["c", "d"]  # the page has the others


def test_stop_leaves_the_own_seat_and_stops_another_driver():
    hub, _ = made()
    sent = []
    hub.seat._send = lambda *message: sent.append(message)
    (driver, to_driver), (guest, _), (viewer, to_viewer) = [join(hub) for _ in range(3)]
    viewer.role = VIEWER
    hub._is_heard = lambda _: True

    def drive():
        hub.on_drive(driver, monotonic(), "", "D")
        hub.seat.armed, hub.seat._last = True, DRIVE
        sent.clear()

    def stop(client):
        hub.hear(client, json.dumps({"kind": "stop"}))
        return sent, hub.seat.driver, hub.seat.armed

    drive()
    assert stop(viewer) == ([], driver.number, True)
    assert LOOKS_ONLY in to_viewer[-1]["why"]
    assert stop(guest) == ([("", *REST)], driver.number, False)  # its hands must let go first
    assert "pressed Stop" in to_driver[-1]["text"]
    drive()
    assert stop(driver) == ([("", *REST)], None, False)


@pytest.mark.parametrize(
    ("role", "robot", "rival", "driver", "refusal"),
    [
        (DRIVER, "", None, None, ""),
        (DRIVER, "ada", None, None, "there is no robot 'ada'"),
        (VIEWER, "", None, None, LOOKS_ONLY),
        (DRIVER, "", "/player", None, "/player publishes the joystick topic of this robot"),
        (DRIVER, "", None, 1, "another page drives"),
        (DRIVER, "", "/player", 2, ""),  # the own seat
    ],
)
def test_a_page_is_told_beforehand_what_drive_would_be_refused_for(
    role, robot, rival, driver, refusal
):
    hub, _ = made()
    _, (client, sent) = join(hub), join(hub)
    client.role = role
    if driver is not None:
        hub.seat.take(driver, "", PAGE, 0.0)
    hub._pads.rival = lambda *_: rival
    said = hub.refusal(client, robot, 0.0)
    assert said.startswith(refusal) and bool(said) == bool(refusal)
    hub.hear(client, json.dumps({"kind": "drive", "robot": robot, "mode": "D"}))
    assert [one["why"] for one in sent if one["kind"] == "refused"] == [said] * bool(refusal)


def test_without_a_robot_the_refusal_says_how_to_start_one():
    hub, _ = made()
    hub._graphs.graph = Graph()
    assert hub.refusal(join(hub)[0], "", 0.0) == NO_ROBOT
