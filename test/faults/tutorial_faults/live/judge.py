"""What is wrong with a trial, by what the hands showed and what the wheels did (pure).

The nodes under test are not asked. Times [s] are all of the system clock, as the stamps of /odom.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Sequence

from tutorial_faults.events import Twist, Violation, Wheels
from tutorial_faults.invariants import BASE_TIMEOUT_S, WithinLimits, judged, moves
from tutorial_faults.live.kinds import BASE, KINDS, MUX
from tutorial_faults.live.plan import HELD
from tutorial_testing.hands import RELEASED

PERIOD_S = 0.02  # of /odom
LIMIT_S = BASE_TIMEOUT_S + PERIOD_S  # from a loss to wheels at rest
SLACK_S = 0.05  # between the stamps of this process and those of the nodes
# What the preset of the F710 allows with RB held, and the mux and the base with it.
MAX_LINEAR, MAX_ANGULAR = 0.7, 2.0
# An input that speaks holds those below it off for so long, less the way of a message.
TELEOP_S = 1.0 - 0.15
# As long a gap as a busy machine may make in what is published every 20 ms.
LONGEST_GAP_S = 0.3
LONGEST_PUSH_S = 0.5  # in a world with a safety controller


@dataclass
class Injury:
    """A fault as it came: begin and end [s]. end_s is infinite as long as it lasts."""

    kind: str
    begin_s: float
    end_s: float = math.inf


@dataclass
class Record:
    """All that was seen in a trial, each in the order of time [s]."""

    hands: list[tuple[float, str]] = field(default_factory=list)  # what they show from then on
    injuries: list[Injury] = field(default_factory=list)
    wheels: list[Wheels] = field(default_factory=list)
    commands: list[Twist] = field(default_factory=list)  # at the base
    asked: list[Twist] = field(default_factory=list)  # at the mux, by teleop
    late: list[tuple[float, float]] = field(default_factory=list)  # (end, length) of a gap
    reported: list[Violation] = field(default_factory=list)  # by what wheels do not show
    is_safe: bool = False  # in a world, with a safety controller
    bumpers: list[tuple[float, float]] = field(default_factory=list)  # how many are pressed
    drops: list[tuple[float, float]] = field(default_factory=list)  # how many wheels dropped


@dataclass(frozen=True)
class Judgement:
    """violations: of any invariant. rest_s: the longest time from a loss or release to rest [s]."""

    violations: tuple[Violation, ...]
    rest_s: float


def judge(record: Record) -> Judgement:
    """Return the Judgement on a Record, with the first violation of each invariant."""
    limits = WithinLimits(MAX_LINEAR, MAX_ANGULAR)
    found = judged([*record.wheels, *record.commands, *record.asked], limits)
    late, rest_s = _rest(record)
    found += late + _outranked(record)
    found += _unsafe(record) if record.is_safe else _moved_again(record) + _went_on(record)
    first: dict[str, Violation] = {}
    for violation in sorted(record.reported + found, key=lambda violation: violation.at_s):
        first.setdefault(violation.invariant, violation)
    return Judgement(tuple(first.values()), rest_s)


def shown_at(changes: Sequence[tuple[float, str]], now: float) -> tuple[str, float]:
    """Return (what the hands show at a time, since when something is held, or nothing is)."""
    shown, since = RELEASED, changes[0][0] if changes else now
    for at_s, shows in changes:
        if at_s > now:
            break
        if (shows in HELD) != (shown in HELD):
            since = at_s
        shown = shows
    return shown, since


def _rest(record: Record) -> tuple[list[Violation], float]:
    """Return the Violations (a) and (d), wheels that turn too long; and the longest time [s]."""
    found, worst_s = [], 0.0
    for wheels in record.wheels:
        # Backing off is the safety controller's, whatever is shown or lost.
        if not moves((wheels.v, wheels.w)) or (record.is_safe and wheels.v <= 0):
            continue
        now = wheels.at_s
        shown, since = shown_at(record.hands, now)
        losses = [(i.begin_s, i.kind) for i in record.injuries if _lost(i, now)]
        if shown not in HELD:
            losses.append((since, ""))
        for began, kind in losses:
            elapsed_s = now - _last_blow(record.injuries, began, now)
            worst_s = max(worst_s, elapsed_s)
            if elapsed_s > LIMIT_S + _allowed(record.injuries, began, now):
                letter = "d" if kind else "a"
                why = f"the loss by {kind}" if kind else f"LB was released ({shown})"
                found.append(Violation(letter, now, f"wheels turn {elapsed_s:.3f} s after {why}"))
    return found[:1], worst_s


def _lost(injury: Injury, now: float) -> bool:
    """Return whether a part is lost at a time; when the base is, its wheels say nothing."""
    kind = KINDS[injury.kind]
    return kind.loses and kind.part != BASE and injury.begin_s < now <= injury.end_s


def _last_blow(injuries: Sequence[Injury], began: float, now: float) -> float:
    """Return when the time to rest begins: a second fault before its end begins it again."""
    last = began
    for injury in sorted(injuries, key=lambda injury: injury.begin_s):
        if last < injury.begin_s < now and injury.begin_s - last <= LIMIT_S:
            last = injury.begin_s
    return last


def _allowed(injuries: Sequence[Injury], began: float, now: float) -> float:
    """Return what the faults in force may add [s]."""
    return sum(
        KINDS[i.kind].late_s for i in injuries if i.begin_s < now and began - LIMIT_S < i.end_s
    )


def _moved_again(record: Record) -> list[Violation]:
    """Return the Violations (b), (f) after a cut: wheels that stood turn without a release."""
    if not all(KINDS[injury.kind].rearms for injury in record.injuries):
        return []
    stood_s = None
    for wheels in record.wheels:
        now = wheels.at_s
        if not moves((wheels.v, wheels.w)):
            stood_s = now if stood_s is None else stood_s
        elif stood_s is not None:
            if not _released_within(record.hands, stood_s - SLACK_S, now):
                cut = any(i.kind == "link_down" and i.begin_s < now for i in record.injuries)
                what = f"wheels that stood since {now - stood_s:.3f} s turn, without a release"
                return [Violation("f" if cut else "b", now, what)]
            stood_s = None
    return []


def _released_within(changes: Sequence[tuple[float, str]], begin: float, end: float) -> bool:
    """Return whether all was released at some time between two."""
    return shown_at(changes, begin)[0] == RELEASED or any(
        begin <= at_s <= end and shows == RELEASED for at_s, shows in changes
    )


def _went_on(record: Record) -> list[Violation]:
    """Return the Violations (h): a fault outside of the robot's own parts stops it."""
    kinds = [KINDS[injury.kind] for injury in record.injuries]
    if not kinds or not all(kind.goes_on for kind in kinds):
        return []
    begin = min(injury.begin_s for injury in record.injuries)
    end = next(
        (at_s for at_s, shows in record.hands if at_s > begin and shows not in HELD), math.inf
    )
    last_s = None
    for wheels in record.wheels:
        if not begin < wheels.at_s < end or shown_at(record.hands, wheels.at_s)[0] not in HELD:
            continue
        if last_s is not None and wheels.at_s - last_s > LONGEST_GAP_S:
            return [Violation("h", wheels.at_s, f"silent for {wheels.at_s - last_s:.3f} s")]
        if not moves((wheels.v, wheels.w)):
            return [Violation("h", wheels.at_s, "stopped by a fault elsewhere")]
        last_s = wheels.at_s
    return []


def _unsafe(record: Record) -> list[Violation]:
    """Return the Violations (i): a push that lasts, a fall; unless mux or base were hit."""
    if any(KINDS[injury.kind].part in (MUX, BASE) for injury in record.injuries):
        return []
    found = [Violation("i", at_s, "a wheel dropped over an edge") for at_s, n in record.drops if n]
    ends = [record.wheels[-1].at_s] if record.wheels else []
    since_s = None
    for at_s, pressed in [*record.bumpers, *((end, 0) for end in ends)]:
        if since_s is not None and not pressed and at_s - since_s > LONGEST_PUSH_S + SLACK_S:
            found.append(Violation("i", at_s, f"a bumper was pressed for {at_s - since_s:.3f} s"))
        since_s = (at_s if since_s is None else since_s) if pressed else None
    return found


def _outranked(record: Record) -> list[Violation]:
    """Return the Violations (e): a lower input, which drives sideways, while teleop speaks."""
    if any(KINDS[injury.kind].part == MUX for injury in record.injuries):
        return []
    spoke_s = -math.inf
    for command in record.commands:
        sideways = command.velocity[1] != 0
        if sideways and command.at_s < spoke_s + TELEOP_S:
            return [Violation("e", command.at_s, "a lower input drives while teleop speaks")]
        if not sideways and moves(command.velocity):
            spoke_s = command.at_s
    return []
