"""Goes through every state that a machine can reach (pure): breadth first, over the real objects.

A World holds real objects of the suite and the invariants that watch them. It can be copied, takes
an event, and has a key: two Worlds with the same key behave alike from then on. When no event leads
to a new key, every reachable state was seen, and each transition was judged.

What makes the states finite:

- Velocities, axes, buttons: those of a finite alphabet.
- Times: the rules only add them and compare their differences, so a key has the time since or
  until, and not the time. What lies further back than every threshold is "long ago", and what is
  due is "over". Time passes in one step at a time: with thresholds that are multiples of g and with
  n clocks running at once, in steps of g / (n + 1). Every order in which clocks can lie between, at
  and beyond their thresholds then occurs on this grid (the regions of a timed automaton).
- Texts, counts for the user, and what only decides whether to warn, are left out of a key.
"""

from __future__ import annotations

import math
from typing import Any, Collection, NamedTuple

from tutorial_faults.events import Violation

LONG_AGO, OVER = "long ago", "over"
SHOWN_EVENTS = 30  # of the way to a violation, at most, in the text


class Moment(int):
    """A time [us] to which seconds are added without rounding: at a threshold is at it exactly."""

    __slots__ = ()

    def __add__(self, seconds: Any) -> Any:
        """Return the Moment so many seconds later, or infinity."""
        return seconds if math.isinf(seconds) else Moment(int(self) + round(seconds * 1e6))

    __radd__ = __add__

    def __sub__(self, other: Any) -> Any:
        """Return the seconds since another Moment, or the Moment so many seconds before."""
        if isinstance(other, Moment):
            return (int(self) - int(other)) / 1e6
        return self + -other


PLAIN = (bool, int, float, str, tuple, type(None), Moment)


def copy_of(one: Any) -> Any:
    """Return a copy of an object, whose attributes are the same objects."""
    new = object.__new__(type(one))
    new.__dict__.update(one.__dict__)
    return new


def since(now: Any, then: Any, horizon_s: float) -> Any:
    """Return what a key has of a time of the past: the seconds since."""
    if then is None:
        return None
    elapsed_s = now - then
    return elapsed_s if elapsed_s < horizon_s else LONG_AGO


def until(now: Any, then: Any) -> Any:
    """Return what a key has of a time at which something is due: the seconds until."""
    return then if then in (None, math.inf) else then - now if then > now else OVER


def key_of(
    one: Any,
    now: Any,
    horizon_s: float = 0.0,
    *,
    past: Collection[str] = (),
    future: Collection[str] = (),
    without: Collection[str] = (),
) -> tuple[Any, ...]:
    """Return the attributes of an object for a key.

    past, future: names of those that are times. horizon_s: at least all that a time of the past is
    compared with [s]. Raises TypeError for an attribute that is neither plain nor left out: all
    copies would share it.
    """
    values = []
    for name, value in vars(one).items():
        if name in without:
            continue
        if type(value) not in PLAIN:
            raise TypeError(f"{type(one).__name__}.{name} is new: copy it, or leave it out")
        if name in past:
            values.append(since(now, value, horizon_s))
        elif name in future:
            values.append(until(now, value))
        else:
            values.append(value)
    return tuple(values)


class Explored(NamedTuple):
    """What was found on the way through all states."""

    states: int
    transitions: int
    depth: int  # the longest of all shortest ways to a state, in events
    violations: list[tuple[Violation, tuple[str, ...]]]  # each with the events that lead to it

    def __str__(self) -> str:
        """Return the figures, and each violation with the way to it."""
        counts = f"{self.states} states, {self.transitions} transitions, depth {self.depth}"
        return f"{counts}, {len(self.violations)} violations" + "".join(
            f"\n  ({violation.invariant}) {violation.what}, after {', '.join(way[-SHOWN_EVENTS:])}"
            for violation, way in self.violations
        )


def explore(start: Any, events: dict[str, Any], most_states: int = 1_000_000) -> Explored:
    """Take every event in every reachable state, until there is no new one or a violation.

    start: a World with copy(), key() and take(event), which returns a list of Violations. events:
    from a name to the argument of take(). Raises RuntimeError when the states do not end.
    """
    frontier = [(start, start.key())]
    came_from: dict[Any, Any] = {frontier[0][1]: None}  # key -> (key before, name of the event)
    transitions = depth = 0
    while frontier:
        found = []
        for world, key in frontier:
            for name, event in events.items():
                transitions += 1
                new = world.copy()
                wrong = _judged(new, event)
                if wrong:
                    way = (*_way(came_from, key), name)
                    violations = [(one, way) for one in wrong]
                    return Explored(len(came_from), transitions, depth, violations)
                new_key = new.key()
                if new_key not in came_from:
                    came_from[new_key] = (key, name)
                    found.append((new, new_key))
        if len(came_from) > most_states:
            raise RuntimeError(f"more than {most_states} states: one of their parts grows forever")
        frontier, depth = found, depth + bool(found)
    return Explored(len(came_from), transitions, depth, [])


def _judged(world: Any, event: Any) -> Any:
    try:
        return world.take(event)
    except Exception as error:  # any of them would end the node
        return [Violation("an exception", 0, repr(error))]


def _way(came_from: dict[Any, Any], key: Any) -> list[str]:
    """Return the names of the events that led to a key."""
    names = []
    while came_from[key]:
        key, name = came_from[key]
        names.append(name)
    return names[::-1]
