"""What is wrong with a trial, by what the hands showed and what the wheels did (pure).

The nodes under test are not asked. Times [s] are all of the system clock, which the stamps of /odom
have, too; with simulated time, when /odom came.
"""

import math
from dataclasses import dataclass, field
from typing import List, Tuple

from tutorial_faults.events import Violation
from tutorial_faults.invariants import BASE_TIMEOUT_S, GoesOn, WithinLimits, judged, moves
from tutorial_faults.live.kinds import BASE, KINDS, MUX
from tutorial_faults.live.plan import HELD, RELEASED

PERIOD_S = 0.02  # of /odom
# From a loss to wheels at rest.
LIMIT_S = BASE_TIMEOUT_S + PERIOD_S
# The stamps of this process and of the nodes are taken by different threads.
SLACK_S = 0.05
# What the preset of the F710 allows with RB held, and the mux and the base with it.
MAX_LINEAR, MAX_ANGULAR = 0.7, 2.0
# An input that speaks holds those below it off for so long; less what a message is under way.
TELEOP_S = 1.0 - 0.15
# As long a gap as a busy machine may make in what is published every 20 ms.
LONGEST_GAP_S = 0.3


@dataclass
class Injury:
    """A fault as it really came: begin and end [s]. end_s is infinite as long as it lasts."""

    kind: str
    begin_s: float
    end_s: float = math.inf


@dataclass
class Record:
    """All that was seen in a trial, each in the order of time.

    hands: (time, what they show). injuries: Injury. wheels: events.Wheels. commands: what the base
    was told (events.Twist). asked: what the mux was told by teleop (events.Twist). late: gaps (time
    of their end, length) in which this machine did not run the hunt itself. told: other violations.
    """

    hands: List[Tuple[float, str]] = field(default_factory=list)
    injuries: List[Injury] = field(default_factory=list)
    wheels: list = field(default_factory=list)
    commands: list = field(default_factory=list)
    asked: list = field(default_factory=list)
    late: List[Tuple[float, float]] = field(default_factory=list)
    told: List[Violation] = field(default_factory=list)


@dataclass(frozen=True)
class Judgement:
    """violations: of any invariant. rest_s: the longest time from a loss or release to rest [s]."""

    violations: Tuple[Violation, ...]
    rest_s: float


def judge(record):
    """The Judgement on a Record."""
    limits = WithinLimits(MAX_LINEAR, MAX_ANGULAR)
    found = judged([*record.wheels, *record.commands, *record.asked], limits)
    late, rest_s = _rest(record)
    found += late + _moved_again(record) + _went_on(record) + _outranked(record)
    # Of each invariant the first: what follows is mostly the same.
    first = {}
    for violation in sorted(record.told + found, key=lambda violation: violation.at_s):
        first.setdefault(violation.invariant, violation)
    return Judgement(tuple(first.values()), rest_s)


class Hands:
    """What the hands showed, and when."""

    def __init__(self, changes):
        """changes: (time, what is shown from then on), in order."""
        self._changes = changes

    def at(self, now):
        """(What is shown at a time, since when something is held, or nothing is)."""
        shown, since = RELEASED, self._changes[0][0] if self._changes else now
        for at_s, shows in self._changes:
            if at_s > now:
                break
            if (shows in HELD) != (shown in HELD):
                since = at_s
            shown = shows
        return shown, since

    def released_within(self, begin, end):
        """Whether all was released at some time between two."""
        if self.at(begin)[0] == RELEASED:
            return True
        return any(begin <= at_s <= end and shows == RELEASED for at_s, shows in self._changes)


def _rest(record):
    """The Violations (a) and (d): wheels that turn too long; and the longest time to rest."""
    hands, found, worst_s = Hands(record.hands), [], 0.0
    for wheels in record.wheels:
        if not moves((wheels.v, wheels.w)):
            continue
        now = wheels.at_s
        shown, since = hands.at(now)
        losses = [(i.begin_s, i.kind) for i in record.injuries if _lost(i, now)]
        if shown not in HELD:
            losses.append((since, ""))
        for began, kind in losses:
            last = _last_blow(record.injuries, began, now)
            elapsed_s = now - last
            worst_s = max(worst_s, elapsed_s)
            if elapsed_s > LIMIT_S + _allowed(record.injuries, began, now):
                letter = "d" if kind else "a"
                why = f"the loss by {kind}" if kind else f"LB was released ({shown})"
                found.append(Violation(letter, now, f"wheels turn {elapsed_s:.3f} s after {why}"))
    return found[:1], worst_s


def _lost(injury, now):
    """Whether a part is lost at a time; when the base is, its wheels say nothing."""
    kind = KINDS[injury.kind]
    return kind.loses and kind.part != BASE and injury.begin_s < now <= injury.end_s


def _last_blow(injuries, began, now):
    """The time from which on the wheels must come to rest: a second fault before begins anew."""
    last = began
    for injury in sorted(injuries, key=lambda injury: injury.begin_s):
        if last < injury.begin_s < now and injury.begin_s - last <= LIMIT_S:
            last = injury.begin_s
    return last


def _allowed(injuries, began, now):
    """What the faults in force may add [s]."""
    return sum(
        KINDS[i.kind].late_s for i in injuries if i.begin_s < now and began - LIMIT_S < i.end_s
    )


def _moved_again(record):
    """The Violations (b), and (f) after a cut: wheels that stood turn again without a release."""
    if not all(KINDS[injury.kind].rearms for injury in record.injuries):
        return []
    hands, stood_s, found = Hands(record.hands), None, []
    for wheels in record.wheels:
        now = wheels.at_s
        if not moves((wheels.v, wheels.w)):
            stood_s = now if stood_s is None else stood_s
        elif stood_s is not None:
            if not hands.released_within(stood_s - SLACK_S, now):
                cut = any(i.kind == "link_down" and i.begin_s < now for i in record.injuries)
                what = f"wheels that stood since {now - stood_s:.3f} s turn, without a release"
                found.append(Violation("f" if cut else "b", now, what))
            stood_s = None
    return found[:1]


def _went_on(record):
    """The Violations (h): a fault that is none of the robot's stops it."""
    kinds = [KINDS[injury.kind] for injury in record.injuries]
    if not kinds or not all(kind.goes_on for kind in kinds):
        return []
    begin = min(injury.begin_s for injury in record.injuries)
    hands, goes_on = Hands(record.hands), GoesOn("", LONGEST_GAP_S, drives=True)
    held = [w for w in record.wheels if w.at_s > begin and hands.at(w.at_s)[0] in HELD]
    end = next((at_s for at_s, shows in record.hands if at_s > begin and shows not in HELD), None)
    return judged([w for w in held if end is None or w.at_s < end], goes_on)[:1]


def _outranked(record):
    """The Violations (e): a lower input, known by its part sideways, drives while teleop speaks."""
    if any(KINDS[injury.kind].part == MUX for injury in record.injuries):
        return []
    spoke_s, found = -math.inf, []
    for command in record.commands:
        sideways = command.velocity[1] != 0
        if sideways and command.at_s < spoke_s + TELEOP_S:
            found.append(Violation("e", command.at_s, "a lower input drives while teleop speaks"))
        elif not sideways and moves(command.velocity):
            spoke_s = command.at_s
    return found[:1]
