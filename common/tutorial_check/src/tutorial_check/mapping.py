"""Which rule turns these joysticks into these velocities? Pure."""

import math
from dataclasses import dataclass

FIELDS = ("linear.x", "linear.y", "linear.z", "angular.x", "angular.y", "angular.z")
LINEAR, ANGULAR = 0, 5  # the two fields that a robot in the plane obeys
RIGHT = {LINEAR: 1, ANGULAR: 0}  # the axis that each of them follows
SMALL = 1e-4
AXES = 6


@dataclass(frozen=True)
class Rule:
    """field = factor * axes[axis], of all samples."""

    axis: int
    factor: float


def factor_of(values, inputs):
    """The constant of proportion, or None. Zeros (dead zone) and a limit may be among the values."""
    pairs = [(value, given) for value, given in zip(values, inputs) if abs(given) > SMALL]
    moving = [(value, given) for value, given in pairs if abs(value) > SMALL]
    ratios = sorted(value / given for value, given in moving)
    if len(ratios) < max(2, 0.5 * len(pairs)):
        return None
    factor = ratios[len(ratios) // 2]
    limit = max(abs(value) for value, _ in pairs)
    dead_zone = min(abs(given) for _, given in moving)
    fits = limited = 0
    for value, given in pairs:
        if abs(value - factor * given) <= 0.02 * abs(factor * given) + SMALL:
            fits += 1
        elif (abs(value) <= SMALL and abs(given) < dead_zone) or (
            abs(abs(value) - limit) < SMALL
            and value * factor * given > 0
            and limit < abs(factor * given)
        ):
            limited += 1
    return factor if fits + limited == len(pairs) and fits >= 0.5 * len(pairs) else None


def rule_of(field, samples):
    """The Rule that a field follows, or None. samples: [(axes, six values)]."""
    values = [twist[field] for _, twist in samples]
    for axis in range(AXES):
        factor = factor_of(values, [axes[axis] for axes, _ in samples])
        if factor is not None:
            return Rule(axis, factor)
    return None


def is_monotone(field, axis, samples):
    """Whether the field grows with the axis and has its sign: a curve, as for a dead zone."""
    pairs = sorted((axes[axis], twist[field]) for axes, twist in samples)
    rises = all(b[1] >= a[1] - SMALL for a, b in zip(pairs, pairs[1:]))
    signs = all(value * given >= -SMALL for given, value in pairs)
    return rises and signs and min(pairs[-1][1], -pairs[0][1]) > 0.05


def judge(samples):
    """(complaint, hint) about samples [(axes, six values)], each empty if there is none.

    A complaint without a hint does not occur; a hint without a complaint is a remark.
    """
    odd = no_number(samples)
    if odd:
        return odd
    rules = {field: rule_of(field, samples) for field in range(6)}
    moving = [field for field in range(6) if any(abs(twist[field]) > SMALL for _, twist in samples)]
    if not moving:
        return (
            "every Twist is zero",
            "are linear.x and angular.z of the message that is published set from data.axes?",
        )
    for field, axis in RIGHT.items():
        rule = rules[field]
        other = ANGULAR if field == LINEAR else LINEAR
        if rule and rule.axis == axis and rule.factor > 0:
            continue
        if rule and rule.axis == axis:
            way = "backwards" if field == LINEAR else "right"
            return (
                f"{FIELDS[field]} = {rule.factor:.2f} * axes[{axis}]: the sign is wrong",
                f"pushed {'forwards' if field == LINEAR else 'left'}, the robot goes {way}: leave the minus out",
            )
        if rule and rules[other] and rule.axis == RIGHT[other] and rules[other].axis == axis:
            return (
                "angular.z follows axes[1] and linear.x axes[0]: they are swapped",
                "linear.x = axes[1] (forwards), angular.z = axes[0] (left)",
            )
        if rule:
            return (
                f"{FIELDS[field]} follows axes[{rule.axis}]",
                f"{FIELDS[field]} = axes[{axis}]",
            )
        misplaced = next(
            (f for f in moving if f not in RIGHT and rules[f] and rules[f].axis == axis), None
        )
        if field not in moving and misplaced is not None:
            return (
                f"{FIELDS[misplaced]} follows axes[{axis}], {FIELDS[field]} stays 0",
                "a robot in the plane drives along x and turns about z: linear.x and angular.z",
            )
        if field not in moving:
            return (f"{FIELDS[field]} is always 0", f"{FIELDS[field]} = axes[{axis}]")
        complaint = _explain_odd(field, axis, samples)
        if complaint:
            return complaint
    extra = [field for field in moving if field not in RIGHT]
    if extra:
        rule = rules[extra[0]]
        what = (
            f"{FIELDS[extra[0]]} follows axes[{rule.axis}]"
            if rule
            else f"{FIELDS[extra[0]]} is not 0"
        )
        return what, "only linear.x and angular.z move a robot in the plane; leave the others 0"
    curves = [FIELDS[field] for field in RIGHT if rules[field] is None]
    if curves:
        return "", f"{' and '.join(curves)} is a curve of its axis, not a constant times it"
    scaled = [
        f"{FIELDS[field]} = {rules[field].factor:.2f} * axes[{axis}]"
        for field, axis in RIGHT.items()
        if abs(rules[field].factor - 1) > 0.02
    ]
    return "", f"{', '.join(scaled)}; the handout's has no factor" if scaled else ""


def _steps(values):
    """The values as text if there are few of them for many positions; zero and a limit may be many."""
    limit = max(map(abs, values))
    between = [round(abs(value), 6) for value in values if SMALL < abs(value) < limit - SMALL]
    limited = sum(abs(value) >= limit - SMALL for value in values)
    if len(set(between)) > 0.6 * len(between) or not limited + len(between) > 2 + len(set(between)):
        return ""
    return ", ".join(f"{value:.2f}" for value in sorted({*between, round(limit, 6)})[:3])


def no_number(samples):
    """The complaint about a value that is infinite or no number, or None."""
    for _, twist in samples:
        for name, value in zip(FIELDS, twist):
            if not math.isfinite(value):
                return (
                    f"{name} is {value}, which is no number",
                    "look at what it is calculated from",
                )
    return None


def _explain_odd(field, axis, samples):
    """A complaint about a field that follows no axis by a constant; None if it is a mere curve."""
    values = [twist[field] for _, twist in samples]
    given = [axes[axis] for axes, _ in samples]
    name = FIELDS[field]
    if factor_of(values, [abs(value) for value in given]):
        return f"{name} has lost the sign of axes[{axis}]", f"{name} = axes[{axis}], without abs"
    if factor_of(values[1:], given[:-1]):
        return (
            f"{name} follows the Joy before: each Twist is one message late",
            "first put the values into the message, then publish it",
        )
    for sign, side in ((1, "below"), (-1, "above")):
        rest = [value for value, each in zip(values, given) if sign * each < 0]
        if not any(rest) and factor_of(values, [max(0.0, sign * each) for each in given]):
            return (
                f"{name} is 0 wherever axes[{axis}] is {side} 0",
                f"{name} = axes[{axis}], of either sign",
            )
    offsets = [value - each for value, each in zip(values, given)]
    if max(offsets) - min(offsets) < 0.02:
        return (
            f"{name} = axes[{axis}] + {offsets[0]:.2f}: released, the robot still moves",
            f"{name} = axes[{axis}]",
        )
    if all(value == round(value) for value in values):
        return f"{name} has whole numbers only", f"{name} = axes[{axis}], without int() or round()"
    if len({round(value, 6) for value in values}) == 1:
        return f"{name} is always {values[0]:.2f}", f"{name} = axes[{axis}]"
    steps = _steps(values)
    if steps:
        return (
            f"{name} has steps, as {steps}: it does not follow axes[{axis}] between them",
            f"{name} = axes[{axis}], without round(), and not one speed for many positions",
        )
    if is_monotone(field, axis, samples):
        return None
    return f"{name} is no constant times axes[{axis}]", f"{name} = axes[{axis}]"
