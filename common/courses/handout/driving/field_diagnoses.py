"""Diagnoses of the rule that turns Joys into Twists, one for each known mistake.

A Wrong has what was seen and a hint; the check adds what was expected, and where.
"""

from __future__ import annotations

from tutorial_check import Note, Wrong, first_of

from ..task import JoystickTask
from .evidence import ANGULAR, FIELDS, LINEAR, Evidence, JoySample, TwistField, no_number

# {axis: direction of the robot for a positive value, and for a negative one}
SIDES = {0: ("left", "right"), 1: ("forwards", "backwards")}


def not_a_number(samples: list[JoySample]) -> Wrong | None:
    odd = no_number(samples)
    if odd is None:
        return None
    seen = f"{odd[0]} is {odd[1]}, which is no number"
    return Wrong("", seen, hint="look at what it is calculated from")


def all_zero(evidence: Evidence) -> Wrong | None:
    if evidence.moving:
        return None
    hint = "are linear.x and angular.z of the message that is published set from the axes?"
    return Wrong("", "every Twist is zero", hint=hint)


def axes_swapped(evidence: Evidence) -> Wrong | None:
    linear, angular = evidence.rules[LINEAR], evidence.rules[ANGULAR]
    if not linear or not angular or (linear.axis, angular.axis) != (0, 1):
        return None
    axes, rules = evidence.task.names.axes, evidence.task.answers.rules
    seen = f"angular.z follows {axes[1]} and linear.x {axes[0]}: they are swapped"
    return Wrong("", seen, hint=f"linear.x = {rules[1]} (forwards), angular.z = {rules[0]} (left)")


def other_field_moves(evidence: Evidence) -> Wrong | None:
    if not evidence.strange:
        return None
    hint = "only linear.x and angular.z move a robot in the plane; leave the others 0"
    return Wrong("", _strange(evidence, evidence.strange[0]), hint=hint)


def another_factor(field: TwistField) -> Wrong | None:
    is_positive = (field.own_factor or 0.0) > 0
    return _odd(field, f"= {_product(field)}") if is_positive else None


def wrong_sign(field: TwistField) -> Wrong | None:
    if field.own_factor is None:
        return None
    above, below = SIDES[field.axis]
    hint = f"pushed {above}, the robot goes {below}: leave the minus out"
    hint = _rule(field) if field.wanted else hint
    return _odd(field, f"= {_product(field)}: the sign is wrong", hint)


def another_axis(field: TwistField) -> Wrong | None:
    return _odd(field, _followed(field.evidence, field.index)) if field.rule else None


def another_field_follows(field: TwistField) -> Wrong | None:
    evidence = field.evidence
    followed = {index: rule.axis for index, rule in evidence.rules.items() if rule}
    others = [index for index in evidence.strange if followed.get(index) == field.axis]
    if field.moves or not others:
        return None
    hint = "a robot in the plane drives along x and turns about z: linear.x and angular.z"
    return Wrong("", f"{_strange(evidence, others[0])}, {field.name} stays 0", hint=hint)


def always_zero(field: TwistField) -> Wrong | None:
    return None if field.moves else _odd(field, "is always 0")


def two_axes_in_one(field: TwistField) -> Wrong | None:
    if not field.mixture:
        return None
    products = (_task(field).product(rule.factor, rule.axis) for rule in field.mixture)
    mixture = " + ".join(products).replace("+ -", "- ")
    return _odd(field, f"= {mixture}: two axes in one")


def one_message_late(field: TwistField) -> Wrong | None:
    hint = "first put the values into the message, then publish it"
    seen = "follows the previous Joy: each Twist is one message late"
    return _odd(field, seen, hint) if field.is_late else None


def adds_up(field: TwistField) -> Wrong | None:
    seen = "depends on earlier Joys: it grows while the stick is held"
    return _odd(field, seen, only_this_joy(field.name)) if field.adds_up else None


def another_answer(field: TwistField) -> Wrong | None:
    if not field.other_answer:
        return None
    earlier, now = field.other_answer
    seen = f"depends on earlier Joys: the same Joy gives {earlier:.2f} and {now:.2f}"
    return _odd(field, seen, only_this_joy(field.name))


def sign_lost(field: TwistField) -> Wrong | None:
    hint = f"{_rule(field)}, without abs or a square"
    seen = f"has lost the sign of {_axis(field)}"
    return _odd(field, seen, hint) if field.has_lost_its_sign else None


def sign_of_the_other_axis(field: TwistField) -> Wrong | None:
    other = _task(field).names.axes[1 - field.axis]
    hint = f"{_rule(field)}, whatever the other axis is"
    seen = f"changes sign when {other} is negative"
    return _odd(field, seen, hint) if field.changes_sign else None


def always_the_same(field: TwistField) -> Wrong | None:
    is_constant = len({round(value, 6) for value in field.values}) == 1
    return _odd(field, f"is always {field.values[0]:.2f}") if is_constant else None


def whole_numbers(field: TwistField) -> Wrong | None:
    hint = f"{_rule(field)}, without int() or round()"
    return _odd(field, "has whole numbers only", hint) if field.is_whole else None


def one_side_left_out(field: TwistField) -> Wrong | None:
    side = field.side_left_out
    hint = f"{_rule(field)}, of either sign"
    return _odd(field, f"is 0 wherever {_axis(field)} is {side} 0", hint) if side else None


def offset_added(field: TwistField) -> Wrong | None:
    if field.offset is None:
        return None
    return _odd(field, f"= {_axis(field)} + {field.offset:.2f}: released, the robot still moves")


def moves_at_rest(field: TwistField) -> Wrong | None:
    seen = f"is {field.at_rest:.2f} at rest, all axes 0: the robot never stands still"
    return _odd(field, seen) if field.moves_at_rest else None


def steps(field: TwistField) -> Wrong | None:
    values = ", ".join(f"{value:.2f}" for value in field.steps[:3])
    seen = f"has steps, as {values}: it does not follow {_axis(field)} between them"
    hint = f"{_rule(field)}, without round(), and not one speed for many positions"
    return _odd(field, seen, hint) if values else None


def no_constant_factor(field: TwistField) -> Wrong | None:
    is_right = field.is_curve and not field.wanted
    return None if is_right else _odd(field, f"is not a constant times {_axis(field)}")


# For a field that is no positive constant times its axis, or has another factor than the task's.
OF_A_FIELD = (
    another_factor, wrong_sign, another_axis, another_field_follows, always_zero, two_axes_in_one,
    one_message_late, adds_up, another_answer, sign_lost, sign_of_the_other_axis, always_the_same,
    whole_numbers, one_side_left_out, offset_added, moves_at_rest, steps, no_constant_factor,
)  # fmt: skip


def rule_verdict(evidence: Evidence) -> Wrong | Note | None:
    """Return the Wrong for the answers, or, if any factor is right, a Note on factor or curve."""
    wrong = not_a_number(evidence.samples) or first_of((all_zero, axes_swapped), evidence)
    wrongs = (first_of(OF_A_FIELD, field) for field in evidence.fields if not field.is_right)
    wrong = wrong or next(filter(None, wrongs), None) or other_field_moves(evidence)
    return wrong or first_of((curves, factors), evidence)


def curves(evidence: Evidence) -> Note | None:
    names = [field.name for field in evidence.fields if field.rule is None]
    are = "are curves of their axes" if len(names) > 1 else "is a curve of its axis"
    return Note(f"{' and '.join(names)} {are}, not a constant times it") if names else None


def factors(evidence: Evidence) -> Note | None:
    free = [field for field in evidence.fields if not field.wanted]
    scaled = [field for field in free if abs((field.own_factor or 1.0) - 1) > 0.02]
    products = ", ".join(f"{field.name} = {_product(field)}" for field in scaled)
    return Note(f"{products}; the handout's has no factor") if products else None


def only_this_joy(name: str) -> str:
    return f"{name} comes from this Joy alone: no +=, no mean, nothing kept"


def _odd(field: TwistField, seen: str, hint: str = "") -> Wrong:
    return Wrong("", f"{field.name} {seen}", hint=hint or _rule(field))


def _task(field: TwistField) -> JoystickTask:
    return field.evidence.task


def _axis(field: TwistField) -> str:
    return _task(field).names.axes[field.axis]


def _rule(field: TwistField) -> str:
    return f"{field.name} = {_task(field).answers.rules[field.axis]}"


def _product(field: TwistField) -> str:
    return _task(field).product(field.own_factor or 0.0, field.axis)


def _followed(evidence: Evidence, index: int) -> str:
    rule = evidence.rules[index]
    return f"follows {evidence.task.names.axes[rule.axis]}" if rule else "is not 0"


def _strange(evidence: Evidence, index: int) -> str:
    return f"{FIELDS[index]} {_followed(evidence, index)}"
