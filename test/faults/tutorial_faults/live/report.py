"""What is printed of the trials: a violation and what happened when, a row and a table (pure)."""

from __future__ import annotations

from typing import Any, Callable, NamedTuple, Sequence

from tutorial_faults.events import Violation
from tutorial_faults.invariants import moves
from tutorial_faults.live.judge import Record
from tutorial_faults.live.kinds import KINDS

STEP = 0.1  # a change of a velocity worth a line


class Result(NamedTuple):
    """One trial. kinds: of its faults. rest_s: longest time to rest [s]. violations: letters."""

    seed: int
    kinds: tuple[str, ...]
    rest_s: float
    violations: tuple[str, ...]

    def row(self) -> list[Any]:
        """Return the fields of a row of the table."""
        return [self.seed, "+".join(self.kinds), f"{self.rest_s:.3f}", "".join(self.violations)]


def timeline(record: Record, violations: Sequence[Violation] = ()) -> list[str]:
    """Return lines in the order of time: hands, faults, each change of wheels and commands."""
    events = [(at_s, f"hands show {shows}") for at_s, shows in record.hands]
    for injury in record.injuries:
        events.append((injury.begin_s, f"{injury.kind} begins"))
        events.append((injury.end_s, f"{injury.kind} ends"))
    events += [(at_s, f"this machine was late by {gap:.2f} s") for at_s, gap in record.late]
    events += _changes(record.asked, lambda one: one.velocity, "joy2twist asks for")
    events += _changes(record.commands, lambda one: one.velocity, "the base receives")
    events += _changes(record.wheels, lambda one: (one.v, one.w), "wheels turn at")
    events += [(at_s, f"bumpers pressed: {count:.0f}") for at_s, count in record.bumpers]
    events += [(at_s, f"wheels dropped: {count:.0f}") for at_s, count in record.drops]
    events += [(v.at_s, f"VIOLATION ({v.invariant}) {v.what}") for v in violations]
    began = min((at_s for at_s, _ in events), default=0.0)
    return [f"{at_s - began:8.3f} s  {what}" for at_s, what in sorted(events)]


def _changes(
    entries: Sequence[Any], velocity_of: Callable[[Any], Sequence[float]], what: str
) -> list[tuple[float, str]]:
    last: Sequence[float] | None = None
    lines = []
    for entry in entries:
        velocity = velocity_of(entry)
        if (
            last is None
            or moves(velocity) != moves(last)
            or any(not abs(a - b) < STEP for a, b in zip(velocity, last))
        ):
            shown = ", ".join(f"{v:.2f}" for v in velocity if v) or "rest"
            lines.append((entry.at_s, f"{what} {shown}"))
            last = velocity
    return lines


def last_line(results: Sequence[Result]) -> str:
    """Return what the hunt ends with."""
    faults = sum(len(one.kinds) for one in results)
    violations = sum(bool(one.violations) for one in results)
    worst_s = max((one.rest_s for one in results), default=0.0)
    return (
        f"{len(results)} trials, {faults} faults, {violations} violations, "
        f"worst time to rest {worst_s:.2f} s"
    )


def by_kind(results: Sequence[Result]) -> list[str]:
    """Return lines of a table: kind, trials, violations, worst time to rest."""
    lines = ["| kind | trials | violations | worst time to rest [s] |", "|---|---|---|---|"]
    for kind in KINDS:
        having = [one for one in results if kind in one.kinds]
        if having:
            broken = sum(bool(one.violations) for one in having)
            worst_s = max(one.rest_s for one in having)
            lines.append(f"| `{kind}` | {len(having)} | {broken} | {worst_s:.2f} |")
    return lines
