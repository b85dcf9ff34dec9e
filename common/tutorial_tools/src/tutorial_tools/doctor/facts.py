"""What the doctor has seen (collect.py), and a finding (judgement.py, way.py): data (pure)."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import partial
from typing import NamedTuple

from node_kit.ros_api import Answer

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
    # Of every connection that it has: topic, and whether messages come in.
    links: list[tuple[str, bool]] = []  # noqa: RUF012 (never changed)


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
    use_sim_time: bool = False
    clock_ticks: bool = False
    clocks: dict[str, Offset | None] = field(default_factory=dict)  # by host
    transforms: list[Transform] = field(default_factory=list)
    muxes: dict[str, Mux] = field(default_factory=dict)  # by the name of the node
    states: dict[str, tuple[bool, str]] = field(default_factory=dict)  # joy2twist: well, text
    bridge: list[tuple[bool, str]] = field(default_factory=list)  # to ROS 2: well, text
    silent_s: dict[str, float] = field(default_factory=dict)  # since a joy_node's gamepad moved

    def topics(self, kind: str) -> list[str]:
        """Return the topics of a type that are in use; the master forgets no type."""
        used = {
            topic for part in (self.publishers, self.subscribers) for topic in part if part[topic]
        }
        return sorted((topic for topic in used if self.types.get(topic) == kind), key=natural)

    def senders(self, topic: str) -> list[str]:
        """Return the publishers of a topic that live; the master does not miss the dead."""
        dead = {name for name, node in self.nodes.items() if node.answer in DEAD}
        return sorted(set(self.publishers.get(topic, [])) - dead)

    def converters(self) -> dict[str, tuple[list[str], list[str]]]:
        """Return {node that turns a joystick into velocities: (its joys, its velocities)}."""
        found: dict[str, tuple[list[str], list[str]]] = {}
        for joy in self.topics(JOY):
            for node in self.subscribers.get(joy, []):
                sends = [t for t in self.topics(TWIST) if node in self.publishers.get(t, [])]
                if sends:
                    inputs, _ = found.setdefault(node, ([], sends))
                    inputs.append(joy)
        return found
