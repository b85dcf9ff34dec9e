"""What Twists a program gave for which Joys, and how each field follows its axis. Pure."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass, field
from typing import Iterable, Mapping, NamedTuple, Sequence, Tuple

from ..task import AXES, HANDOUT, JoystickTask

Sample = Tuple[Sequence[float], Sequence[float]]  # (axes, six values of the Twist)

FIELDS = ("linear.x", "linear.y", "linear.z", "angular.x", "angular.y", "angular.z")
LINEAR, ANGULAR = 0, 5  # the two fields that a robot in the plane obeys
RIGHT = {LINEAR: 1, ANGULAR: 0}  # the axis that each of them follows
SMALL = 1e-4


class Rule(NamedTuple):
    """field = factor * axes[axis], of all samples."""

    axis: int
    factor: float


def is_near(one: float, other: float) -> bool:
    return abs(one - other) <= SMALL + 0.01 * abs(other)


def factor_of(values: Sequence[float], inputs: Sequence[float]) -> float | None:
    """Return the constant of proportion, or None. Values may be zero (dead zone), or at a limit."""
    pairs = [(value, given) for value, given in zip(values, inputs) if abs(given) > SMALL]
    moving = [(value, given) for value, given in pairs if abs(value) > SMALL]
    ratios = sorted((value / given for value, given in moving), key=abs)
    if len(ratios) < max(2, 0.5 * len(pairs)):
        return None
    limit = max(abs(value) for value, _ in pairs)
    dead_zone = min(abs(given) for _, given in moving)
    # Beyond a limit the ratio is less than the factor.
    for factor, enough in ((sorted(ratios)[len(ratios) // 2], 0.5 * len(pairs)), (ratios[-1], 3)):
        fits = limited = 0
        for value, given in pairs:
            wanted = factor * given
            if abs(value - wanted) <= 0.02 * abs(wanted) + SMALL:
                fits += 1
            elif abs(value) <= SMALL:
                limited += abs(given) < dead_zone
            else:
                at_limit = abs(abs(value) - limit) < SMALL and limit < abs(wanted)
                limited += at_limit and value * wanted > 0
        if fits + limited == len(pairs) and fits >= enough:
            return factor
    return None


def rule_of(index: int, samples: Sequence[Sample]) -> Rule | None:
    values = [twist[index] for _, twist in samples]
    for axis in range(AXES):
        factor = factor_of(values, [axes[axis] for axes, _ in samples])
        if factor is not None:
            return Rule(axis, factor)
    return None


@dataclass
class Evidence:
    """What a program answered; `again` to the same Joys sent earlier, `at_rest` to all axes at 0.

    factors: those that are asked for, by the index of the field; without one any is right.
    """

    samples: list[Sample]
    again: list[Sample] = field(default_factory=list)
    at_rest: Sequence[float] | None = None
    factors: Mapping[int, float] = field(default_factory=dict)
    task: JoystickTask = HANDOUT  # for the words

    def __post_init__(self) -> None:
        twists = [twist for _, twist in self.samples]
        self.rules = {index: rule_of(index, self.samples) for index in range(6)}
        self.moving = [i for i in range(6) if any(abs(twist[i]) > SMALL for twist in twists)]
        axes, rules = self.task.names.axes, self.rules.items()
        self.follows = {index: f"follows {axes[rule.axis]}" for index, rule in rules if rule}
        # What is said of each field that moves and should stay 0, by its index.
        strange = [index for index in self.moving if index not in RIGHT]
        self.strange = {i: f"{FIELDS[i]} {self.follows.get(i, 'is not 0')}" for i in strange}


class Field:
    """One field of the Twists, beside the axis that it should follow."""

    def __init__(self, evidence: Evidence, index: int, axis: int) -> None:
        self.evidence, self.index, self.name, self.axis = evidence, index, FIELDS[index], axis
        self.n_axis, self.just = evidence.task.names.axes[axis], evidence.task.answers.rules[axis]
        self.values = [twist[index] for _, twist in evidence.samples]
        self.given = [axes[axis] for axes, _ in evidence.samples]
        self.pairs = list(zip(self.given, self.values))
        self.at_rest = evidence.at_rest[index] if evidence.at_rest else 0.0
        self.rule, self.wanted = evidence.rules[index], evidence.factors.get(index)

    @property
    def is_right(self) -> bool:
        """Whether it is a positive constant times its axis, and the one that is asked for."""
        if not self.rule or self.rule.axis != self.axis or self.rule.factor <= 0:
            return False
        # Rounded to two decimals a factor is off by 0.005.
        return not self.wanted or abs(self.rule.factor / self.wanted - 1) < 0.02

    def is_axis_of(self, index: int) -> bool:
        """Return whether a field, this or another one, follows this one's axis."""
        rule = self.evidence.rules[index]
        return bool(rule and rule.axis == self.axis)

    @property
    def product(self) -> str:
        return self.evidence.task.product(self.rule.factor, self.axis) if self.rule else ""

    @property
    def other_answer(self) -> tuple[float, float] | None:
        """What the same Joy gave earlier and now, where that differs."""
        earlier = {tuple(axes): twist[self.index] for axes, twist in self.evidence.again}
        known = ((tuple(axes), twist[self.index]) for axes, twist in self.evidence.samples)
        both = ((earlier[axes], now) for axes, now in known if axes in earlier)
        return next((each for each in both if not is_near(*each)), None)

    @property
    def has_lost_its_sign(self) -> bool:
        """Return whether it grows with the axis to either side: abs(), or a square."""
        if factor_of(self.values, [*map(abs, self.given)]):
            return True
        values = [value for _, value in sorted((abs(given), value) for given, value in self.pairs)]
        varies = len({round(value, 6) for value in values}) > 0.6 * len(values)
        return values[0] > SMALL and _rises(values) and varies

    @property
    def mixture(self) -> str:
        """The two axes whose sum, or difference, it is, each with its factor; or empty."""
        samples = [(axes, twist[self.index]) for axes, twist in self.evidence.samples]
        order = sorted(range(AXES), key=lambda axis: axis != self.axis)
        for i, j in itertools.combinations(order if len(samples) > 3 else (), 2):
            (a, b, one), (c, d, other) = ((axes[i], axes[j], value) for axes, value in samples[:2])
            whole = a * d - b * c or math.inf
            p, q = (one * d - other * b) / whole, (other * a - one * c) / whole
            fits = all(abs(p * axes[i] + q * axes[j] - value) < 1e-3 for axes, value in samples)
            if fits and min(abs(p), abs(q)) > 0.05:
                product = self.evidence.task.product
                return f"{product(p, i)} + {product(q, j)}".replace("+ -", "- ")
        return ""

    @property
    def adds_up(self) -> bool:
        steps = [after - before for before, after in zip(self.values, self.values[1:])]
        if len(steps) < 3 or not self.given[-1]:
            return False
        factor = steps[-1] / self.given[-1]
        # Values that only change sign are nearly twice as much as those before.
        fits = (abs(step - factor * each) < 1e-3 for step, each in zip(steps, self.given[1:]))
        return abs(factor) > 1e-2 and all(fits)

    @property
    def side_left_out(self) -> str:
        for sign, side in ((1, "below"), (-1, "above")):
            rest = [value for given, value in self.pairs if sign * given < 0]
            pairs = sorted((abs(g), abs(value)) for g, value in self.pairs if sign * g > 0)
            if not any(rest) and _rises([value for _, value in pairs]):
                return side
        return ""

    @property
    def offset(self) -> str | None:
        offsets = [value - given for given, value in self.pairs]
        return f"{offsets[0]:.2f}" if max(offsets) - min(offsets) < 0.02 else None

    @property
    def steps(self) -> str:
        """Return the values if there are few for many positions; zero and a limit may be many."""
        found = {abs(given): abs(value) for given, value in self.pairs}.values()
        limit = max(found)
        between = [round(value, 6) for value in found if SMALL < value < limit - SMALL]
        limited = sum(value >= limit - SMALL for value in found)
        kinds = len(set(between))
        if kinds > 0.6 * len(between) or not limited + len(between) > 2 + kinds:
            return ""
        return ", ".join(f"{value:.2f}" for value in sorted({*between, round(limit, 6)})[:3])

    @property
    def is_curve(self) -> bool:
        values = [value for _, value in sorted(self.pairs)]
        signs = all(value * given >= -SMALL for given, value in self.pairs)
        return _rises(values) and signs and min(values[-1], -values[0]) > 0.05


def _rises(values: Sequence[float]) -> bool:
    return all(after >= before - SMALL for before, after in zip(values, values[1:]))


def no_number(samples: Iterable[Sample]) -> str:
    """Return what is said of a value that is infinite or no number; empty if all are numbers."""
    values = ((name, value) for _, twist in samples for name, value in zip(FIELDS, twist))
    odd = next((each for each in values if not math.isfinite(each[1])), None)
    return "{} is {}, which is no number".format(*odd) if odd else ""
