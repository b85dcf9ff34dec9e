"""Which rule turns these Joys into these Twists? One row for each mistake that is known. Pure."""

from __future__ import annotations

from tutorial_check import Row, find

from .evidence import RIGHT, SMALL, Evidence, Field, factor_of, no_number

JUST = "{f.name} = {f.just}"
PRODUCT = "{f.name} = {f.product}"
# {axis: where the robot goes for a value above 0, and below it}
SIDES = {0: ("left", "right"), 1: ("forwards", "backwards")}
WRONG_SIGN = PRODUCT + ": the sign is wrong"
ONLY_THIS = "{f.name} comes from this Joy alone: no +=, no mean, nothing kept"
BEFORE = (
    Row(lambda e: no_number(e.samples), "{found}", "look at what it is calculated from"),
    Row(lambda e: not e.moving, "every Twist is zero",
        "are linear.x and angular.z of the message that is published set from data.axes?"),
    Row(lambda e: [e.rules[index] and e.rules[index].axis for index in RIGHT] == [0, 1],
        "angular.z follows {f.task.names.axes[1]} and linear.x {f.task.names.axes[0]}:"
        " they are swapped",
        "linear.x = {f.task.answers.rules[1]} (forwards),"
        " angular.z = {f.task.answers.rules[0]} (left)"),
)  # fmt: skip
# Of a field that is no positive constant times its axis, or not by the scale of the task (wanted).
# The first row that applies counts.
OF_A_FIELD = (
    Row(lambda f: f.is_axis_of(f.index) and f.rule.factor > 0, PRODUCT, JUST),
    Row(lambda f: f.is_axis_of(f.index) and f.wanted, WRONG_SIGN, JUST),
    Row(lambda f: f.is_axis_of(f.index) and SIDES[f.axis], WRONG_SIGN,
        "pushed {found[0]}, the robot goes {found[1]}: leave the minus out"),
    Row(lambda f: f.evidence.follows.get(f.index), "{f.name} {found}", JUST),
    Row(lambda f: f.index not in f.evidence.moving
        and [said for index, said in f.evidence.strange.items() if f.is_axis_of(index)],
        "{found[0]}, {f.name} stays 0",
        "a robot in the plane drives along x and turns about z: linear.x and angular.z"),
    Row(lambda f: f.index not in f.evidence.moving, "{f.name} is always 0", JUST),
    Row(lambda f: f.mixture, "{f.name} = {found}: two axes in one", JUST),
    Row(lambda f: factor_of(f.values[1:], f.given[:-1]),
        "{f.name} follows the Joy before: each Twist is one message late",
        "first put the values into the message, then publish it"),
    Row(lambda f: f.adds_up,
        "{f.name} depends on earlier Joys: it grows while the stick is held", ONLY_THIS),
    Row(lambda f: f.other_answer,
        "{f.name} depends on earlier Joys: the same Joy gives {found[0]:.2f} and {found[1]:.2f}",
        ONLY_THIS),
    Row(lambda f: f.has_lost_its_sign, "{f.name} has lost the sign of {f.n_axis}",
        JUST + ", without abs or a square"),
    Row(lambda f: factor_of(f.values, [axes[f.axis] * (1 if axes[1 - f.axis] >= 0 else -1)
                                       for axes, _ in f.evidence.samples])
        and f.evidence.task.names.axes[1 - f.axis],
        "{f.name} changes sign when {found} is negative", JUST + ", whatever the other axis is"),
    Row(lambda f: len({round(value, 6) for value in f.values}) == 1,
        "{f.name} is always {f.values[0]:.2f}", JUST),
    Row(lambda f: all(value == round(value) for value in f.values),
        "{f.name} has whole numbers only", JUST + ", without int() or round()"),
    Row(lambda f: f.side_left_out, "{f.name} is 0 wherever {f.n_axis} is {found} 0",
        JUST + ", of either sign"),
    Row(lambda f: f.offset,
        "{f.name} = {f.n_axis} + {found}: released, the robot still moves", JUST),
    Row(lambda f: abs(f.at_rest) > SMALL,
        "{f.name} is {f.at_rest:.2f} at rest, all axes 0: the robot never stands still", JUST),
    Row(lambda f: f.steps,
        "{f.name} has steps, as {found}: it does not follow {f.n_axis} between them",
        JUST + ", without round(), and not one speed for many positions"),
    Row(lambda f: not f.is_curve or f.wanted, "{f.name} is no constant times {f.n_axis}", JUST),
)  # fmt: skip
AFTER = (
    Row(lambda e: [*e.strange.values()], "{found[0]}",
        "only linear.x and angular.z move a robot in the plane; leave the others 0"),
)  # fmt: skip


def judge(evidence: Evidence) -> tuple[str, str]:
    """Return (complaint, hint), each empty if none; a hint without a complaint is a remark."""
    fields = [Field(evidence, index, axis) for index, axis in RIGHT.items()]
    odd = [find(OF_A_FIELD, each) for each in fields if not each.is_right]
    all_found = [find(BEFORE, evidence), *odd, find(AFTER, evidence)]
    found = next((each for each in all_found if each), None)
    if found:
        return found.seen, found.hint
    curves = [f.name for f in fields if f.rule is None]
    if curves:
        are = "are curves of their axes" if len(curves) > 1 else "is a curve of its axis"
        return "", f"{' and '.join(curves)} {are}, not a constant times it"
    scaled = (f for f in fields if f.rule and abs(f.rule.factor - 1) > 0.02 and not f.wanted)
    products = ", ".join(f"{f.name} = {f.product}" for f in scaled)
    return "", f"{products}; the handout's has no factor" if products else ""
