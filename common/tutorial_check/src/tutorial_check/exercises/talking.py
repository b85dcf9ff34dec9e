"""Talkers and listeners at work; what was seen, without a verdict."""

from __future__ import annotations

from typing import Any, Iterable, Mapping

from tutorial_check.scripts import find_script
from tutorial_check.session import Session
from tutorial_check.stage import Stage

PACKAGE = "beginner_tutorials"
LISTEN_S = 1.5  # to the talker
TOPIC, KIND = "/chatter", "std_msgs/String"
OF_ALL = ("/rosout", "/rosout_agg", "/clock")  # topics of every node
ANOTHER_S = 3.0  # after another topic, or type, in which a talker makes the right one, or ends
STRINGS = [f"tutorial check {word} {number}" for word, number in zip("ABCDE", range(21, 36, 3))]


def scripts(session: Session) -> list[str]:
    return [find_script(session, PACKAGE, name) for name in ("talker.py", "listener.py")]


class Talk:
    """What was seen with two talkers and two listeners, and then of the talkers alone."""

    def __init__(self, session: Session) -> None:
        talker, listener = scripts(session)
        self.strings = STRINGS
        with session.stage() as stage:
            stage.call("listen", TOPIC, "String")
            first = stage.start(PACKAGE, talker)
            self.talkers, self.listener = [first], stage.start(PACKAGE, listener)
            self.published: dict[str, str] = {}  # {topic: type}, also of a talker that ends
            stage.wait_for_start(lambda: self._is_right(stage) or self.published or first.ended)
            stage.wait(lambda: self._is_right(stage) or first.ended, ANOTHER_S)
            if self._is_right(stage):
                stage.wait_for_start(lambda: stage.call("count", TOPIC) or first.ended)
            stage.call("advertise", TOPIC, "String")
            stage.wait_for_start(lambda: stage.call("listeners", TOPIC) > 1 or self.listener.ended)
            talks = bool(_heard(stage))
            if talks:
                stage.wait(lambda: len(_heard(stage)) > 3 or first.ended, 2.0)
            self.publishers, self.subscribers = stage.call("state")
            self.types, self.warnings = stage.call("types"), stage.call("warnings")
            count = len(_heard(stage))
            for text in STRINGS:
                stage.call("send", TOPIC, text)
            stage.wait(lambda: all(text in self.listener.output for text in STRINGS), 2.0)
            if talks:
                stage.wait(lambda: len(_heard(stage)) >= count + 6 or first.ended, LISTEN_S)
            self.heard = _heard(stage)
            self.talker_ended, self.listener_ended = first.ended, self.listener.ended
            self.master_alive = stage.master_lives
            self.first_ended = self.both = False
            self.taken: dict[str, float | None] = {}  # [s] to the end of each
            if self.heard and not self.talker_ended and not self.listener_ended:
                self._talk_both(session, stage, talker)

    def _is_right(self, stage: Stage) -> bool:
        """Note what is published; return whether it is a String on /chatter."""
        topics, types = stage.call("state")[0], stage.call("types")
        self.published.update({t: types.get(t, "") for t in topics if t not in OF_ALL})
        return self.published.get(TOPIC) == KIND

    def _talk_both(self, session: Session, stage: Stage, talker: str) -> None:
        """Start a second talker of the same kind; both must go on, or the first must end."""
        first, second = self.talkers[0], stage.start(PACKAGE, talker)
        self.talkers.append(second)

        def both() -> bool:
            return len({caller for _, caller, _ in _heard(stage)[-20:]}) > 1 and not first.ended

        names = set(self.publishers.get(TOPIC, []))
        stage.wait_for_start(
            lambda: set(stage.call("state")[0].get(TOPIC, [])) - names or first.ended
        )
        stage.wait_for_start(lambda: first.ended or both())
        self.first_ended, self.both = first.ended, both()
        so_far = len(_heard(stage))  # the one that is ended next must be well under way
        stage.wait(lambda: len(_heard(stage)) > so_far + 2 or second.ended, 3.0)
        taken = session.box.end_all([second, self.listener])
        self.talker_ended = self.both and first.ended  # by itself, after some messages
        self.taken = dict(zip(("talker.py", "listener.py"), taken))


def other_topic(topics: Iterable[str], asked_for: str, types: Mapping[str, str], kind: str) -> str:
    """Return another topic than the one asked for, with its type if that is another; or empty."""
    topic = min(set(topics) - {asked_for, *OF_ALL}, default="")
    return topic if types.get(topic, kind) == kind else f"{topic}, of type {types[topic]}"


def _heard(stage: Stage) -> list[Any]:
    return [each for each in stage.call("heard", TOPIC) if each[1] != "/tutorial_check"]


def talk_of(session: Session) -> Talk:
    """Return the Talk of a workspace; made once."""
    return session.run("talk", lambda: Talk(session))
