"""Which of several inputs drives the robot. Reads no clock: time enters in seconds.

The rule is that of yocs_cmd_vel_mux, the TurtleBot's own: of the inputs that sent within their
timeout the one with the highest priority is active, and its commands alone go through. A command
goes through at once or never; none is kept for later.
"""

from __future__ import annotations

from enum import Enum
from math import inf, isfinite
from typing import Any, Iterable, Iterator, NamedTuple

from node_kit.rules.arming import SETTLING_S, SILENCE_S, Velocity

IDLE = "idle"  # what is active when no input is
# What a network kept arrives at once. No key repeats as fast (X11: 25 to 30 Hz); a program that
# sends as fast is obeyed again after SETTLING_S.
TOGETHER_S = 0.02


class Ruling(Enum):
    """What becomes of a command."""

    OBEYED = "goes through"
    OUTRANKED = "an input of higher priority is active"
    WAITS = "goes through after TOGETHER_S, unless another one follows sooner"
    REJECTED = "a command is not a finite number; ignored"
    LATE = "what a broken network had kept is ignored; a stick that is held must be released once"


class PublishingNode(NamedTuple):
    """A node that publishes on an input."""

    name: str = ""
    is_stick: bool = False  # a person's hands drive, hold-to-run style, and repeat their velocity
    is_remote: bool = False  # on another host, and so behind a network that may break


HERE = PublishingNode()


class BacklogFilter:
    """Separates the commands that a broken network kept from those of a slow sender.

    When a cable is pulled, TCP keeps what is sent meanwhile and delivers all of it once the cable
    is back. A Twist has no stamp; but of such commands several arrive at once after a silence of
    SILENCE_S in a motion. Hands that hold a stick are never silent for so long: they must rest for
    SILENCE_S first.
    """

    def __init__(self, publisher: PublishingNode) -> None:
        self._is_stick = publisher.is_stick
        self._may_be_late = publisher.is_stick or publisher.is_remote
        self.heard_s = self.doubt_s = -inf  # the last command; the first one after a silence
        self.late_until_s = self.rests_since_s = -inf
        self.moves = False  # the last command was not zero (node_kit.rules.released)
        self.waiting: Velocity | None = None  # the first command after a silence

    def judge(self, velocity: Velocity, now: float) -> Ruling:
        """Return the Ruling on a velocity that came now [s]; a zero is always OBEYED."""
        since_s, moved = now - self.heard_s, self.moves
        is_first = moved and since_s > SILENCE_S and self._may_be_late
        self.heard_s, self.moves, self.waiting = now, any(velocity), None
        if is_first:
            self.doubt_s = now
            self.late_until_s = inf if self._is_stick else self.late_until_s
        elif since_s < TOGETHER_S and now - self.doubt_s < SETTLING_S:
            self.late_until_s = max(self.late_until_s, self.doubt_s + SETTLING_S)
        if not self.moves:
            self.rests_since_s = now if moved else self.rests_since_s
            return Ruling.OBEYED
        if not moved and now - self.rests_since_s >= SILENCE_S:
            self.late_until_s = -inf
        if now < self.late_until_s:
            return Ruling.LATE
        if is_first:
            self.waiting = velocity
            return Ruling.WAITS
        return Ruling.OBEYED


class Arbiter:
    """Decides about every command of every input."""

    def __init__(self, inputs: Iterable[Any]) -> None:
        """Take parameters.Inputs, whose names and priorities differ."""
        self._inputs = {i.name: i for i in sorted(inputs, key=lambda i: i.priority, reverse=True)}
        self._expiry_s = dict.fromkeys(self._inputs, -inf)
        self._senders: dict[
            tuple[str, PublishingNode], BacklogFilter
        ] = {}  # the first: name of the input
        self._drives = False  # whether the last command that went through was not zero

    def command(
        self, name: str, velocity: Velocity, now: float, sender: PublishingNode = HERE
    ) -> Ruling:
        """Return the Ruling on a velocity (numbers, whatever their units) that came now [s].

        sender: each of the publishers of one input may be late by itself.
        """
        if not all(map(isfinite, velocity)):
            return Ruling.REJECTED  # and the timeout runs on
        ruling = self._senders.setdefault((name, sender), BacklogFilter(sender)).judge(
            velocity, now
        )
        if ruling is not Ruling.OBEYED:
            return ruling  # and the timeout runs on
        return self._obey(name, velocity, now)

    def _obey(self, name: str, velocity: Velocity, now: float) -> Ruling:
        self._expiry_s[name] = now + self._inputs[name].timeout
        if self.active(now) != name:
            return Ruling.OUTRANKED
        self._drives = any(velocity)
        return Ruling.OBEYED

    def waited(self, now: float) -> Iterator[tuple[Velocity, PublishingNode]]:
        """Yield each command, with its sender, that waited for TOGETHER_S and goes through now.

        The highest input first, so that none goes through for a moment below another.
        """
        order = [*self._inputs]
        for (name, sender), one in sorted(
            self._senders.items(), key=lambda item: order.index(item[0][0])
        ):
            if one.waiting is not None and now >= one.heard_s + TOGETHER_S:
                velocity, one.waiting = one.waiting, None
                if self._obey(name, velocity, now) is Ruling.OBEYED:
                    yield velocity, sender

    def active(self, now: float) -> str:
        """Return the name of the active input at the time now [s], or IDLE."""
        return self._highest(now) or IDLE

    def _highest(self, now: float) -> str | None:
        return next((name for name in self._inputs if now < self._expiry_s[name]), None)

    def must_stop(self, now: float) -> bool:
        """Return, once, that all inputs have fallen silent and the last command was not zero.

        A zero is due then, once, so that it never contends with a later command. yocs_cmd_vel_mux
        leaves the stop to the base (yujin_ocs issue 16), but not every base has a timeout.
        """
        must_stop = self._drives and not self._highest(now)
        self._drives = self._drives and not must_stop
        return must_stop

    def lull(self, now: float) -> float:
        """Return the time [s] until the active input expires or a command has waited.

        It is at most the shortest timeout: a look after that is late for no input, even for one
        that starts now.
        """
        waiting = (one.heard_s for one in self._senders.values() if one.waiting is not None)
        due_s = min((heard_s + TOGETHER_S for heard_s in waiting), default=inf)
        due_s = min(due_s, self._expiry_s.get(self.active(now), inf))
        return max(0.0, min(due_s - now, *(i.timeout for i in self._inputs.values())))
