"""What is printed of a violation: seed, faults, and what happened when (pure)."""

from tutorial_faults.invariants import moves
from tutorial_faults.live.plan import in_words

STEP = 0.05  # a change of a velocity worth a line


def timeline(record, violations=()):
    """Lines, in the order of time: hands, faults, every change of what wheels and commands do."""
    events = [(at_s, f"hands show {shows}") for at_s, shows in record.hands]
    for injury in record.injuries:
        events.append((injury.begin_s, f"{injury.kind} begins"))
        events.append((injury.end_s, f"{injury.kind} ends"))
    events += [(at_s, f"this machine was late by {gap:.2f} s") for at_s, gap in record.late]
    events += _changes(record.asked, lambda one: one.velocity, "joy2twist asks for")
    events += _changes(record.commands, lambda one: one.velocity, "the base is told")
    events += _changes(record.wheels, lambda one: (one.v, one.w), "wheels turn at")
    events += [(v.at_s, f"VIOLATION ({v.invariant}) {v.what}") for v in violations]
    began = min((at_s for at_s, _ in events), default=0.0)
    return [f"{at_s - began:8.3f} s  {what}" for at_s, what in sorted(events)]


def _changes(entries, velocity_of, what):
    last, lines = None, []
    for entry in entries:
        velocity = velocity_of(entry)
        if (
            last is None
            or moves(velocity) != moves(last)
            or any(not abs(a - b) < 2 * STEP for a, b in zip(velocity, last))
        ):
            lines.append(
                (entry.at_s, f"{what} {', '.join(f'{v:.2f}' for v in velocity if v) or 'rest'}")
            )
            last = velocity
    return lines


def violation_lines(plan, judgement, record, command):
    """All lines about a trial that violates an invariant. command: which repeats it."""
    lines = [f"VIOLATION, seed {plan.seed}: {in_words(plan)}"]
    lines += [f"  ({v.invariant}) {v.what}" for v in judgement.violations]
    lines += [f"  {line}" for line in timeline(record, judgement.violations)]
    return [*lines, f"  again: {command}"]
