"""Which classroom and which robot a student can join."""

from __future__ import annotations

import re
from typing import Any

from tutorial_tools.doctor.facts import some
from tutorial_tools.errors import JoinError

DEFAULT_PORT = 11311
START = "has the teacher started classroom.launch?"


def host_and_port(text: str) -> tuple[str, int]:
    """Return the parts of HOST or HOST:PORT. Raises JoinError."""
    match = re.fullmatch(r"([\w.-]+)(?::(\d{1,5}))?", text, re.ASCII)
    if not match:
        raise JoinError(f"{text}: must be a machine's name or address, such as 192.168.1.5[:11311]")
    return match[1], int(match[2] or DEFAULT_PORT)


def _topics(part: Any) -> dict[str, list[str]]:
    """Return {topic: its nodes} from a master's answer. Raises ValueError, TypeError."""
    for topic, nodes in part:
        if not all(isinstance(name, str) and name.isprintable() for name in (topic, *nodes)):
            raise ValueError
    return dict(part)


def check_robot(uri: str, state: Any, name: str) -> None:
    """Raise JoinError unless a robot of that name waits for a driver.

    state: what the master at uri answers to getSystemState; None: nothing.
    """
    try:
        publishers, subscribers, _ = map(_topics, state) if state is not None else ({}, {}, {})
    except (TypeError, ValueError):
        raise JoinError(f"the master {uri} does not answer as one of ROS") from None
    robots = [topic.split("/")[1] for topic in subscribers if re.fullmatch(r"/\w+/cmd_vel", topic)]
    if name not in robots:
        there = f"there are {some(robots)}" if robots else f"no classroom runs there: {START}"
        raise JoinError(f"{name} is not there; {there}")
    drivers = publishers.get(f"/{name}/cmd_vel")
    if drivers:
        raise JoinError(f"{name} is driven already, by {some(drivers)}; take another robot")
