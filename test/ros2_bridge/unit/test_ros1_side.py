"""The side of ROS 1, without a master: what it keeps and carries from latched senders."""

import socket
import threading
import time
from itertools import takewhile
from types import SimpleNamespace

import pytest
import rospy

from node_kit.ros.graph.raw_messages import RawMessage
from ros2_bridge.io.connection import Frame, frames
from ros2_bridge.ros import ros1_side
from ros2_bridge.routes import Route
from tutorial_testing.claims import claim
from tutorial_testing.waiting import DEADLINE_S, wait_for

STRING, END = "std_msgs/msg/String", b"end"
FORGET = (b"", "")


class Room:
    """A running Ros1Side, the nodes that it knows, and the other side."""

    def __init__(self, path, monkeypatch, **route):
        self.there, self.publishers, self.states = set(), [], []
        self.ends, self.has_ended = threading.Event(), threading.Event()
        state = SimpleNamespace(publish=self.states.append)
        for name, value in {
            "get_name": lambda: "/ros2_bridge", "Publisher": lambda *_, **__: state,
            "is_shutdown": lambda: self.ends.is_set() and not self.has_ended.set(),
            "spin": lambda: None, "Time": SimpleNamespace(now=rospy.Time),
        }.items():  # fmt: skip
            monkeypatch.setattr(rospy, name, value)
        for name, value in {
            "types_of_others": list, "LOOK_S": 0.001, "FORGET_S": 0.0, "RawPublisher": self._made,
            "subscribe": self._subscribe, "senders": lambda _: self.there,
        }.items():  # fmt: skip
            monkeypatch.setattr(ros1_side, name, value)
        ros1_side.Ros1Side([Route("/note", "both", **route)], path, print).run()
        self.other = socket.socket(socket.AF_UNIX)
        self.other.settimeout(DEADLINE_S)
        self._path, self._frames = path, frames(self.other)

    def connect(self):
        """Connect the other side, and wait until this side reports it."""
        self.other.connect(self._path)
        self.other.sendall(Frame("", "", b"", time.monotonic()).packed())
        wait_for(lambda: self.states and not self.states[-1].status[0].level, "a sign of life")

    def _subscribe(self, _topic, callback, _depth):
        self._hear = callback

    def _made(self, _topic, kind, _depth, is_latched):
        if kind == "no/Answer":
            raise TimeoutError
        said = [kind, is_latched]
        self.publishers.append(said)
        return SimpleNamespace(publish=lambda *it: said.append(it), end=lambda: said.append("end"))

    def send(self, sender, data, is_latched=True, is_first=True):
        self._hear(RawMessage(data, "std_msgs/String", sender, is_latched, is_first))

    def senders_are(self, *names):
        """Let only these senders be connected, and wait until that is noticed."""
        self.there, before = set(names), len(self.states)
        wait_for(lambda: len(self.states) > before + 2, "looks at who is connected")

    def carried(self):
        """Return (data, type) of all frames since the last call."""
        self.send("/last", END, is_latched=False)
        came = takewhile(lambda frame: frame.data != END, self._frames)
        return [(frame.data, frame.type) for frame in came]


@pytest.fixture
def room(tmp_path, monkeypatch):
    made = []
    yield lambda **route: made.append(Room(f"{tmp_path}/s", monkeypatch, **route)) or made[0]
    made[0].ends.set()
    made[0].has_ended.wait()
    made[0].other.close()


def test_what_a_latched_sender_sent_is_kept_while_it_is_connected_and_forgotten_later(room):
    made = room()
    made.there = {"/one", "/two", "/three"}
    for sender in ("/one", "/two", "/three"):
        made.send(sender, sender.encode())
    made.senders_are("/two", "/three")
    made.connect()
    assert made.carried() == [(b"/two", STRING), (b"/three", STRING)]
    made.senders_are("/three")
    assert made.carried() == []
    made.senders_are()
    assert made.carried() == [FORGET]


@claim("With an age limit nothing of unknown age is carried")
def test_what_has_an_age_limit_is_not_latched_and_not_carried_with_an_unknown_age(room):
    made = room(longest_s=0.5)
    made.there = {"/joy_node"}
    made.connect()
    made.send("/joy_node", b"published who knows when")
    made.send("/joy_node", b"now", is_first=False)
    assert made.carried() == [(b"now", STRING)]
    made.senders_are()
    assert made.carried() == []  # nothing to forget


def test_a_publisher_is_made_again_when_its_type_changes_and_not_when_its_latching_does(room):
    """A master that does not answer stops nothing."""
    made = room()
    made.connect()
    made.other.sendall(Frame("/note", "no/msg/Answer", b"1", time.monotonic()).packed())
    for kind, is_latched in (("a/msg/B", True), ("a/msg/B", False), ("a/msg/C", False)):
        made.other.sendall(Frame("/note", kind, b"1", time.monotonic(), is_latched).packed())
    wanted = [["a/B", True, (b"1", True), (b"1", False), "end"], ["a/C", False, (b"1", False)]]
    wait_for(lambda: made.publishers == wanted, "two publishers")
