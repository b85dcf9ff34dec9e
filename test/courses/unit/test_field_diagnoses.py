"""From pairs of Joy and Twist to the rule in words, where no program of exercises/ shows it."""

import pytest

from courses.handout.driving.evidence import Evidence
from courses.handout.driving.field_diagnoses import rule_verdict
from courses.handout.driving.joys import (
    delays,
    displayed,
    numbered_joys,
    probes,
    small_and_button_probes,
    values_displayed,
)
from courses.handout.driving.probe_diagnoses import probe_verdict
from courses.handout.driving.replies import Replies
from tutorial_check import Note, Wrong
from tutorial_testing.claims import claim

pytestmark = claim(
    "Axes, factors, curves, steps and numbers that are none are named from pairs of Joy and Twist"
)
JOYS = numbered_joys(20)
AXES = [axes for axes, _ in JOYS]
NAN, INF = float("nan"), float("inf")


def evidence(text):
    """Evidence of a program that answers Joys; text: its linear.x, angular.z and linear.y."""
    convert = eval(f"lambda a: ({text})")
    values = [(axes, (*convert(axes), 0.0)) for axes in AXES]
    return Evidence([(axes, (x, y, 0.0, 0.0, 0.0, z)) for axes, (x, z, y, *_) in values])


@pytest.mark.parametrize(("text", "wrong", "remark"), [
    ("a[1], a[0]", "", ""),
    ("0.5 * a[1], 2.0 * a[0]", "", "linear.x = 0.50 * axes[1], angular.z = 2.00 * axes[0]"),
    ("a[1] if a[1] > 0 else 0.5 * a[1], a[0]", "", "linear.x is a curve"),
    ("max(0.0, a[1]) ** 2, a[0]", "linear.x is 0 wherever axes[1] is below", ""),
    ("round(a[1], 1), a[0]", "linear.x has steps, as 0.30, 0.40, 0.50", ""),
    ("a[1] - 0.5 * a[3], a[0]", "linear.x = 1.00 * axes[1] - 0.50 * axes[3]: two axes", ""),
    ("a[1], 0.0, a[0]", "linear.y follows axes[0], angular.z stays 0", ""),
    ("a[1], -INF if a[0] < 0 else a[0]", "angular.z is -inf, which is no number", ""),
])  # fmt: skip
def test_the_rule_is_found_and_named(text, wrong, remark):
    verdict = rule_verdict(evidence(text))
    kind = Wrong if wrong else Note if remark else type(None)
    assert isinstance(verdict, kind)
    assert verdict is None or (wrong or remark) in verdict.seen
    # The recorder sends probes to a program with a right rule, without asking for a diagnosis.
    assert evidence(text).is_right == (not wrong)


@pytest.mark.parametrize(("text", "wrong"), [
    ("a[1], a[0]", ""),
    ("a[1], a[0] or 0.3", "angular.z is 0.30 when axes[0] is 0.00"),
    ("a[1] if a[0] else 0.0, a[0]", "linear.x is 0 when axes[1] alone is moved"),
    ("a[1] if abs(a[1]) > 0.03 else NAN, a[0]", "linear.x is nan"),
    ("a[1] if b[4] else 0.0, a[0]", "the robot drives with LB released"),
])  # fmt: skip
def test_the_recorder_and_the_diagnoses_of_probes_agree(text, wrong):
    convert = eval(f"lambda a, b: ({text})", {"NAN": NAN})
    answers = []
    for axes, buttons in [*probes(JOYS), *small_and_button_probes()]:
        x, z = convert(axes, buttons)
        answers.append(((axes, buttons), (x, 0.0, 0.0, 0.0, 0.0, z)))
    replies = Replies(evidence("a[1], a[0]"), answers, "b[4]" in text)
    verdict = probe_verdict(replies)
    assert (wrong in verdict.seen) if wrong else verdict is None
    assert replies.is_right == (not wrong)


@pytest.mark.parametrize(("sent", "received", "factor", "found"), [
    ([1.0, 1.1], [(1.0, NAN), (1.0, INF), (1.5, 0.3)], 1.0, [0.5]),  # NaN answers no Joy
    ([1.0, 3.0], [(1.1, 0.305)], 1.0, []),  # the value of a later Joy
    ([1.0, 2.0], [(1.5, 0.01), (2.25, 0.02)], None, [0.5, 0.25]),
])  # fmt: skip
def test_which_twist_answers_which_joy(sent, received, factor, found):
    assert delays(sent, [(when, "", (value, 0.0)) for when, value in received], factor) == found


@pytest.mark.parametrize(
    ("shape", "count"),
    [("{1:.2f}", 1), ("{0:.2f} {5:.3f}", 2), ("nothing of it", 0), (6 * "{:.2f}\n", 1)],
)
def test_how_many_values_are_shown(shape, count):
    lines = [f"[INFO] [1700000000.1]: 0.5 /listener: {shape.format(*axes)}" for axes in AXES]
    assert values_displayed(JOYS, "\n".join(lines)) == count


@claim("All six values in one line, with two decimals, count as displayed")
@pytest.mark.parametrize("shape", ["[" + "{:.2f}," * 6 + "]", "{:.4f} " * 6 + "buttons 0 1"])
def test_joys_on_one_line_each_are_displayed(shape):
    lines = [f"[INFO] [1700000000.1]: /listener: {shape.format(*axes)}" for axes in AXES[3:9]]
    text = "\n".join(lines)
    assert displayed(JOYS, text) == JOYS[3:9]
    assert displayed(JOYS, text.replace(",", "\n").replace(" ", "\n")) == []
