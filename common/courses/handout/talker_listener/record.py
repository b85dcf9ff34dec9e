"""Section 3: recorders of talker and listener, beside our own."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Dict, Optional, Tuple

from tutorial_check import SETTLE_S, HeardText, Program, Ran, RosSession, Topics, Workspace

from ..task import BEGINNER, OF_ALL

LISTEN_S = 1.5  # to the talker
TOPIC, KIND = "/chatter", "std_msgs/String"
ANOTHER_S = 3.0  # after a wrong topic or type, for a talker to create the right one, or to end
STRINGS = [f"tutorial check {word} {number}" for word, number in zip("ABCDE", range(21, 36, 3))]


@dataclass(frozen=True)
class Pair:
    """Two of the student's talkers side by side, and the end of the second and the listener."""

    first_ended: bool  # because the second has taken its name
    both: bool  # both publish
    second: Ran
    taken_s: Tuple[Optional[float], ...]  # the second talker, the listener; None: it was killed


@dataclass(frozen=True)
class Talk:
    """A run of a talker and a listener, then of a second talker beside the first."""

    talker: Ran
    listener: Ran
    talker_ended: bool  # by itself
    listener_ended: bool
    published: Dict[str, str]  # {topic: type}, also of a talker that ends
    publishers: Topics
    subscribers: Topics
    types: Dict[str, str]
    warnings: Tuple[str, ...]
    received: Tuple[HeardText, ...]  # messages of the student's talkers
    master_alive: bool
    pair: Optional[Pair] = None  # if both programs continue


@dataclass(frozen=True)
class Second:
    """A run of two changed talkers."""

    first: Ran
    talks: bool
    first_ended: bool = False


def talk(workspace: Workspace, talker: str, listener: str) -> Talk:
    """Start talker and listener, and send STRINGS to the listener."""
    with workspace.ros_session() as ros:
        ros.peer.listen(TOPIC, "String")
        first, listens = ros.start(BEGINNER, talker), ros.start(BEGINNER, listener)
        published: dict[str, str] = {}

        def is_right() -> bool:
            """Note what is published; return whether it is a String on /chatter."""
            topics, types = ros.peer.state()[0], ros.peer.types()
            published.update({t: types.get(t, "") for t in topics if t not in OF_ALL})
            return published.get(TOPIC) == KIND

        ros.wait_for_start(lambda: is_right() or published or first.ended)
        ros.wait(lambda: is_right() or first.ended, ANOTHER_S)
        if is_right():
            ros.wait_for_start(lambda: ros.peer.count(TOPIC) or first.ended)
        ros.peer.advertise(TOPIC, "String")
        ros.wait_for_start(lambda: ros.peer.listeners(TOPIC) > 1 or listens.ended)
        # As in RosSession.meet(), which explains it.
        ros.wait(lambda: listens.ended or listens.rests(), SETTLE_S)
        talks = bool(_received(ros))
        if talks:
            ros.wait(lambda: len(_received(ros)) > 3 or first.ended, 2.0)
        publishers, subscribers = ros.peer.state()
        types, warnings = ros.peer.types(), ros.peer.warnings()
        count = len(_received(ros))
        for text in STRINGS:
            ros.peer.send(TOPIC, text)
        ros.wait(lambda: all(text in listens.output for text in STRINGS), 2.0)
        if talks:
            ros.wait(lambda: len(_received(ros)) >= count + 6 or first.ended, LISTEN_S)
        received = _received(ros)
        talker_ended, listener_ended, alive = first.ended, listens.ended, ros.master_lives
        pair = None
        if received and not talker_ended and not listener_ended:
            pair = _pair(workspace, ros, talker, first, listens, set(publishers.get(TOPIC, [])))
            talker_ended = pair.both and first.ended  # by itself, after some messages
    return Talk(
        first.ran, listens.ran, talker_ended, listener_ended, published, publishers, subscribers,
        types, tuple(warnings), received, alive, pair,
    )  # fmt: skip


def _pair(
    workspace: Workspace,
    ros: RosSession,
    talker: str,
    first: Program,
    listens: Program,
    names: set[str],
) -> Pair:
    """Start a second talker; either both continue, or the first ends."""
    second = ros.start(BEGINNER, talker)

    def both() -> bool:
        return len({caller for _, caller, _ in _received(ros)[-20:]}) > 1 and not first.ended

    ros.wait_for_start(lambda: set(ros.peer.state()[0].get(TOPIC, ())) - names or first.ended)
    ros.wait_for_start(lambda: first.ended or both())
    first_ended, both_talk = first.ended, both()
    so_far = len(_received(ros))  # the talker to be ended must first be well under way
    ros.wait(lambda: len(_received(ros)) > so_far + 2 or second.ended, 3.0)
    taken_s = workspace.runner.end_all([second, listens])
    return Pair(first_ended, both_talk, second.ran, tuple(taken_s))


def second(workspace: Workspace, talker: str, text: str, *names: str) -> Second:
    """Start two talkers with this text, or as they are with these names."""
    script = workspace.sibling(BEGINNER, talker, text) if text else talker
    given = [[f"__name:={name}"] for name in names] or [[], []]
    with workspace.ros_session() as ros:
        ros.peer.listen(TOPIC, "String")
        first = ros.start(BEGINNER, script, *given[0])
        talks = ros.wait_for_start(lambda: ros.peer.count(TOPIC) or first.ended)
        if first.ended or not talks:
            return Second(first.ran, talks=False)
        other = ros.start(BEGINNER, script, *given[1])

        def settled() -> bool:
            callers = {caller for _, caller, _ in ros.peer.received(TOPIC)}
            return first.ended or other.ended or len(callers) > 1

        ros.wait_for_start(settled)
        return Second(first.ran, True, first.ended)


def _received(ros: RosSession) -> tuple[HeardText, ...]:
    return tuple(text for text in ros.peer.texts(TOPIC) if text[1] != "/tutorial_check")
