"""What the doctor has seen (collect.py), and a finding (judgement.py, way.py): data (pure)."""

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
    """Return names in their natural order; of many the first ones, and how many more."""
    names = sorted(names, key=natural)
    more = [f"{len(names) - MOST_NAMES} more"] if len(names) > MOST_NAMES + 1 else []
    shown = names[:MOST_NAMES] if more else names
    return between.join(shown) + (f" and {more[0]}" if more else "")


JOY = "sensor_msgs/Joy"
TWIST = "geometry_msgs/Twist"
OK, WRONG, UNKNOWN = "ok", "wrong", "unknown"
DEAD = (Answer.REFUSED, Answer.STRANGE)  # a node exited, or another program has its port


class Finding(NamedTuple):
    """One line for the user."""

    level: str
    about: str  # one word
    seen: str
    todo: str = ""  # what to do

    def line(self) -> str:
        """Return the finding as it is shown."""
        todo = f": {self.todo}" if self.todo else ""
        return f"{self.level:7}  {self.about:11}  {self.seen}{todo}"


ok = partial(Finding, OK)  # nothing is wrong here
wrong = partial(Finding, WRONG)  # this explains why nothing moves
unknown = partial(Finding, UNKNOWN)  # the doctor cannot judge this


class Node(NamedTuple):
    """A node as the master has it, and as it answers here."""

    uri: str
    host: str
    answer: Answer
    here: bool | None = True  # whether it runs on this machine; None: its name is not found
    # Of every connection on which it sends: topic, and the name of the node that receives.
    links: list[tuple[str, str]] = []  # noqa: RUF012 (never changed)
    sends: dict[str, str] = {}  # noqa: RUF012  by topic: the type, as the node itself has it
    takes: dict[str, str] = {}  # noqa: RUF012


class Stray(NamedTuple):
    """A node that runs on this machine and is not registered with the master."""

    name: str
    pid: int
    master_uri: str = ""  # the one that it uses, if that is another one


class Offset(NamedTuple):
    """How much a host's clock is ahead of ours [s], by the stamps on a topic."""

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
    """A device file: why it cannot be opened (errno), or None."""

    path: str
    error: int | None = None


class Transform(NamedTuple):
    """A frame as a node publishes it, and how old its stamp is at arrival [s]."""

    node: str
    parent: str
    child: str
    late_s: float = 0.0


@dataclass(frozen=True)
class Facts:
    """All that was seen. The defaults: a machine on which all is well and idle."""

    # This machine. own_variable is "ROS_IP", "ROS_HOSTNAME" or "" (neither is set).
    master_uri: str = "http://localhost:11311"
    master: Answer = Answer.WELL
    master_host: str = "localhost"
    master_here: bool = True
    own_variable: str = ""
    own_name: str = "localhost"  # what the nodes of this machine say where they are
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
    # The graph: by topic the names of nodes, and its type.
    nodes: dict[str, Node] = field(default_factory=dict)
    publishers: dict[str, list[str]] = field(default_factory=dict)
    subscribers: dict[str, list[str]] = field(default_factory=dict)
    types: dict[str, str] = field(default_factory=dict)
    strays: list[Stray] = field(default_factory=list)
    # Of senders that are not connected to a receiver of their type: (node, topic): md5 of the
    # definition with which the node was built, and of that which this terminal has ("": none).
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
        found = {}
        for name in (self.subscribers if inwards else self.publishers).get(topic, []):
            node = self.nodes.get(name)
            own = (node.takes if inwards else node.sends) if node else {}
            # The master has one type for each topic: that of the last sender.
            found[name] = own.get(topic) or self.types.get(topic, "")
        return found

    def users(self, topic: str, kind: str, inwards: bool) -> list[str]:
        """Return the receivers of a topic that want a type, or its senders."""
        return sorted(name for name, own in self.kinds(topic, inwards).items() if own == kind)

    def topics(self, kind: str) -> list[str]:
        """Return the topics of a type that are in use; the master forgets no type."""
        ends = (True, False)
        return [t for t in self.used() if any(self.users(t, kind, inwards) for inwards in ends)]

    def dead(self) -> set[str]:
        """Return the nodes that have died; the master still lists them."""
        return {name for name, node in self.nodes.items() if node.answer in DEAD}

    def senders(self, topic: str) -> list[str]:
        """Return the publishers of a topic that live."""
        return sorted(set(self.publishers.get(topic, [])) - self.dead())

    def receivers(self, topic: str) -> list[str]:
        """Return the subscribers of a topic that live."""
        return sorted(set(self.subscribers.get(topic, [])) - self.dead())

    def converters(self) -> dict[str, tuple[list[str], list[str]]]:
        """Return {node that turns a joystick into velocities: (its joys, its velocities)}."""
        found: dict[str, tuple[list[str], list[str]]] = {}
        for joy in self.topics(JOY):
            for node in self.users(joy, JOY, inwards=True):
                sends = [t for t in self.topics(TWIST) if node in self.users(t, TWIST, False)]
                if sends:
                    inputs, _ = found.setdefault(node, ([], sends))
                    inputs.append(joy)
        return found

    def driven(self) -> list[str]:
        """Return the topics on which velocities go from a sender to a receiver."""
        every = self.topics(TWIST)
        return [t for t in every if self.users(t, TWIST, True) and self.living(t, TWIST)]

    def living(self, topic: str, kind: str) -> list[str]:
        """Return the senders of a topic that live and send a type."""
        return sorted({*self.users(topic, kind, inwards=False)} - self.dead())
