"""The side of ROS 1, without a master: what it keeps and carries of latched senders."""

import socket
from types import SimpleNamespace

import pytest

from node_kit.raw_messages import Raw
from ros2_bridge import ros1_side
from ros2_bridge.link import Frame, frames
from ros2_bridge.routes import Route
from tutorial_testing.waiting import DEADLINE_S


class Room:
    """A Ros1Side and the other one; nodes that publish, and what was published."""

    def __init__(self, folder, monkeypatch, **route):
        self.there, self.publishers = set(), []
        for name in ("subscribe", "senders", "RawPublisher"):
            monkeypatch.setattr(ros1_side, name, getattr(self, f"_{name.lower()}"))
        self.path = str(folder / "socket")
        route = Route("/note", "both", **route)
        self.side = ros1_side.Ros1Side([route], self.path, print)
        self.side._subscribe(route)

    def _subscribe(self, _topic, callback, _depth):
        self.hear = callback

    def _senders(self, _subscriber):
        return self.there

    def _rawpublisher(self, topic, kind, _depth, is_latched):
        made = SimpleNamespace(said=[kind, is_latched], end=lambda: made.said.append("ended"))
        made.publish = made.said.append
        self.publishers.append(made.said)
        return made

    def send(self, sender, data, is_latched=True, is_first=True):
        self.there.add(sender)
        self.hear(Raw(data, "std_msgs/String", sender, is_latched, is_first))


@pytest.fixture
def room(tmp_path, monkeypatch):
    monkeypatch.setattr(ros1_side.rospy, "get_name", lambda: "/ros2_bridge")
    return lambda **route: Room(tmp_path, monkeypatch, **route)


def test_what_a_latched_sender_sent_is_kept_only_while_it_is_connected(room):
    made = room()
    for number in range(48):
        made.send(f"/sender_{number}", b"%d" % number)
        made.side._forget_what_is_gone()
        made.there -= {f"/sender_{number}"} - {"/sender_3"}
    made.side._forget_what_is_gone()
    assert [frame.data for frame in made.side._latched.values()] == [b"3"]


def test_what_has_an_age_limit_is_not_latched_and_not_carried_with_an_unknown_age(room):
    made = room(longest_s=0.5)
    one, other = socket.socketpair()
    other.settimeout(DEADLINE_S)
    with one, other:
        made.side._sender = ros1_side.Sender(one, lambda topic: 10)
        made.send("/joy_node", b"published who knows when")
        made.send("/joy_node", b"now", is_first=False)
        frame = next(frames(other))
    assert (frame.data, frame.is_latched, made.side._latched) == (b"now", False, {})


def test_a_publisher_is_made_anew_when_its_type_or_latching_changes(room):
    made = room()
    for kind, is_latched in (("a/msg/B", True), ("a/msg/B", False), ("a/msg/C", False)):
        for data in (b"1", b"2"):
            frame = Frame("/note", kind, data, ros1_side.time.monotonic(), is_latched)
            made.side._publish(frame)
    assert made.publishers == [
        ["a/B", True, b"1", b"2", "ended"],
        ["a/B", False, b"1", b"2", "ended"],
        ["a/C", False, b"1", b"2"],
    ]
