"""What keeps a demonstration from a master: nodes that it would push aside or count (pure)."""

from __future__ import annotations

from collections.abc import Iterable


def in_the_way(
    state: list[list[tuple[str, list[str]]]], nodes: Iterable[str], topics: Iterable[str]
) -> list[str]:
    """Names of registered nodes that a launch would meet, in alphabetical order.

    Those that bear the name of one of its nodes, which would be ended by it, and those that publish
    on one of its topics, where two would drive one robot.

    state: publishers, subscribers and services as the master's getSystemState() gives them.
    nodes: names that the launch will give. topics: those that belong to its nodes alone.
    """
    registered = {name for part in state for _, names in part for name in names}
    senders = {name for topic, names in state[0] if topic in topics for name in names}
    return sorted((registered & set(nodes)) | senders)


def refusal(uri: str, names: list[str], own_uri: str) -> str:
    """The line for the user: what runs on a master, and what to do. names: some, in_the_way()."""
    *most, last = names
    listed = f"{', '.join(most)} and {last}" if most else last
    runs, them = ("run", "them") if most else ("runs", "it")
    return (
        f"{listed} {runs} already on {uri}; end {them}, "
        f"or take a master of your own: export ROS_MASTER_URI={own_uri}"
    )
