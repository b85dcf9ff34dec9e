"""Which topics are carried, and how: the YAML list."""

from __future__ import annotations

import collections
import hashlib
import re
from dataclasses import dataclass, fields
from typing import Any, Mapping

import yaml

TO_ROS1, TO_ROS2, BOTH = "to_ros1", "to_ros2", "both"
RELIABLE, BEST_EFFORT = "reliable", "best_effort"
NAME = re.compile(r"(/[A-Za-z][A-Za-z0-9_]*)+")  # topic names that ROS 1 and ROS 2 allow
MOST_DEPTH = 10_000
ECHO_S = 10.0  # a node receives its own message within this time, even on a busy machine


@dataclass(frozen=True)
class Route:
    """How a topic is carried; see config/bridge.yaml."""

    topic: str
    direction: str
    depth: int = 100  # messages
    longest_s: float = 0.0
    reliability: str = RELIABLE

    @property
    def to_ros1(self) -> bool:
        """Whether messages go from ROS 2 to ROS 1."""
        return self.direction in (TO_ROS1, BOTH)

    @property
    def to_ros2(self) -> bool:
        """Whether messages go from ROS 1 to ROS 2."""
        return self.direction in (TO_ROS2, BOTH)

    @property
    def may_latch(self) -> bool:
        """Whether later subscribers get the last message: not if its age is limited."""
        return not self.longest_s


def read_routes(text: str) -> list[Route]:
    """Return the Routes of a YAML text. Raises ValueError with one line."""
    try:
        given = yaml.safe_load(text)
    except yaml.YAMLError as error:
        raise ValueError(f"no YAML: {' '.join(str(error).split())}") from None
    if not isinstance(given, dict) or not isinstance(given.get("topics"), dict):
        raise ValueError("a map with topics: {/joy: {direction: to_ros2}} is wanted")
    defaults = given.get("defaults") or {}
    return [_route(topic, defaults, about) for topic, about in given["topics"].items()]


def depth_of(routes: Mapping[str, Route], topic: str) -> int:
    """Return how many frames of a topic may wait: one of a sign of life, which has no topic."""
    return routes[topic].depth if topic in routes else 1


class Echoes:
    """Recognises a node's own messages on topics that it also receives. Times in seconds."""

    def __init__(self) -> None:
        """Expect nothing yet."""
        self._marks: dict[str, collections.deque[tuple[float, bytes]]] = {}  # by topic

    def _recent(self, topic: str, now_s: float) -> collections.deque[tuple[float, bytes]]:
        marks = self._marks.setdefault(topic, collections.deque())
        while marks and now_s - marks[0][0] > ECHO_S:
            marks.popleft()
        return marks

    def expect(self, topic: str, data: bytes, now_s: float) -> int:
        """Note a message before it is published; return how many of the topic are expected."""
        marks = self._recent(topic, now_s)
        marks.append((now_s, hashlib.md5(data).digest()))
        return len(marks)

    def take(self, topic: str, data: bytes, now_s: float) -> bool:
        """Return whether a received message was expected, and expect it no longer."""
        marks, digest = self._recent(topic, now_s), hashlib.md5(data).digest()
        mark = next((mark for mark in marks if mark[1] == digest), None)
        if mark:
            marks.remove(mark)
        return mark is not None


def _route(topic: Any, defaults: Any, about: Any) -> Route:
    if not isinstance(topic, str) or not NAME.fullmatch(topic):
        raise ValueError(f"{topic!r}: a topic is written as /name or /outer/name")
    if not isinstance(about, dict) or not isinstance(defaults, dict):
        raise ValueError(f"{topic}: a map such as {{direction: {TO_ROS2}}} is wanted")
    values = {**defaults, **about}
    known = [field.name for field in fields(Route)][1:]
    for name in values:
        if name not in known:
            raise ValueError(f"{topic}: {name} is not known; known are {', '.join(known)}")
    if "direction" not in values:
        raise ValueError(f"{topic}: direction is missing: {TO_ROS1}, {TO_ROS2} or {BOTH}")
    allowed = {"direction": (TO_ROS1, TO_ROS2, BOTH), "reliability": (RELIABLE, BEST_EFFORT)}
    for name, words in allowed.items():
        if values.get(name, words[0]) not in words:
            raise ValueError(f"{topic}: {name}: {values[name]!r} is none of {', '.join(words)}")
    depth, longest_s = values.get("depth", 1), values.get("longest_s", 0)
    if type(depth) is not int or not 1 <= depth <= MOST_DEPTH:
        raise ValueError(f"{topic}: depth: {depth!r}; allowed is 1 to {MOST_DEPTH}")
    if type(longest_s) not in (int, float) or not 0 <= longest_s < float("inf"):
        raise ValueError(f"{topic}: longest_s: {longest_s!r}; allowed are seconds, 0 or more")
    return Route(topic, **values)
