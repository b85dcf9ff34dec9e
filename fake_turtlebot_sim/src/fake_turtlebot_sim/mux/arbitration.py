"""Which of several inputs drives the robot. Reads no clock: time enters in seconds.

The rule is that of yocs_cmd_vel_mux, the TurtleBot's own: of the inputs that spoke within their
timeout the one with the highest priority is active, and its commands alone go through. A command
goes through at once or never; none is kept for later.
"""

from __future__ import annotations

from enum import Enum
from math import inf, isfinite
from typing import Any, Iterable

from node_kit.arming import Arming, Velocity

IDLE = "idle"  # what is active when no input is
ZERO = (0.0,) * 6  # linear x, y, z [m/s], angular x, y, z [rad/s]
# After a longer silence in the middle of a motion a sender must rest for as long. The commands of
# an outage arrive within milliseconds of each other.
REARM_S = 0.5


class Verdict(Enum):
    """What becomes of a command."""

    OBEYED = "goes through"
    OUTRANKED = "an input of higher priority is active"
    REJECTED = "a command is not a finite number; ignored"
    LATE = (
        "fell silent while it drove, so its commands may be late; obeyed again"
        f" after it has sent nothing but zero for {REARM_S} s"
    )


class Arbiter:
    """Decides about every command of every input."""

    def __init__(self, inputs: Iterable[Any]) -> None:
        """Take parameters.Inputs, whose names and priorities differ."""
        self._inputs = {i.name: i for i in sorted(inputs, key=lambda i: i.priority, reverse=True)}
        self._expiry_s = dict.fromkeys(self._inputs, -inf)
        self._senders: dict[tuple[str, object], Arming] = {}  # (input, sender) -> its Arming
        self._drives = False  # whether the last command that went through was not zero

    def command(self, name: str, velocity: Velocity, now: float, sender: object = "") -> Verdict:
        """Return the Verdict on a velocity (numbers, whatever their units) that came now [s].

        sender: distinguishes the publishers of one input, each of which may be late by itself.
        """
        if not all(map(isfinite, velocity)):
            return Verdict.REJECTED  # and the timeout runs on
        if self._inputs[name].rearm_on_zero:
            speaks = self._senders.setdefault((name, sender), Arming(rest_s=REARM_S))
            if not admits(speaks, velocity, now):
                return Verdict.LATE  # and the timeout runs on
        self._expiry_s[name] = now + self._inputs[name].timeout
        if self.active(now) != name:
            return Verdict.OUTRANKED
        self._drives = any(velocity)
        return Verdict.OBEYED

    def rearms(self, name: str) -> bool:
        """Return whether an input must rest after an outage before it moves the robot again."""
        return bool(self._inputs[name].rearm_on_zero)

    def lost(self) -> None:
        """Disarm all senders on inputs with rearm_on_zero: this node was suspended."""
        for sender in self._senders.values():
            sender.lose()

    def active(self, now: float) -> str:
        """Return the name of the active input at the time now [s], or IDLE."""
        return next((name for name in self._inputs if now < self._expiry_s[name]), IDLE)

    def must_stop(self, now: float) -> bool:
        """Return, once, that all inputs have fallen silent and the last command was not zero.

        A zero is due then, once, so that it never contends with a later command. yocs_cmd_vel_mux
        leaves the stop to the base (yujin_ocs issue 16), but not every base has a timeout.
        """
        must_stop = self._drives and self.active(now) == IDLE
        self._drives = self._drives and not must_stop
        return must_stop

    def lull(self, now: float) -> float:
        """Return the time [s] until the active input expires, at most the shortest timeout.

        A look after that time is late for no input, even for one that starts now.
        """
        expiry_s = self._expiry_s.get(self.active(now), inf)
        return min(expiry_s - now, *(i.timeout for i in self._inputs.values()))


def admits(sender: Arming, velocity: Velocity, now: float) -> bool:
    """Return whether a sender's velocity that came now [s] may go through; a zero always may.

    When a network cable is pulled, TCP keeps what is sent meanwhile and delivers all of it once the
    cable is back. A Twist has no stamp; what gives such commands away is the silence before them.
    A zero among them must not set the rest free, hence a rest of REARM_S.
    """
    if not sender.rests and now - sender.since > REARM_S:
        sender.lose()
    is_zero = not any(velocity)
    may_move = sender.hear(is_zero, now)
    if not is_zero:
        sender.since = now
    return may_move or is_zero
