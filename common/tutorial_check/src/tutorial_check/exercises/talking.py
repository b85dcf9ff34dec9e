"""Talkers and listeners at work; what was seen, without a verdict."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from tutorial_check.exercises.files import find_script

if TYPE_CHECKING:
    from tutorial_check.session import Session
    from tutorial_check.stage import Stage


PACKAGE = "beginner_tutorials"
LISTEN_S = 1.5  # to the talker
TOPIC = "/chatter"


def scripts(session: Session) -> Any:
    """Return the paths of the talker and of the listener."""
    return [find_script(session, PACKAGE, name) for name in ("talker.py", "listener.py")]


class Talk:
    """What was seen with two talkers and two listeners, and then of the talkers alone."""

    def __init__(self, session: Session) -> None:
        self.session = session
        talker, listener = scripts(session)
        with session.stage() as stage:
            stage.call("listen", TOPIC, "String")
            self.talkers = [stage.start(PACKAGE, talker)]
            self.listener = stage.start(PACKAGE, listener)
            stage.wait_for_start(lambda: stage.call("count", TOPIC) or self.talkers[0].ended)
            self.types = stage.call("types")
            stage.call("advertise", TOPIC, "String")
            stage.wait_for_start(lambda: stage.call("listeners", TOPIC) > 1 or self.listener.ended)
            talks = bool(self._heard(stage))
            if talks:
                stage.wait(lambda: len(self._heard(stage)) > 3 or self.talkers[0].ended, 2.0)
            self.publishers, self.subscribers = stage.call("state")
            self.warnings = stage.call("warnings")
            first = len(self._heard(stage))
            self.strings = [
                f"tutorial check {word} {3 * number}" for number, word in enumerate("ABCDE", 7)
            ]
            for text in self.strings:
                stage.call("send", TOPIC, text)
            stage.wait(lambda: all(text in self.listener.output for text in self.strings), 2.0)
            if talks:
                stage.wait(
                    lambda: len(self._heard(stage)) >= first + 6 or self.talkers[0].ended, LISTEN_S
                )
            self.heard = self._heard(stage)
            self.talker_ended, self.listener_ended = self.talkers[0].ended, self.listener.ended
            self.master_alive = stage.master_lives
            self.first_ended, self.both, self.taken = False, False, {}
            if self.talker_ended or self.listener_ended or not self.heard:
                return
            # A second talker of the same kind; both must go on, or the first must end.
            self.talkers.append(stage.start(PACKAGE, talker))
            names = set(self.publishers.get(TOPIC, []))
            stage.wait_for_start(
                lambda: set(stage.call("state")[0].get(TOPIC, [])) - names or self.talkers[0].ended
            )
            stage.wait_for_start(lambda: self.talkers[0].ended or self._both(stage))
            self.first_ended, self.both = self.talkers[0].ended, self._both(stage)
            so_far = len(self._heard(stage))  # the one that is ended next must be well under way
            stage.wait(lambda: len(self._heard(stage)) > so_far + 2 or self.talkers[1].ended, 3.0)
            both = {"talker.py": self.talkers[-1], "listener.py": self.listener}
            self.taken = dict(zip(both, session.box.end_all(list(both.values()))))

    @staticmethod
    def _heard(stage: Stage) -> Any:
        return [each for each in stage.call("heard", TOPIC) if each[1] != "/tutorial_check"]

    def _both(self, stage: Stage) -> Any:
        return (
            len({caller for _, caller, _ in self._heard(stage)[-20:]}) > 1
            and not self.talkers[0].ended
        )


def talk_of(session: Session) -> Any:
    """Return the Talk of a workspace; made once."""
    return session.run("talk", lambda: Talk(session))
