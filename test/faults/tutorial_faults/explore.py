"""Goes through every state that a machine can reach (pure): breadth first, over the real objects.

A World can be copied, takes an event, and has a key: two Worlds with the same key behave alike from
then on. When no event leads to a new key, every reachable state was seen, and each transition was
judged.

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
from typing import Any, Collection, Dict, Iterable, NamedTuple

from tutorial_faults.events import Violation

PASS, TICK, SUSPENDED = "time passes", "tick", "suspended"  # events; a TICK: the node looks
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


Parts = Dict[str, Any]  # from the name of an attribute to the Parts of that one


def copy_of(one: Any, parts: Parts) -> Any:
    """Return a copy of an object, whose attributes are the same objects but for these parts.

    A list or dict, with the values of the dict, is copied, too.
    """
    if isinstance(one, dict):
        return {key: copy_of(value, parts) for key, value in one.items()}
    if not hasattr(one, "__dict__"):
        return one.copy() if isinstance(one, list) else one
    new = object.__new__(type(one))
    new.__dict__.update(one.__dict__)
    for name, parts_of_it in parts.items():
        if name in one.__dict__:
            new.__dict__[name] = copy_of(one.__dict__[name], parts_of_it)
    return new


class World:
    """Real objects, the invariants that watch them, and a clock."""

    def __init__(self, step_s: float, parts: Parts) -> None:
        """step_s: in which time passes. parts: what no two copies share."""
        self._step_s, self._parts = step_s, parts
        self._now = Moment(0)

    def copy(self) -> World:
        """Return a copy that shares what does not change."""
        return copy_of(self, self._parts)

    def take(self, event: Any) -> list[Violation]:
        """Let an event happen (a number: seconds pass); return the Violations."""
        if event == PASS or isinstance(event, float):
            self._now += self._step_s if event == PASS else event
            return []
        return [Violation(letter, self._now, what) for letter, what in self._happen(event)]

    def key(self) -> Any:
        """Return all that decides what follows."""
        raise NotImplementedError

    def _happen(self, event: Any) -> Iterable[tuple[str, str]]:
        """Let an event happen; yield the letter of each invariant that is violated, and how."""
        raise NotImplementedError


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

    start: a World. events: from a name to the argument of take(). Raises RuntimeError when the
    states do not end.
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
