"""Section 3: two talkers and two listeners at work, ours among them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Dict, Optional, Tuple

from tutorial_check.processes.program import Program, Ran
from tutorial_check.recording.data import HeardText, Topics
from tutorial_check.recording.ground import Ground
from tutorial_check.recording.ros_session import SETTLE_S, Stage

PACKAGE = "beginner_tutorials"
LISTEN_S = 1.5  # to the talker
TOPIC, KIND = "/chatter", "std_msgs/String"
OF_ALL = ("/rosout", "/rosout_agg", "/clock")  # topics of every node
ANOTHER_S = 3.0  # after another topic, or type, in which a talker makes the right one, or ends
STRINGS = [f"tutorial check {word} {number}" for word, number in zip("ABCDE", range(21, 36, 3))]


@dataclass(frozen=True)
class Pair:
    """Two talkers of the student's side by side, and how one of them and the listener ended."""

    first_ended: bool  # the second one has taken its name
    both: bool  # both publish
    second: Ran
    taken_s: Tuple[Optional[float], ...]  # the second talker, the listener; None: it was killed


@dataclass(frozen=True)
class Talk:
    """A talker and a listener, then a second talker beside the first."""

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
    pair: Optional[Pair] = None  # where both programs go on


@dataclass(frozen=True)
class Second:
    """Two talkers with something changed."""

    first: Ran
    talks: bool
    first_ended: bool = False


def talk(ground: Ground, talker: str, listener: str) -> Talk:
    """Start the programs of these paths, and send STRINGS to the listener."""
    with ground.stage() as stage:
        stage.driver.listen(TOPIC, "String")
        first, listens = stage.start(PACKAGE, talker), stage.start(PACKAGE, listener)
        published: dict[str, str] = {}

        def is_right() -> bool:
            """Note what is published; return whether it is a String on /chatter."""
            topics, types = stage.driver.state()[0], stage.driver.types()
            published.update({t: types.get(t, "") for t in topics if t not in OF_ALL})
            return published.get(TOPIC) == KIND

        stage.wait_for_start(lambda: is_right() or published or first.ended)
        stage.wait(lambda: is_right() or first.ended, ANOTHER_S)
        if is_right():
            stage.wait_for_start(lambda: stage.driver.count(TOPIC) or first.ended)
        stage.driver.advertise(TOPIC, "String")
        stage.wait_for_start(lambda: stage.driver.listeners(TOPIC) > 1 or listens.ended)
        # As Stage.meet(), which says why.
        stage.wait(lambda: listens.ended or listens.rests(), SETTLE_S)
        talks = bool(_received(stage))
        if talks:
            stage.wait(lambda: len(_received(stage)) > 3 or first.ended, 2.0)
        publishers, subscribers = stage.driver.state()
        types, warnings = stage.driver.types(), stage.driver.warnings()
        count = len(_received(stage))
        for text in STRINGS:
            stage.driver.send(TOPIC, text)
        stage.wait(lambda: all(text in listens.output for text in STRINGS), 2.0)
        if talks:
            stage.wait(lambda: len(_received(stage)) >= count + 6 or first.ended, LISTEN_S)
        received = _received(stage)
        talker_ended, listener_ended, alive = first.ended, listens.ended, stage.master_lives
        pair = None
        if received and not talker_ended and not listener_ended:
            pair = _pair(ground, stage, talker, first, listens, set(publishers.get(TOPIC, [])))
            talker_ended = pair.both and first.ended  # by itself, after some messages
    return Talk(
        first.ran, listens.ran, talker_ended, listener_ended, published, publishers, subscribers,
        types, tuple(warnings), received, alive, pair,
    )  # fmt: skip


def _pair(
    ground: Ground, stage: Stage, talker: str, first: Program, listens: Program, names: set[str]
) -> Pair:
    """Start a second talker of the same kind; both must go on, or the first must end."""
    second = stage.start(PACKAGE, talker)

    def both() -> bool:
        return len({caller for _, caller, _ in _received(stage)[-20:]}) > 1 and not first.ended

    stage.wait_for_start(lambda: set(stage.driver.state()[0].get(TOPIC, ())) - names or first.ended)
    stage.wait_for_start(lambda: first.ended or both())
    first_ended, both_talk = first.ended, both()
    so_far = len(_received(stage))  # the one that is ended next must be well under way
    stage.wait(lambda: len(_received(stage)) > so_far + 2 or second.ended, 3.0)
    taken_s = ground.runner.end_all([second, listens])
    return Pair(first_ended, both_talk, second.ran, tuple(taken_s))


def second(ground: Ground, talker: str, text: str) -> Second:
    """Start two talkers with this text in place of their own."""
    script = ground.sibling(PACKAGE, talker, text)
    with ground.stage() as stage:
        stage.driver.listen(TOPIC, "String")
        first = stage.start(PACKAGE, script)
        talks = stage.wait_for_start(lambda: stage.driver.count(TOPIC) or first.ended)
        if first.ended or not talks:
            return Second(first.ran, talks=False)
        other = stage.start(PACKAGE, script)

        def settled() -> bool:
            callers = {caller for _, caller, _ in stage.driver.received(TOPIC)}
            return first.ended or other.ended or len(callers) > 1

        stage.wait_for_start(settled)
        return Second(first.ran, True, first.ended)


def _received(stage: Stage) -> tuple[HeardText, ...]:
    return tuple(each for each in stage.driver.texts(TOPIC) if each[1] != "/tutorial_check")
