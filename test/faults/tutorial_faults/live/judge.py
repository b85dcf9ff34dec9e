"""What is wrong with a trial, by what the hands showed and what the wheels did (pure).

The nodes under test are not asked. Times [s] are of the system clock, as the stamps of /odom.
"""

from __future__ import annotations

import math
from typing import Any, Iterator, NamedTuple, Sequence

from tutorial_faults.invariants import BASE_TIMEOUT_S, Twist, Violation, WithinLimits, moves
from tutorial_faults.live.table import DRIVES_ON, FAULTS, MAY_STOP, RESTS
from tutorial_testing.hands import DRIVE, RELEASED, TURBO, TURN

HELD = (DRIVE, TURN, TURBO)  # shown with LB held
LIMIT_S = BASE_TIMEOUT_S + 0.02  # from a loss to wheels at rest; /odom comes every 0.02 s
SLACK_S = 0.05  # between the stamps of this process and those of the nodes
# What the preset of the F710 allows with RB held, and the mux and the base with it.
MAX_LINEAR, MAX_ANGULAR = 0.7, 2.0
LATE_S = 0.15  # a gap in the odometry, or a fault that was not there at once

# What an Event is about; of the last two the value is a velocity.
HANDS, BEGINS, ENDS, LATE, SEEN = (
    "hands show",
    "begins:",
    "ends:",
    "this machine is late by",
    "seen:",
)
VELOCITIES = COMMAND, WHEELS = "the base receives", "wheels turn at"


class Event(NamedTuple):
    """Something that was seen in a trial. SEEN: a Violation that wheels do not show."""

    at_s: float
    what: str
    value: Any


def spans(changes: Sequence[tuple[float, bool]]) -> list[tuple[float, float]]:
    """Return (begin, end) of each time in which something is so, from when it changes."""
    found, begin = [], None
    for at_s, is_so in changes:
        if is_so and begin is None:
            begin = at_s
        elif not is_so and begin is not None:
            found.append((begin, at_s))
            begin = None
    return found if begin is None else [*found, (begin, math.inf)]


class Trial:
    """The stream of Events of a trial."""

    def __init__(self, stream: Sequence[Event]) -> None:
        """stream: in any order."""
        self.events = sorted(stream, key=lambda event: event.at_s)
        hands = self.of(HANDS)
        self.free = spans([(at_s, shows not in HELD) for at_s, _, shows in hands])
        self.released = spans([(at_s, shows == RELEASED) for at_s, _, shows in hands])
        ends = {event.value: event.at_s for event in self.of(ENDS)}
        self.hits = {
            FAULTS[name]: (at_s, ends.get(name, math.inf)) for at_s, _, name in self.of(BEGINS)
        }
        self.rest_s = 0.0  # the longest time from a loss or release to rest
        self.violations = self._judge()

    @property
    def was_late(self) -> bool:
        """Whether what was seen may be the lateness of this machine."""
        stamps = [event.at_s for event in self.of(WHEELS)]
        gaps_s = [after - before for before, after in zip(stamps, stamps[1:])]
        is_base_hit = any(fault.part == "base" for fault in self.hits)
        return bool(self.of(LATE)) or (not is_base_hit and max(gaps_s, default=0.0) > LATE_S)

    def of(self, *what: str) -> list[Event]:
        """Return the Events about this."""
        return [event for event in self.events if event.what in what]

    def _judge(self) -> list[Violation]:
        """Return the first Violation of each invariant."""
        limits, must = WithinLimits(MAX_LINEAR, MAX_ANGULAR), {fault.must for fault in self.hits}
        twists = [Twist(at_s, velocity) for at_s, _, velocity in self.of(*VELOCITIES)]
        found = [event.value for event in self.of(SEEN)]
        found += [*filter(None, map(limits.take, twists)), *self._rests()]
        found += self._waits() if MAY_STOP not in must else []
        found += self._drives_on() if must == {DRIVES_ON} else []
        found.sort(key=lambda violation: violation.at_s, reverse=True)
        first = {violation.invariant: violation for violation in found}
        return sorted(first.values(), key=lambda violation: violation.at_s)

    def _rests(self) -> Iterator[Violation]:
        """Yield (a), (d): wheels that turn too long after LB was released or a part was lost."""
        causes = [("a", "LB was released", *span) for span in self.free]
        for fault, span in self.hits.items():
            if (
                fault.must == RESTS and fault.part != "base"
            ):  # a lost base does not report its wheels
                causes.append(("d", f"the loss by {fault.name}", *span))
        for now in [wheels.at_s for wheels in self.of(WHEELS) if moves(wheels.value)]:
            for letter, why, begin, end in causes:
                if begin < now <= end:
                    elapsed_s = now - self._last_blow(begin, now)
                    self.rest_s = max(self.rest_s, elapsed_s)
                    if elapsed_s > LIMIT_S + sum(fault.late_s for fault in self.hits):
                        yield Violation(letter, now, f"wheels turn {elapsed_s:.3f} s after {why}")

    def _last_blow(self, began: float, now: float) -> float:
        """Return when the time to rest begins: a second fault before its end begins it again."""
        last = began
        for begin in sorted(begin for begin, _ in self.hits.values()):
            if last < begin < min(now, last + LIMIT_S):
                last = begin
        return last

    def _waits(self) -> Iterator[Violation]:
        """Yield (b): wheels that stood turn without a release."""
        stood_s = None
        for now, _, velocity in self.of(WHEELS):
            if not moves(velocity):
                stood_s = now if stood_s is None else stood_s
            elif stood_s is not None:
                since = stood_s - SLACK_S
                if not any(begin <= now and end >= since for begin, end in self.released):
                    yield Violation("b", now, f"moved again after {now - stood_s:.3f} s")
                stood_s = None

    def _drives_on(self) -> Iterator[Violation]:
        """Yield (h): a fault outside of the robot's own parts stops it."""
        first = min(begin for begin, _ in self.hits.values())
        last = min((begin for begin, _ in self.free if begin > first), default=math.inf)
        for now, _, velocity in self.of(WHEELS):
            is_free = any(begin <= now < end for begin, end in self.free)
            if first < now < last and not is_free and not moves(velocity):
                yield Violation("h", now, "stopped by a fault elsewhere")
