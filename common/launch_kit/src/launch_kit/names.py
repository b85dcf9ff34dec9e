"""Names of nodes that a launch needs free: roslaunch would end the nodes that have them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import List, Sequence, Tuple
from urllib.parse import urlsplit

# As the master's getSystemState() gives it: publishers, subscribers, services.
State = Sequence[List[Tuple[str, List[str]]]]


def in_the_way(state: State, nodes: Iterable[str], topics: Iterable[str] = ()) -> list[str]:
    """Return the registered nodes with a name of a launch, or that publish on its topics.

    The launch would end the former; with the latter two would drive one robot.
    """
    registered = {name for part in state for _, names in part for name in names}
    senders = {name for topic, names in state[0] if topic in topics for name in names}
    named = [name for name in dict.fromkeys(nodes) if name in registered]
    return [*named, *sorted(senders.difference(named))]


def refusal(master_uri: str, held: Mapping[str, str]) -> str:
    """Return the line for the user: what runs, and what to do. held: names, and where they run."""
    *most, last = held
    own = own_master(master_uri)
    if most:
        names = f"{', '.join(most)} and {last}"
        return f"{names} run already on {master_uri}: end them first, or {own}"
    end = f"end it first (Ctrl-C in its terminal, or rosnode kill {last})"
    return f"{last} runs already on {master_uri}, {held[last]}: {end}, or {own}"


def own_master(master_uri: str) -> str:
    """Return what to do beside a master that another launch uses."""
    return f"have a master of your own (export ROS_MASTER_URI={next_uri(master_uri)})"


def next_uri(master_uri: str) -> str:
    """Return a ROS_MASTER_URI of this machine beside a port that is taken."""
    return f"http://localhost:{(urlsplit(master_uri).port or 0) % 65535 + 1}"
