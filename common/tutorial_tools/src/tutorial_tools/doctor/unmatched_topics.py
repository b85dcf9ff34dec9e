"""Judge the topics that have only senders or only receivers.

Most of them are no mistake: a robot reports more than is watched, and takes more commands than are
sent. The rest is at most one line for senders and one for receivers.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterator

from tutorial_tools.doctor.facts import JOY, TWIST, Facts, Finding, some, unknown, wrong

# Nodes that show, record, play or carry whatever topics there are.
TOOLS = re.compile(
    r".*/(rosout|rviz\w*|rqt\w*|\w*cockpit\w*|rosbridge\w*|rosapi\w*|foxglove_bridge|ros2_bridge"
    r"|rosbag\w*|record_\d+|play_\d+)"
)
PLAYERS = re.compile(r".*/(rosbag\w*|play_\d+)")
# Types of reports, which need no receiver.
REPORTS = re.compile(
    r"(rosgraph_msgs|diagnostic_msgs|tf2?_msgs|nav_msgs|map_msgs|sensor_msgs|stereo_msgs|turtlesim"
    r"|visualization_msgs|kobuki_msgs|arbotix_msgs|dynamic_reconfigure|bond|smart_battery_msgs)/.*"
    r"|actionlib_msgs/GoalStatusArray|.*Action(Result|Feedback)"
)
# Topics of reports: of a multiplexer, and of a driver.
REPORTING = re.compile(r".*/(active|debug/.*)")
# Topics and types of optional commands, which need no sender.
WAITS = re.compile(
    r".*/(commands/.*|input/.*|initialpose|goal|cancel|clicked_point|reset\w*|enable|disable"
    r"|press)"
)
WAITING = re.compile(r"actionlib_msgs/GoalID|.*ActionGoal|(rosgraph_msgs|tf2?_msgs|bond)/.*")
ALIKE = 0.8  # A name and its misspelling are at least so similar.


def unmatched_topics(facts: Facts) -> Iterator[Finding]:
    """Judge the topics that lack one end."""
    sent, wanted = _open(facts, inwards=False), _open(facts, inwards=True)
    theirs = {topic for _, sends in facts.converters().values() for topic in sends}
    for topic, other in pairs(facts):
        nodes = some(sent[topic]), some(wanted[other])
        seen = f"nobody listens to {topic} of {nodes[0]}, and nobody sends {other} of the same type"
        todo = f"start {nodes[0]} with {topic}:={other}, or correct the name in its program"
        yield wrong("topics", f"{seen}, which {nodes[1]} wants", todo)
        del sent[topic]
        wanted.pop(other, None)
    quiet = {*theirs, *(() if facts.driven() else facts.topics(JOY))}  # as in _waits()
    loud = {t: nodes for t, nodes in sent.items() if t not in quiet and not _reports(facts, t)}
    missed = {t: nodes for t, nodes in wanted.items() if not _waits(facts, t)}
    if loud:
        todo = "start what needs it; rostopic list -v compares the names"
        yield unknown("topics", f"nobody listens to {some(_of(loud))}", todo)
    if missed:
        todo = "start what sends it; rostopic list -v compares the names"
        yield unknown("topics", f"nobody sends what is wanted: {some(_of(missed))}", todo)


def pairs(facts: Facts) -> list[tuple[str, str]]:
    """Return [(topic without receivers, topic without senders)] that were probably meant as one."""
    sent, wanted = _open(facts, inwards=False), _open(facts, inwards=True)
    theirs = {topic for _, sends in facts.converters().values() for topic in sends}
    likely = []
    for topic in sorted(sent):
        kind = _kind(facts, topic)
        others = [other for other in sorted(wanted) if not {*wanted[other]} & {*sent[topic]}]
        same = [other for other in others if kind and _kind(facts, other) == kind]
        # A multiplexer's other inputs are for programs.
        same = [other for other in same if other.endswith("/input/teleop")] or same
        near = max(same, key=lambda other: _likeness(topic, other), default="")
        alike = near and (kind == TWIST or _likeness(topic, near) >= ALIKE)
        if alike and topic not in theirs and kind != JOY:
            likely.append((topic, near))
    return likely


def plays_a_bag(facts: Facts) -> list[str]:
    """Return the nodes that play a recording."""
    names = {name for users in facts.publishers.values() for name in users}
    return sorted(name for name in names - facts.dead() if PLAYERS.fullmatch(name))


def is_empty(facts: Facts) -> bool:
    """Return whether only tools run, and none plays a recording."""
    return all(map(is_tool, facts.nodes)) and not plays_a_bag(facts)


def is_tool(name: str) -> bool:
    """Return whether a node only observes or records."""
    return bool(TOOLS.fullmatch(name))


def _open(facts: Facts, inwards: bool) -> dict[str, list[str]]:
    """Return {topic that lacks the other end: its nodes except tools}."""
    near, far = facts.receivers, facts.senders
    if not inwards:
        near, far = far, near
    nodes = {t: [n for n in near(t) if not is_tool(n)] for t in facts.used() if not far(t)}
    return {topic: names for topic, names in nodes.items() if names}


def _kind(facts: Facts, topic: str) -> str:
    kinds = {**facts.kinds(topic, True), **facts.kinds(topic, False)}
    return next(iter(sorted(set(kinds.values()))), "")


def _reports(facts: Facts, topic: str) -> bool:
    kind = _kind(facts, topic)
    return bool(REPORTING.fullmatch(topic) or (kind != JOY and REPORTS.fullmatch(kind)))


def _waits(facts: Facts, topic: str) -> bool:
    kind = _kind(facts, topic)
    in_chain = kind in (JOY, TWIST)  # drive_chain.py reports these
    return in_chain or bool(WAITS.fullmatch(topic) or WAITING.fullmatch(kind))


def _likeness(topic: str, other: str) -> float:
    """Return 0 to 1; 1 for names that differ in their namespace alone."""
    if topic.rsplit("/", 1)[1] == other.rsplit("/", 1)[1]:
        return 1.0
    return difflib.SequenceMatcher(None, topic, other).ratio()


def _of(topics: dict[str, list[str]]) -> list[str]:
    return [f"{topic} ({some(nodes)})" for topic, nodes in topics.items()]
