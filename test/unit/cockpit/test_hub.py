"""What the hub sends, when a part of what it joins fails."""

import json
from io import BytesIO
from time import monotonic
from types import SimpleNamespace

from rosgraph_msgs.msg import Log

from cockpit_server import hub as hub_module
from cockpit_server.access import DRIVER
from cockpit_server.clients import Client, Source
from cockpit_server.graph import Graph
from cockpit_server.guard import MOST_TOLD, Guard
from cockpit_server.hub import Hub
from cockpit_server.logs import Logs
from cockpit_server.seat import PAGE


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
    told = []
    graphs = SimpleNamespace(graph=Graph(subscribers={}))
    pads = SimpleNamespace(driven=None, rival=lambda *_: None)
    joysticks = SimpleNamespace(send=None, keep=lambda robot: None)
    hub = Hub(None, graphs, joysticks, pads, told.append)
    hub.add(sources, player or SimpleNamespace(play=lambda now: None))
    return hub, told


def join(hub):
    sent = []
    no = lambda: False  # noqa: E731  short
    hub.join(Client(hub.number(), DRIVER, "x", sent.append, no, no, lambda: None))
    return sent


def test_a_source_that_fails_holds_up_no_other_and_no_page():
    hub, told = made(Broken(), Well(), player=Broken())
    pages = [join(hub), join(hub)]
    hub.tick()
    for sent in pages:
        assert sum('"kind":"well"' in text for text in sent) == 1
        assert any('"kind":"seat"' in text for text in sent)
    assert len(told) == 2  # of the player, and of the source, once


def test_a_page_that_cannot_be_written_to_holds_up_no_other():
    hub, _ = made(Well())
    first, second = join(hub), join(hub)
    hub.clients[1].write = None
    hub.tick()
    assert not any("well" in text for text in first)
    assert any("well" in text for text in second)


def test_a_page_in_debt_waits_and_the_one_that_drives_does_not():
    hub, _ = made(Well())
    guest, other, driver = join(hub), join(hub), join(hub)
    hub.seat.take(3, "ada", PAGE, monotonic())
    for one in hub.clients.values():
        one.budget.spend(10.0)
    assert hub.wait_s(hub.clients[1]) > 1.0
    assert hub.wait_s(hub.clients[3]) == 0.0
    hub.clients[2].budget.spend(-20.0)
    hub.tick()
    assert not any("well" in text for text in guest)  # it gets the newest once that is paid
    assert any("well" in text for text in other)
    assert driver


def test_what_a_page_asks_for_is_on_its_account(monkeypatch):
    time = SimpleNamespace(monotonic=lambda: 100.0, thread_time=iter(range(9)).__next__)
    monkeypatch.setattr(hub_module, "time", time)  # each message takes a second
    hub, _ = made()
    join(hub)
    join(hub)
    assert hub.wait_s(hub.clients[1]) == 0.0
    hub.hear(hub.clients[1], "no message")
    assert hub.wait_s(hub.clients[1]) > 1.0
    assert hub.clients[2].budget.wait_s(100.0, 1.0) == 0.0


def test_requests_of_one_address_wait_and_of_another_do_not():
    hub, _ = made()
    waits = [hub.request_wait_s("10.0.0.1") for _ in range(1000)]
    assert waits[25] == 0.0  # a page loads as many files
    assert waits[-1] > 10.0
    assert hub.request_wait_s("10.0.0.2") == 0.0


def test_pages_whose_turn_does_not_come_in_a_tick_get_theirs_in_the_next(monkeypatch):
    class Slow(Source):
        def give(self, client, now):
            clock[0] += 1.1 * hub_module.GIVE_S
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


def test_a_page_drives_once_all_that_are_registered_hear_it():
    hub, _ = made()
    heard = set()
    hub._graphs.joystick_listeners = lambda robot: {"/joy2twist"}
    hub._joysticks.listeners = lambda robot: heard
    assert not hub._is_heard(0.0)
    heard.add("/joy2twist")
    assert hub._is_heard(0.0)
    heard.clear()
    assert hub._is_heard(hub_module.CONNECT_S + 0.1)  # it does not answer, and holds up nobody


def test_a_robot_that_another_joystick_drives_is_not_taken():
    hub, _ = made()
    sent = join(hub)
    hub._graphs.graph = Graph(subscribers={"/joy": {"/j"}}, types={"/joy": "sensor_msgs/Joy"})
    hub._pads.rival = lambda robot, since: "/joy_node"
    hub.hear(hub.clients[1], '{"kind":"drive","robot":"","mode":"D"}')
    assert "/joy_node publishes the joystick topic of this robot" in sent[-1]
    assert hub.driven is None


def test_a_failure_is_told_once_of_each_thing():
    told, done = [], []
    guard = Guard(told.append)
    for _ in range(3):
        guard("a", int, "x")
        guard("b", [].pop)
        guard("c", done.append, 1)
    assert [line.partition(": ")[2].split(":")[0] for line in told] == ["a", "b"]
    assert "ValueError" in told[0] and "IndexError" in told[1] and done == [1, 1, 1]
    for number in range(2 * MOST_TOLD):
        guard(f"topic {number}", [].pop)
    assert len(told) == MOST_TOLD


def test_who_watches_the_log_gets_each_line_once():
    wanted = []
    logs = Logs(SimpleNamespace(want=lambda _, hears, every: wanted.extend(hears)))
    hub, _ = made(logs)
    assert wanted == ["/rosout"]  # whose publishers keep the line that was logged before
    sent = join(hub)
    one = hub.clients[1]

    def lines(text, **watch):
        data = BytesIO()
        Log(msg=text).serialize(data)
        for _ in range(2):  # a latched line comes again with a new connection
            logs._hear(SimpleNamespace(data=data.getvalue()), "/rosout")
        hub.hear(one, json.dumps({"kind": "watch", **watch}))
        sent.clear()
        for _ in range(2):
            logs.give(one, 0.0)
        entries = [json.loads(text)["entries"] for text in sent]
        return [entry["text"] for some in entries for entry in some]

    assert lines("a", log=True) == ["a"]
    assert lines("b", log=True) == ["b"]  # as a page does that was silent for a while
    assert lines("c", log=False) == []
    assert lines("d", log=True) == ["a", "b", "c", "d"]
