"""Arbitration between the inputs of the multiplexer. Times are in seconds of one clock.

The rule is that of yocs_cmd_vel_mux, the TurtleBot's own: of the inputs that have sent a command
within their timeout, the one with the highest priority is active, and only its commands go through.
A command goes through at once or not at all; none is kept for later.
"""

from __future__ import annotations

from enum import Enum
from math import inf, isfinite
from typing import Any, Iterable, Iterator, NamedTuple

from node_kit.rules.arming import SETTLING_S, SILENCE_S, Velocity

IDLE = "idle"  # the name of the active input while there is none
# Commands this close together are a backlog, which a network delivers at once. No key repeats so
# fast (X11: 25 to 30 Hz); a program that sends so fast is obeyed again after SETTLING_S.
TOGETHER_S = 0.02


class Ruling(Enum):
    """The decision on one command."""

    OBEYED = "goes through"
    OUTRANKED = "an input of higher priority is active"
    WAITS = "goes through after TOGETHER_S, unless another command follows sooner"
    REJECTED = "a command is not a finite number; ignored"
    LATE = "commands delayed by a broken network are ignored; release the stick once to drive again"


class PublishingNode(NamedTuple):
    """A node that publishes on an input."""

    name: str = ""
    is_stick: bool = False  # a held stick, whose velocity is repeated until it is released
    is_remote: bool = False  # on another host, behind a network that may break


HERE = PublishingNode()


class BacklogFilter:
    """Distinguishes commands delayed by a broken network from those of a slow publisher.

    While a cable is unplugged, TCP keeps what is sent and delivers all of it once the cable is
    back. A Twist has no stamp, but several such commands arrive at once, after a silence of more
    than SILENCE_S in the middle of a motion. A held stick is never silent for that long; after
    such a silence it must be released for SILENCE_S.
    """

    def __init__(self, node: PublishingNode) -> None:
        self._is_stick = node.is_stick
        self._may_be_late = node.is_stick or node.is_remote
        self.received_s = self.doubt_s = -inf  # the last command; the first one after a silence
        self.late_until_s = self.rests_since_s = -inf
        self.is_moving = False  # the last command was not zero (see node_kit.rules.released)
        self.waiting: Velocity | None = None  # the first command after a silence

    def judge(self, velocity: Velocity, now: float) -> Ruling:
        """Return the Ruling on a velocity that arrives now [s]; a zero is always OBEYED."""
        since_s, moved = now - self.received_s, self.is_moving
        is_first = moved and since_s > SILENCE_S and self._may_be_late
        self.received_s, self.is_moving, self.waiting = now, any(velocity), None
        if is_first:
            self.doubt_s = now
            self.late_until_s = inf if self._is_stick else self.late_until_s
        elif since_s < TOGETHER_S and now - self.doubt_s < SETTLING_S:
            self.late_until_s = max(self.late_until_s, self.doubt_s + SETTLING_S)
        if not self.is_moving:
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
    """Decides on each command of each input."""

    def __init__(self, inputs: Iterable[Any]) -> None:
        """Take parameters.Inputs, whose names and priorities differ."""
        self._inputs = {i.name: i for i in sorted(inputs, key=lambda i: -i.priority)}
        self._expiry_s = dict.fromkeys(self._inputs, -inf)
        self._filters: dict[tuple[str, PublishingNode], BacklogFilter] = {}  # str: an input's name
        self._is_moving = False  # the last command that went through was not zero

    def command(
        self, name: str, velocity: Velocity, now: float, node: PublishingNode = HERE
    ) -> Ruling:
        """Return the Ruling on a velocity (numbers in any units) that arrives now [s].

        node: the publisher; each publisher of an input has a backlog of its own.
        """
        if not all(map(isfinite, velocity)):
            return Ruling.REJECTED  # without restarting the timeout
        backlog = self._filters.setdefault((name, node), BacklogFilter(node))
        ruling = backlog.judge(velocity, now)
        if ruling is not Ruling.OBEYED:
            return ruling  # without restarting the timeout
        return self._obey(name, velocity, now)

    def _obey(self, name: str, velocity: Velocity, now: float) -> Ruling:
        self._expiry_s[name] = now + self._inputs[name].timeout
        if self.active(now) != name:
            return Ruling.OUTRANKED
        self._is_moving = any(velocity)
        return Ruling.OBEYED

    def waited(self, now: float) -> Iterator[tuple[Velocity, PublishingNode]]:
        """Yield each command that has waited for TOGETHER_S and goes through now, with its node.

        The input with the highest priority comes first, so that no lower one goes through before.
        """
        order = [*self._inputs]
        backlogs = sorted(self._filters.items(), key=lambda item: order.index(item[0][0]))
        for (name, node), backlog in backlogs:
            if backlog.waiting is not None and now >= backlog.received_s + TOGETHER_S:
                velocity, backlog.waiting = backlog.waiting, None
                if self._obey(name, velocity, now) is Ruling.OBEYED:
                    yield velocity, node

    def active(self, now: float) -> str:
        """Return the name of the active input at the time now [s], or IDLE."""
        return self._highest(now) or IDLE

    def _highest(self, now: float) -> str | None:
        return next((name for name in self._inputs if now < self._expiry_s[name]), None)

    def must_stop(self, now: float) -> bool:
        """Return whether all inputs have just fallen silent after a command that was not zero.

        Then one zero is due, and only one, so that it never contends with a later command.
        yocs_cmd_vel_mux leaves the stop to the base (yujin_ocs issue 16), but not every base has a
        timeout.
        """
        must_stop = self._is_moving and not self._highest(now)
        self._is_moving = self._is_moving and not must_stop
        return must_stop

    def lull(self, now: float) -> float:
        """Return the time [s] until the active input expires or a command has waited long enough.

        It is at most the shortest timeout, so that the next look is in time for every input, even
        one that becomes active now.
        """
        waiting = [f.received_s for f in self._filters.values() if f.waiting is not None]
        due_s = min(waiting, default=inf) + TOGETHER_S
        due_s = min(due_s, self._expiry_s.get(self.active(now), inf))
        return max(0.0, min(due_s - now, *(i.timeout for i in self._inputs.values())))
