"""From pairs of Joy and Twist to the rule, in words."""

from types import SimpleNamespace

import pytest

from tutorial_check.exercises.mapping import Evidence, judge
from tutorial_check.exercises.probing import (
    delays,
    displayed,
    judge_probes,
    low_joys,
    numbered_joys,
    probes,
    silence,
    small_and_button_probes,
    values_shown,
)

JOYS = numbered_joys(20)
AXES = [axes for axes, _ in JOYS]
NAN, INF = float("nan"), float("inf")


def program(text):
    """Return a program that answers linear.x and angular.z of my last answer, axes, buttons."""
    convert = text if callable(text) else eval(f"lambda my, a, b: ({text})")
    my = SimpleNamespace(x=0.0, z=0.0)

    def answer(axes, buttons=()):
        my.x, my.z, *linear_y = convert(my, axes, buttons)
        return (my.x, *(linear_y or [0.0]), 0.0, 0.0, 0.0, my.z)

    return answer


def samples(text, joys=JOYS):
    return [(axes, answer(axes)) for answer in [program(text)] for axes, _ in joys]


def test_no_two_joys_are_alike_and_lb_is_held():
    assert len(set(AXES)) == 20
    assert all(buttons[4] == 1 and sum(buttons) == 1 for _, buttons in JOYS)
    assert all(len({round(abs(axis), 2) for axis in axes}) == 6 for axes in AXES)
    assert len({(a[0] > 0, a[1] > 0) for a in AXES}) == 4


@pytest.mark.parametrize(
    ("text", "complaint", "remark"),
    [
        ("0.5 * a[1], 2.0 * a[0]", "", "linear.x = 0.50 * axes[1], angular.z = 2.00 * axes[0]"),
        ("a[1] ** 3, a[0]", "", "linear.x is a curve of"),
        ("a[1] if a[1] > 0 else 0.5 * a[1], a[0]", "", "linear.x is a curve"),
        ("a[1], min(0.0, a[0])", "angular.z is 0 wherever axes[0] is above 0", ""),
        ("max(0.0, a[1]) ** 2, a[0]", "linear.x is 0 wherever axes[1] is below", ""),
        ("round(a[1], 1), a[0]", "linear.x has steps, as 0.30, 0.40, 0.50", ""),
        ("0.7 if a[1] > 0 else -0.7, a[0]", "linear.x has steps, as 0.70", ""),
        ("a[1] - 0.5 * a[3], a[0]", "linear.x = 1.00 * axes[1] - 0.50 * axes[3]: two axes", ""),
        ("a[1], a[5] + a[2]", "angular.z = 1.00 * axes[2] + 1.00 * axes[5]: two axes", ""),
        ("a[1], 0.0, a[0]", "linear.y follows axes[0], angular.z stays 0", ""),
        ("a[1], -INF if a[0] < 0 else a[0]", "angular.z is -inf, which is no number", ""),
    ],
)
def test_judge(text, complaint, remark):
    found, hint = judge(Evidence(samples(text)))
    assert complaint in found and bool(found) == bool(complaint)
    assert hint.startswith(remark) and hint


@pytest.mark.parametrize("limit", [0.12, 0.22, 0.3])
def test_a_low_limit_is_right(limit):
    answers = samples(f"max(-{limit}, min({limit}, a[1])), a[0]", [*JOYS, *low_joys()])
    assert judge(Evidence(answers)) == ("", "")


@pytest.mark.parametrize("count", [1, 2])
def test_few_samples_are_judged(count):
    assert judge(Evidence(samples("a[1] + a[0], a[0]", JOYS[:count])))[0]


@pytest.mark.parametrize(
    ("sent", "heard", "factor", "found"),
    [
        ([1.0, 1.1], [(1.0, NAN), (1.0, INF), (1.5, 0.3)], 1.0, [0.5]),  # no number answers no Joy
        ([1.0, 3.0], [(1.1, 0.305)], 1.0, []),  # the value of a Joy yet to come
        ([1.0, 2.0], [(1.5, 0.01), (2.25, 0.02)], None, [0.5, 0.25]),
    ],
)
def test_delays(sent, heard, factor, found):
    assert delays(sent, [(when, "", (value, 0.0)) for when, value in heard], factor) == found


def cruise(button, lets_go=False):
    """Keep the speed of when a button was pressed; lets_go: until it is pressed at rest."""
    kept = [0.0]

    def convert(_, axes, buttons):
        if buttons[button]:
            kept[0] = axes[1] if axes[1] or lets_go else kept[0]
        return kept[0] or axes[1], axes[0]

    return convert


@pytest.mark.parametrize(
    ("convert", "words"),
    [
        ("(1.0 if b[4] else 0.5) * a[1], a[0]", ""),
        ("(2.0 if b[5] else 0.3 if b[7] else 1.0) * a[1], a[0]", ""),
        ("a[1] if abs(a[1]) > 0.02 else 0.0, a[0] if abs(a[0]) > 0.1 else 0.0", ""),
        ("round(0.5 * a[1], 2), round(0.5 * a[0], 2)", ""),
        ("a[1] if any(a) else NAN, a[0]", "linear.x is nan"),
        ("a[1] * (1 + (my.x > 0.69)), a[0]", "linear.x depends on earlier Joys"),
        ("a[1] if abs(a[1] - my.x) > 0.05 else my.x, a[0]", "x stays 0.06 when axes[1] is 0.03"),
        (cruise(0), "linear.x stays 0.70 when axes[1] is 0.00 and buttons[0] pressed"),
        (cruise(5, lets_go=True), "linear.x stays -0.70 when axes[1] is 0.00"),
    ],
)  # fmt: skip
def test_what_came_before_does_not_matter(convert, words):
    answer = program(convert)
    numbered = [(axes, answer(axes, buttons)) for axes, buttons in JOYS]
    assert not judge(Evidence(numbered))[0]
    sent = [*probes(JOYS), *small_and_button_probes()]
    complaint = judge_probes(numbered, [(joy, answer(*joy)) for joy in sent])[0]
    assert words in complaint and bool(words) == bool(complaint)


def test_silence_when_one_axis_alone_is_moved_is_named():
    (axes, held), alone = JOYS[0], (0.5, *(0.0,) * 5)
    assert "with axes[1] = 0" in silence((alone, held), (axes, held), (0.3,))[0]


@pytest.mark.parametrize(
    ("shape", "count"),
    [("{1:.2f}", 1), ("{0:.2f} {5:.3f}", 2), ("nothing of it", 0), (6 * "{:.2f}\n", 1)],
)
def test_how_many_values_are_shown(shape, count):
    lines = [f"[INFO] [1700000000.1]: 0.5 /listener: {shape.format(*axes)}" for axes in AXES]
    assert values_shown(JOYS, "\n".join(lines)) == count


@pytest.mark.parametrize("shape", ["[" + "{:.2f}," * 6 + "]", "{:.4f} " * 6 + "buttons 0 1"])
def test_displayed(shape):
    lines = [f"[INFO] [1700000000.1]: /listener: {shape.format(*axes)}" for axes in AXES[3:9]]
    text = "\n".join(lines)
    assert displayed(JOYS, text) == JOYS[3:9]
    assert displayed(JOYS, text.replace(",", "\n").replace(" ", "\n")) == []
