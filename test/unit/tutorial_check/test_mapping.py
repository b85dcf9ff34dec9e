"""From pairs of Joy and Twist to the rule, in words."""

import pytest

from tutorial_check.exercises.driving import _delays as delays
from tutorial_check.mapping import judge, numbered_joys

AXES = [axes for axes, _ in numbered_joys(20)]


def samples(linear, angular, extra=None):
    return [
        (a, (linear(a), (extra or (lambda a: 0.0))(a), 0.0, 0.0, 0.0, angular(a))) for a in AXES
    ]


def test_no_two_joys_are_alike_and_lb_is_held():
    joys = numbered_joys(20)
    assert len({axes for axes, _ in joys}) == 20
    assert all(buttons[4] == 1 and sum(buttons) == 1 for _, buttons in joys)
    for axes in AXES:
        assert len({round(abs(axis), 2) for axis in axes}) == 6
    assert {(a[0] > 0, a[1] > 0) for a in AXES} == {
        (p, q) for p in (True, False) for q in (True, False)
    }


@pytest.mark.parametrize(
    "linear, angular",
    [
        (lambda a: a[1], lambda a: a[0]),
        (lambda a: a[1] if abs(a[1]) > 0.35 else 0.0, lambda a: a[0]),
        (lambda a: max(-0.5, min(0.5, a[1])), lambda a: a[0]),
    ],
)
def test_right(linear, angular):
    assert judge(samples(linear, angular)) == ("", "")


def test_a_factor_is_a_remark():
    complaint, remark = judge(samples(lambda a: 0.5 * a[1], lambda a: 2.0 * a[0]))
    assert not complaint
    assert remark.startswith("linear.x = 0.50 * axes[1], angular.z = 2.00 * axes[0]")


def test_a_curve_is_a_remark():
    complaint, remark = judge(samples(lambda a: a[1] ** 3, lambda a: a[0]))
    assert not complaint
    assert "linear.x" in remark


def test_slower_backwards_is_a_remark():
    complaint, remark = judge(samples(lambda a: a[1] if a[1] > 0 else 0.5 * a[1], lambda a: a[0]))
    assert not complaint
    assert "linear.x is a curve" in remark


@pytest.mark.parametrize(
    "linear, angular, word",
    [
        (lambda a: a[0], lambda a: a[1], "swapped"),
        (lambda a: a[1], lambda a: -a[0], "angular.z = -1.00 * axes[0]"),
        (lambda a: -a[1], lambda a: a[0], "linear.x = -1.00 * axes[1]"),
        (lambda a: a[2], lambda a: a[0], "axes[2]"),
        (lambda a: 0.0, lambda a: a[0], "linear.x is always 0"),
        (lambda a: 0.0, lambda a: 0.0, "every Twist is zero"),
        (lambda a: abs(a[1]), lambda a: a[0], "lost the sign"),
        (lambda a: max(0.0, a[1]), lambda a: a[0], "linear.x is 0 wherever axes[1] is below 0"),
        (lambda a: a[1], lambda a: min(0.0, a[0]), "angular.z is 0 wherever axes[0] is above 0"),
        (lambda a: max(0.0, a[1]) ** 2, lambda a: a[0], "no constant"),
        (lambda a: float(int(3 * a[1])), lambda a: a[0], "whole numbers"),
        (lambda a: a[1] + 0.1, lambda a: a[0], "+ 0.10"),
        (lambda a: a[1] + a[0], lambda a: a[0], "no constant"),
    ],
)
def test_wrong(linear, angular, word):
    complaint, hint = judge(samples(linear, angular))
    assert word in complaint
    assert hint


@pytest.mark.parametrize("value", ["nan", "inf", "-inf"])
def test_what_is_no_number(value):
    odd = samples(lambda a: a[1], lambda a: float(value) if a[0] < 0 else a[0])
    complaint, hint = judge(odd)
    assert complaint == f"angular.z is {value}, which is no number"
    assert hint


def test_what_is_no_number_answers_no_joy():
    heard = [(1.0, "", (float(value), 0.0)) for value in ("nan", "inf")]
    heard.append((1.5, "", (0.3, 0.0)))
    assert delays([1.0, 1.1], heard, 1.0) == [0.5]


def test_the_wrong_field():
    complaint, _ = judge(samples(lambda a: a[1], lambda a: 0.0, lambda a: a[0]))
    assert complaint == "linear.y follows axes[0], angular.z stays 0"


def test_a_field_too_many():
    complaint, _ = judge(samples(lambda a: a[1], lambda a: a[0], lambda a: a[0]))
    assert complaint == "linear.y follows axes[0]"


def test_one_message_late():
    right = samples(lambda a: a[1], lambda a: a[0])
    late = [(axes, before[1]) for (axes, _), before in zip(right[1:], right)]
    assert "message late" in judge(late)[0]
