"""Judges a trial by what the hands showed and what the wheels did.

The nodes under test have no say. Times [s] are of the system clock, as the stamps of /odom.
"""

import math
from typing import Any, NamedTuple

from tutorial_faults.live.table import BASE, DRIVES_ON, FAULTS, MAY_STOP, PAUSES, RESTS
from tutorial_faults.worlds import beyond, moves
from tutorial_testing.hands import DRIVE, RELEASED, TURBO, TURN
from tutorial_testing.rig import TIMEOUT_S

HELD = (DRIVE, TURN, TURBO)  # shown with LB held
LIMIT_S = TIMEOUT_S + 0.02  # from a loss to wheels at rest; /odom comes every 0.02 s
SLACK_S = 0.05  # between the stamps of this process and those of the nodes
# What the preset of the F710 allows with RB held, and the mux and the base with it.
MAX_LINEAR, MAX_ANGULAR = 0.7, 2.0
STARTS_S = 0.3  # a restarted node first loads rospy for so long
LATE_S = 0.15  # a gap in the odometry, or a fault that began late
LINE_LATE_S = 0.08  # a gap of the truth: after 0.1 s without a packet a driver's robot is offline

# What an Event is about; the value of the last two is a velocity.
HANDS, BEGINS, ENDS, LATE = "hands show", "begins:", "ends:", "late by [s]:"
SEEN = "seen:"  # a Violation that wheels do not show
VELOCITIES = COMMAND, WHEELS = "the base receives", "wheels turn at"


class Event(NamedTuple):
    at_s: float
    what: str
    value: Any


def velocity(linear, angular):
    """Return the velocity of a robot that drives [m/s] and turns [rad/s]."""
    return linear, 0.0, 0.0, 0.0, 0.0, angular


class Violation(NamedTuple):
    invariant: str
    at_s: float
    what: str


def spans(changes):
    """Return (begin, end) of the spans that are true, from [(time, whether true from then on)]."""
    true = []
    for at_s, is_true in changes:
        if is_true and (not true or true[-1][1] < math.inf):
            true.append((at_s, math.inf))
        elif not is_true and true:
            true[-1] = true[-1][0], min(at_s, true[-1][1])
    return true


class Trial:
    def __init__(self, stream, sees_truth=False):
        """sees_truth: whether wheels are seen even while their base is down."""
        self._sees_truth = sees_truth
        self.events = sorted(stream, key=lambda event: event.at_s)
        ends = {event.value: event.at_s for event in self.of(ENDS)}
        self.hits = {
            FAULTS[name]: (at_s, ends.get(name, math.inf)) for at_s, _, name in self.of(BEGINS)
        }
        hands = self.of(HANDS)
        self._free = spans([(at_s, shows not in HELD) for at_s, _, shows in hands])
        self._released = spans([(at_s, shows == RELEASED) for at_s, _, shows in hands])
        self.rest_s = 0.0  # the longest time from a loss or release to rest
        self.violations = self._judge()

    @property
    def was_late(self):
        """Whether this machine was too slow for a verdict."""
        stamps = [event.at_s for event in self.of(WHEELS)]
        gaps_s = [after - before for before, after in zip(stamps, stamps[1:])]
        is_base_hit = not self._sees_truth and any(fault.part == BASE for fault in self.hits)
        longest_s = LINE_LATE_S if self._sees_truth else LATE_S
        return bool(self.of(LATE)) or (not is_base_hit and max(gaps_s, default=0.0) > longest_s)

    def of(self, *what):
        return [event for event in self.events if event.what in what]

    def _judge(self):
        """Return the first Violation of each invariant."""
        must = {fault.must for fault in self.hits}
        violations = [event.value for event in self.of(SEEN)]
        for at_s, _, velocity in self.of(*VELOCITIES):
            wrong = beyond(velocity, MAX_LINEAR, MAX_ANGULAR)
            violations += [Violation(letter, at_s, what) for letter, what in wrong]
        violations += self._rests()
        violations += self._waits() if not {MAY_STOP, PAUSES} & must else []
        violations += self._drives_on() if must == {DRIVES_ON} else []
        first = {}
        for violation in sorted(violations, key=lambda violation: violation.at_s):
            first.setdefault(violation.invariant, violation)
        return [*first.values()]

    def _rests(self):
        """Yield (a), (d) if wheels turn too long after a release of LB or the loss of a part."""
        causes = [("a", "LB was released", *span) for span in self._free]
        for fault, span in self.hits.items():
            is_seen = self._sees_truth or fault.part != BASE  # a lost base reports no wheels
            if fault.must in (RESTS, PAUSES) and is_seen:
                causes.append(("d", f"the loss by {fault.name}", *span))
        limit_s = LIMIT_S + sum(fault.late_s for fault in self.hits)
        for now in [wheels.at_s for wheels in self.of(WHEELS) if moves(wheels.value)]:
            for letter, why, begin, end in causes:
                if begin < now <= end:
                    elapsed_s = now - self._last_blow(begin, now)
                    self.rest_s = max(self.rest_s, elapsed_s)
                    if elapsed_s > limit_s:
                        yield Violation(letter, now, f"wheels turn {elapsed_s:.3f} s after {why}")

    def _last_blow(self, last, now):
        """Return when the time to rest begins: a second fault meanwhile starts it again."""
        for begin in sorted(begin for begin, _ in self.hits.values()):
            if last < begin < min(now, last + LIMIT_S):
                last = begin
        return last

    def _waits(self):
        """Yield (b) if wheels at rest turn without a release; a base that is down is at rest."""
        restarts = any(fault.part == BASE and fault.is_restart for fault in self.hits)
        stood_s, last_s = None, math.inf
        for now, _, velocity in self.of(WHEELS):
            if restarts and stood_s is None and now - last_s > STARTS_S:
                stood_s = last_s
            last_s = now
            if not moves(velocity):
                stood_s = now if stood_s is None else stood_s
            elif stood_s is not None:
                since = stood_s - SLACK_S
                if not any(begin <= now and end >= since for begin, end in self._released):
                    yield Violation("b", now, f"moved again after {now - stood_s:.3f} s")
                stood_s = None

    def _drives_on(self):
        """Yield (h) if a fault outside the robot's own parts stops it."""
        first = min(begin for begin, _ in self.hits.values())
        last = min((begin for begin, _ in self._free if begin > first), default=math.inf)
        for now, _, velocity in self.of(WHEELS):
            is_free = any(begin <= now < end for begin, end in self._free)
            if first < now < last and not is_free and not moves(velocity):
                yield Violation("h", now, "stopped by a fault elsewhere")
