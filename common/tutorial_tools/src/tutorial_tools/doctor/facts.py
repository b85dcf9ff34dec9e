"""What the doctor examined (ros/doctor/collect.py), and what it reports of it: data."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import partial
from typing import NamedTuple

from kobuki_driver.link.sample import Sample
from node_kit.rules.answer import Answer

MOST_NAMES = 5  # in a line; a classroom has thirty robots


def natural(name: str) -> list[tuple[int, str]]:
    """Return the sort key that puts robot_2 before robot_10."""
    return [(int(part), "") if part.isdigit() else (0, part) for part in re.split(r"(\d+)", name)]


def some(names: Iterable[str], between: str = ", ") -> str:
    """Return names in their natural order; if there are many, the first ones and a count."""
    names = sorted(names, key=natural)
    more = [f"{len(names) - MOST_NAMES} more"] if len(names) > MOST_NAMES + 1 else []
    shown = names[:MOST_NAMES] if more else names
    return between.join(shown) + (f" and {more[0]}" if more else "")


JOY = "sensor_msgs/Joy"
TWIST = "geometry_msgs/Twist"
OK, WRONG, UNKNOWN = "ok", "wrong", "unknown"
DEAD = (Answer.REFUSED, Answer.STRANGE)  # the node has exited, or another program has its port


class Finding(NamedTuple):
    """One line for the user."""

    level: str
    about: str  # one word
    seen: str
    todo: str = ""  # what to do

    def line(self) -> str:
        """Return the finding as a line of output."""
        todo = f": {self.todo}" if self.todo else ""
        return f"{self.level:7}  {self.about:11}  {self.seen}{todo}"


ok = partial(Finding, OK)  # nothing is wrong here
wrong = partial(Finding, WRONG)  # this explains why nothing moves
unknown = partial(Finding, UNKNOWN)  # the doctor cannot judge this


class Node(NamedTuple):
    """A node as the master and the node itself describe it."""

    uri: str
    host: str
    answer: Answer
    here: bool | None = True  # whether it runs on this machine; None: unknown address
    # For every outgoing connection: its topic, and the name of the receiving node.
    links: list[tuple[str, str]] = []  # noqa: RUF012 (never changed)
    sends: dict[str, str] = {}  # noqa: RUF012  by topic: the type that the node uses
    takes: dict[str, str] = {}  # noqa: RUF012


class Stray(NamedTuple):
    """A node that runs on this machine and is not registered with the master."""

    name: str
    pid: int
    master_uri: str = ""  # of its own master, if that is another one


class Offset(NamedTuple):
    """How far a host's clock is ahead of ours [s], by the stamps on a topic."""

    seconds: float
    topic: str


class MuxInput(NamedTuple):
    """An input of a multiplexer of velocities."""

    name: str
    topic: str
    priority: float


class Mux(NamedTuple):
    """A multiplexer: its active input (None: not published), and its inputs, if known."""

    active: str | None
    inputs: list[MuxInput] = []  # noqa: RUF012 (never changed)


class Joystick(NamedTuple):
    """A device file; error: the errno with which opening it fails, or None."""

    path: str
    error: int | None = None


class Transform(NamedTuple):
    """A transform that a node publishes, and how old its stamp is at arrival [s]."""

    node: str
    parent: str
    child: str
    late_s: float = 0.0


@dataclass(frozen=True)
class Facts:
    """What was examined. The defaults describe an idle machine without faults."""

    # This machine. own_variable is "ROS_IP", "ROS_HOSTNAME" or "" (neither is set).
    master_uri: str = "http://localhost:11311"
    master: Answer = Answer.WELL
    master_host: str = "localhost"
    master_here: bool = True
    own_variable: str = ""
    own_name: str = "localhost"  # the host name under which this machine's nodes register
    own_addresses: list[str] = field(default_factory=lambda: ["127.0.0.1"])
    own_is_here: bool = True  # whether that is this machine
    way_out: str = ""  # our address on the way to the master, if it is on another machine
    called_back: bool | None = True  # whether the master reached us; None: not tried
    joysticks: list[Joystick] = field(default_factory=list)
    kobukis: list[Sample] = field(default_factory=list)  # ports of real robots
    workspace: str = ""  # a student's, which takes the place of the solutions
    broken_manifests: list[tuple[str, str]] = field(default_factory=list)  # path, what is wrong
    hidden: list[tuple[str, str]] = field(default_factory=list)  # stand-ins: what is wrong, to do
    joy2twist: str = "/suite/joy2twist"  # folder of the package that would run; "": none
    container: bool = False
    wsl: bool = False
    environment: list[tuple[str, str]] = field(default_factory=list)  # what is wrong, what to do
    # The graph. publishers, subscribers: the names of nodes, by topic; types: also by topic.
    nodes: dict[str, Node] = field(default_factory=dict)
    publishers: dict[str, list[str]] = field(default_factory=dict)
    subscribers: dict[str, list[str]] = field(default_factory=dict)
    types: dict[str, str] = field(default_factory=dict)
    strays: list[Stray] = field(default_factory=list)
    # For senders that are not connected to a receiver of their type, by topic and node: the md5 of
    # the definition with which the node was built, and of this terminal's definition ("": none).
    definitions: dict[tuple[str, str], tuple[str, str]] = field(default_factory=dict)
    use_sim_time: bool = False
    clock_ticks: bool = False
    clocks: dict[str, Offset | None] = field(default_factory=dict)  # by host
    transforms: list[Transform] = field(default_factory=list)
    muxes: dict[str, Mux] = field(default_factory=dict)  # by the name of the node
    states: dict[str, tuple[bool, str]] = field(default_factory=dict)  # joy2twist: well, text
    bases: dict[str, tuple[bool, str]] = field(default_factory=dict)  # real: alive, battery
    bridge: list[tuple[bool, str]] = field(default_factory=list)  # to ROS 2: well, text
    silent_s: dict[str, float] = field(default_factory=dict)  # since a joy_node's gamepad moved

    def used(self) -> list[str]:
        """Return the topics that have a sender or a receiver."""
        columns = (self.publishers, self.subscribers)
        return sorted({name for part in columns for name in part if part[name]}, key=natural)

    def kinds(self, topic: str, inwards: bool) -> dict[str, str]:
        """Return {node: type} of the receivers of a topic, or of its senders."""
        types = {}
        for name in (self.subscribers if inwards else self.publishers).get(topic, []):
            node = self.nodes.get(name)
            own = (node.takes if inwards else node.sends) if node else {}
            # The master has one type per topic: the last sender's.
            types[name] = own.get(topic) or self.types.get(topic, "")
        return types

    def users(self, topic: str, kind: str, inwards: bool) -> list[str]:
        """Return the receivers of a topic that want a type, or its senders."""
        return sorted(name for name, own in self.kinds(topic, inwards).items() if own == kind)

    def topics(self, kind: str) -> list[str]:
        """Return the topics of a type that are in use; the master also lists past ones."""
        ends = (True, False)
        return [t for t in self.used() if any(self.users(t, kind, inwards) for inwards in ends)]

    def answers(self, name: str) -> bool:
        """Return whether the master lists a node, and the node answers."""
        return name in self.nodes and self.nodes[name].answer is Answer.WELL

    def dead(self) -> set[str]:
        """Return the nodes that have died; the master still lists them."""
        return {name for name, node in self.nodes.items() if node.answer in DEAD}

    def senders(self, topic: str) -> list[str]:
        """Return the publishers of a topic that have not died."""
        return sorted(set(self.publishers.get(topic, [])) - self.dead())

    def receivers(self, topic: str) -> list[str]:
        """Return the subscribers of a topic that have not died."""
        return sorted(set(self.subscribers.get(topic, [])) - self.dead())

    def converters(self) -> dict[str, tuple[list[str], list[str]]]:
        """Return {node that turns a joystick into velocities: (its inputs, its outputs)}."""
        nodes: dict[str, tuple[list[str], list[str]]] = {}
        for joy in self.topics(JOY):
            for node in self.users(joy, JOY, inwards=True):
                sends = [t for t in self.topics(TWIST) if node in self.users(t, TWIST, False)]
                if sends:
                    inputs, _ = nodes.setdefault(node, ([], sends))
                    inputs.append(joy)
        return nodes

    def driven(self) -> list[str]:
        """Return the topics on which velocities go from a sender to a receiver."""
        every = self.topics(TWIST)
        return [t for t in every if self.users(t, TWIST, True) and self.living(t, TWIST)]

    def living(self, topic: str, kind: str) -> list[str]:
        """Return the senders of a topic that have not died and send a type."""
        return sorted({*self.users(topic, kind, inwards=False)} - self.dead())
