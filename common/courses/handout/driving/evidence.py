"""The Twists of a program for each Joy, and how each field follows its axis."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass, field
from typing import Iterable, Mapping, NamedTuple, Sequence, Tuple

from ..task import AXES, HANDOUT, JoystickTask

JoySample = Tuple[Sequence[float], Sequence[float]]  # (axes, six values of the Twist)

FIELDS = ("linear.x", "linear.y", "linear.z", "angular.x", "angular.y", "angular.z")
LINEAR, ANGULAR = 0, 5  # the two fields that move a robot in the plane
RIGHT = {LINEAR: 1, ANGULAR: 0}  # {field: the axis that it follows}
SMALL = 1e-4


class Rule(NamedTuple):
    """field = factor * axes[axis], in all samples."""

    axis: int
    factor: float


def is_near(value: float, other: float) -> bool:
    return abs(value - other) <= SMALL + 0.01 * abs(other)


def factor_of(values: Sequence[float], inputs: Sequence[float]) -> float | None:
    """Return the constant factor, or None. Values may be zero (dead zone), or at a limit."""
    pairs = [(value, given) for value, given in zip(values, inputs) if abs(given) > SMALL]
    moving = [(value, given) for value, given in pairs if abs(value) > SMALL]
    ratios = sorted((value / given for value, given in moving), key=abs)
    if len(ratios) < max(2, 0.5 * len(pairs)):
        return None
    limit = max(abs(value) for value, _ in pairs)
    dead_zone = min(abs(given) for _, given in moving)
    # Beyond a limit, the ratio is smaller than the factor.
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


def rule_of(index: int, samples: Sequence[JoySample]) -> Rule | None:
    values = [twist[index] for _, twist in samples]
    for axis in range(AXES):
        factor = factor_of(values, [axes[axis] for axes, _ in samples])
        if factor is not None:
            return Rule(axis, factor)
    return None


@dataclass
class Evidence:
    """A program's answers; `again`: to the same Joys earlier; `at_rest`: with all axes at 0.

    factors: {index of a field: the factor that the task demands}; if there is none, any is right.
    """

    samples: list[JoySample]
    again: list[JoySample] = field(default_factory=list)
    at_rest: Sequence[float] | None = None
    factors: Mapping[int, float] = field(default_factory=dict)
    task: JoystickTask = HANDOUT  # for names

    def __post_init__(self) -> None:
        twists = [twist for _, twist in self.samples]
        self.rules = {index: rule_of(index, self.samples) for index in range(6)}
        self.moving = [i for i in range(6) if any(abs(twist[i]) > SMALL for twist in twists)]
        self.strange = [index for index in self.moving if index not in RIGHT]  # should stay 0
        self.fields = [TwistField(self, index, axis) for index, axis in RIGHT.items()]

    @property
    def is_right(self) -> bool:
        """Whether all values are finite, both fields follow their axes, and the others stay 0."""
        if self.strange or no_number(self.samples):
            return False
        return all(field.is_followed for field in self.fields)


class TwistField:
    """A field of the Twists, and the axis that it should follow."""

    def __init__(self, evidence: Evidence, index: int, axis: int) -> None:
        self.evidence, self.index, self.name, self.axis = evidence, index, FIELDS[index], axis
        self.values = [twist[index] for _, twist in evidence.samples]
        self.given = [axes[axis] for axes, _ in evidence.samples]
        self.pairs = list(zip(self.given, self.values))
        self.at_rest = evidence.at_rest[index] if evidence.at_rest else 0.0
        self.rule, self.wanted = evidence.rules[index], evidence.factors.get(index)
        self.moves = index in evidence.moving

    @property
    def is_right(self) -> bool:
        """Whether it is its axis times a positive constant: the task's, if it names one."""
        factor = self.own_factor
        if factor is None or factor <= 0:
            return False
        # A factor rounded to two decimals is off by up to 0.005.
        return not self.wanted or abs(factor / self.wanted - 1) < 0.02

    @property
    def is_followed(self) -> bool:
        """Whether it is right, or, if any factor is right, a curve of its axis without faults."""
        if self.rule or self.wanted:
            return self.is_right
        oddities = (
            self.mixture, self.is_late, self.adds_up, self.other_answer, self.has_lost_its_sign,
            self.changes_sign, self.is_whole, self.offset is not None, self.moves_at_rest,
            self.steps,
        )  # fmt: skip
        return self.is_curve and not any(oddities)

    @property
    def own_factor(self) -> float | None:
        """The factor, if it follows its own axis."""
        return self.rule.factor if self.rule and self.rule.axis == self.axis else None

    @property
    def is_late(self) -> bool:
        """Whether it follows the previous Joy."""
        return factor_of(self.values[1:], self.given[:-1]) is not None

    @property
    def changes_sign(self) -> bool:
        """Whether it follows its axis, but with the sign of the other axis."""
        axes_sent = [axes for axes, _ in self.evidence.samples]
        signed = [axes[self.axis] * (1 if axes[1 - self.axis] >= 0 else -1) for axes in axes_sent]
        return factor_of(self.values, signed) is not None

    @property
    def is_whole(self) -> bool:
        return all(value == round(value) for value in self.values)

    @property
    def moves_at_rest(self) -> bool:
        return abs(self.at_rest) > SMALL

    @property
    def other_answer(self) -> tuple[float, float] | None:
        """Values for the same Joy (earlier, now) that differ."""
        earlier = {tuple(axes): twist[self.index] for axes, twist in self.evidence.again}
        known = ((tuple(axes), twist[self.index]) for axes, twist in self.evidence.samples)
        pairs = ((earlier[axes], now) for axes, now in known if axes in earlier)
        return next((pair for pair in pairs if not is_near(*pair)), None)

    @property
    def has_lost_its_sign(self) -> bool:
        """Whether it grows in both directions of the axis: abs(), or a square."""
        if factor_of(self.values, [*map(abs, self.given)]):
            return True
        values = [value for _, value in sorted((abs(given), value) for given, value in self.pairs)]
        varies = len({round(value, 6) for value in values}) > 0.6 * len(values)
        return values[0] > SMALL and _rises(values) and varies

    @property
    def mixture(self) -> tuple[Rule, Rule] | None:
        """The two axes whose weighted sum it is, with their factors."""
        samples = [(axes, twist[self.index]) for axes, twist in self.evidence.samples]
        order = sorted(range(AXES), key=lambda axis: axis != self.axis)
        for i, j in itertools.combinations(order if len(samples) > 3 else (), 2):
            (a, b, first), (c, d, second) = ((axes[i], axes[j], y) for axes, y in samples[:2])
            whole = a * d - b * c or math.inf
            p, q = (first * d - second * b) / whole, (second * a - first * c) / whole
            fits = all(abs(p * axes[i] + q * axes[j] - value) < 1e-3 for axes, value in samples)
            if fits and min(abs(p), abs(q)) > 0.05:
                return Rule(i, p), Rule(j, q)
        return None

    @property
    def adds_up(self) -> bool:
        steps = [after - before for before, after in zip(self.values, self.values[1:])]
        if len(steps) < 3 or not self.given[-1]:
            return False
        factor = steps[-1] / self.given[-1]
        # A change of sign alone is a step of nearly twice the value.
        fits = (abs(step - factor * axis) < 1e-3 for step, axis in zip(steps, self.given[1:]))
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
    def offset(self) -> float | None:
        offsets = [value - given for given, value in self.pairs]
        return offsets[0] if max(offsets) - min(offsets) < 0.02 else None

    @property
    def steps(self) -> list[float]:
        """The values, if many positions share few of them; zero and a limit do not count."""
        speeds = {abs(given): abs(value) for given, value in self.pairs}.values()
        limit = max(speeds)
        between = [round(value, 6) for value in speeds if SMALL < value < limit - SMALL]
        limited = sum(value >= limit - SMALL for value in speeds)
        kinds = len(set(between))
        if kinds > 0.6 * len(between) or not limited + len(between) > 2 + kinds:
            return []
        return sorted({*between, round(limit, 6)})

    @property
    def is_curve(self) -> bool:
        values = [value for _, value in sorted(self.pairs)]
        signs = all(value * given >= -SMALL for given, value in self.pairs)
        return _rises(values) and signs and min(values[-1], -values[0]) > 0.05


def _rises(values: Sequence[float]) -> bool:
    return all(after >= before - SMALL for before, after in zip(values, values[1:]))


def no_number(samples: Iterable[JoySample]) -> tuple[str, float] | None:
    """Return (field, value) of the first value that is infinite or not a number, or None."""
    values = ((name, value) for _, twist in samples for name, value in zip(FIELDS, twist))
    return next((pair for pair in values if not math.isfinite(pair[1])), None)
