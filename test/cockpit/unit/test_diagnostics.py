"""What pages receive of /diagnostics: levels, when they changed, and bounds. Times are numbers."""

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

from cockpit_server.tabs.diagnostics import LONGEST_TEXT, MOST, MOST_VALUES, Diagnostics
from tutorial_testing.claims import claim
from tutorial_testing.session_room import Topics, look, page

pytestmark = claim(
    "Diagnostics: levels, stale after 5 s, when a level changed; bounded, and only while watched"
)
OK, WARN, ERROR, STALE = range(4)


class Room:
    """A page that shows the diagnostics, and the nodes that report."""

    def __init__(self):
        self.topics = Topics()
        self.source = Diagnostics(self.topics)
        self.page = page(diagnostics=True)
        self.look(0.0)

    def report(self, now, *statuses, topic="/diagnostics"):
        """statuses: (name, level, message, values as pairs); the last two may be missing."""
        made = [
            DiagnosticStatus(level, name, *rest[:1] or [""], "", [KeyValue(*v) for v in rest[1:]])
            for name, level, *rest in statuses
        ]
        self.topics.hear(topic, DiagnosticArray(status=made), now)

    def look(self, now):
        """Return {name: (level, message, values, changed)} if the page is sent them, or None."""
        sent = look(self.source, self.page, now=now)[0]
        return {name: tuple(rest) for name, *rest in sent[0]["statuses"]} if sent else None


def levels(statuses):
    return {name: (level, changed) for name, (level, _, _, changed) in statuses.items()}


def test_level_has_the_time_of_its_change_and_a_silent_status_is_stale():
    room = Room()
    room.report(10.0, ("a: x", OK), ("b", WARN))
    assert levels(room.look(10.5)) == {"a: x": ("OK", None), "b": ("WARN", None)}
    room.report(11.0, ("a: x", ERROR), ("b", WARN))
    assert levels(room.look(11.5)) == {"a: x": ("ERROR", 11.0), "b": ("WARN", None)}
    room.report(15.0, ("a: x", ERROR))
    assert room.look(15.5) is None, "nothing new"
    assert levels(room.look(16.5)) == {"a: x": ("ERROR", 11.0), "b": ("STALE", 16.0)}
    room.report(17.0, ("b", WARN))
    assert levels(room.look(17.5))["b"] == ("WARN", 17.0), "it has returned"
    room.report(18.0, ("b", STALE))
    room.report(18.1, ("a: x", 77))
    room.look(18.5)
    assert levels(room.look(30.0)) == {"a: x": ("STALE", 23.1), "b": ("STALE", 18.0)}


def test_values_and_the_aggregated_statuses_are_sent_once_a_second():
    room = Room()
    room.report(10.0, ("joy_node: Joystick", OK, "all\n good", ("axes", "8")))
    room.report(10.0, ("/Robot/Joystick", OK), topic="/diagnostics_agg")
    assert room.look(10.1) == {
        "joy_node: Joystick": ("OK", "all good", [["hardware_id", ""], ["axes", "8"]], None),
        "/diagnostics_agg//Robot/Joystick": ("OK", "", [["hardware_id", ""]], None),
    }
    room.report(10.2, ("joy_node: Joystick", WARN))
    assert room.look(10.9) is None
    assert levels(room.look(11.2))["joy_node: Joystick"] == ("WARN", 10.2)


def test_nothing_is_read_while_no_page_shows_it():
    room = Room()
    room.report(10.0, ("a", OK))
    room.look(10.0)
    client, _ = room.page
    client.watch.diagnostics = False
    subscribed = []
    room.topics.set_subscriptions = lambda owner, handlers, every: subscribed.append(handlers)
    assert room.look(11.0) is None
    assert subscribed == [{}]
    client.watch.diagnostics = True
    assert room.look(12.0) == {}, "what it was before is not known any more"


@pytest.mark.parametrize("count", [MOST, MOST + 1])
def test_hostile_reports_are_cut_and_real_ones_stay(count):
    room = Room()
    room.report(10.0, ("first", ERROR))
    room.report(10.5, *((f"name {i}", OK) for i in range(count - 1)))
    long = "x" * 300
    room.report(10.6, (long, -1, long, *[(long, long)] * 99))
    room.topics.hear("/diagnostics", b"\xff" * 100, 10.7)
    statuses = room.look(11.0)
    assert len(statuses) == MOST
    assert ("first" in statuses) == (count < MOST), "the oldest makes room"
    _, message, values, _ = statuses["x" * LONGEST_TEXT]
    assert len(message) == LONGEST_TEXT and len(values) == MOST_VALUES
    assert max(len(part) for pair in values for part in pair) == LONGEST_TEXT


def test_flood_is_not_read_and_later_reports_are():
    room = Room()
    big = [(f"s{i}", OK, "m" * 100, *[("k" * 100, "v" * 100)] * 16) for i in range(50)]
    for i in range(100):
        room.report(10.0 + i / 1000, *big)
    room.report(10.1, ("quiet", WARN))
    assert "quiet" not in room.look(10.2)
    room.report(12.0, ("quiet", WARN))
    assert room.look(12.5)["quiet"][0] == "WARN"
    assert levels(room.look(17.5))["s0"][0] == "STALE"
