"""From pairs of Joy and Twist to the rule, in words."""

import pytest

from tutorial_check.mapping import Evidence
from tutorial_check.mapping import judge as judge_evidence
from tutorial_check.probing import (
    delays,
    judge_probes,
    low_joys,
    numbered_joys,
    probes,
    silence,
    small_and_button_probes,
)

AXES = [axes for axes, _ in numbered_joys(20)]


def judge(samples, again=(), at_rest=None):
    return judge_evidence(Evidence(samples, list(again), at_rest))


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


@pytest.mark.parametrize("limit", [0.12, 0.22, 0.3])
def test_a_low_limit_is_right(limit):
    axes = [*AXES, *(axes for axes, _ in low_joys())]
    assert judge([(a, (max(-limit, min(limit, a[1])), 0, 0, 0, 0, a[0])) for a in axes]) == ("", "")


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
        (lambda a: max(0.0, a[1]) ** 2, lambda a: a[0], "linear.x is 0 wherever axes[1] is below"),
        (lambda a: a[1] ** 2, lambda a: a[0], "lost the sign"),
        (lambda a: float(int(a[1])), lambda a: float(int(a[0])), "linear.x has whole numbers only"),
        (lambda a: a[1], lambda a: float(int(a[0])), "angular.z has whole numbers only"),
        (
            lambda a: a[1],
            lambda a: a[0] if a[1] > 0 else -a[0],
            "angular.z changes sign when axes[1] is",
        ),
        (lambda a: float(int(3 * a[1])), lambda a: a[0], "whole numbers"),
        (lambda a: a[1] + 0.1, lambda a: a[0], "+ 0.10"),
        (lambda a: a[1] + a[0], lambda a: a[0], "no constant"),
        (lambda a: round(a[1], 1), lambda a: a[0], "linear.x has steps, as 0.30, 0.40, 0.50"),
        (lambda a: a[1], lambda a: int(10 * a[0]) / 10, "angular.z has steps, as 0.20"),
        (lambda a: 0.7 if a[1] > 0 else -0.7, lambda a: a[0], "linear.x has steps, as 0.70"),
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


def test_an_answer_is_not_older_than_its_joy():
    """Of a value that by chance belongs to a Joy yet to come."""
    assert delays([1.0, 3.0], [(1.1, "", (0.305, 0.0))], 1.0) == []


def test_where_each_joy_is_answered_no_factor_is_needed():
    assert delays([1.0, 2.0], [(1.5, "", (0.01,)), (2.25, "", (0.02,))], None) == [0.5, 0.25]


class Converter:
    """A program that keeps its last Twist; axes and buttons to (linear.x, angular.z)."""

    def __init__(self, convert):
        self.x = self.z = 0.0
        self._convert = convert

    def __call__(self, joy):
        self.x, self.z = self._convert(self, *joy)
        return (self.x, 0.0, 0.0, 0.0, 0.0, self.z)


def cruise(button, lets_go=False):
    """Keep the speed of when a button was pressed; lets_go: until it is pressed at rest."""
    kept = [0.0]

    def convert(_, axes, buttons):
        if buttons[button]:
            kept[0] = axes[1] if axes[1] or lets_go else kept[0]
        return kept[0] or axes[1], axes[0]

    return convert


def faster(button):
    """A factor that grows with each Joy for which a button is pressed."""
    scale = [1.0]

    def convert(_, axes, buttons):
        scale[0] *= 1.1 if buttons[button] else 1.0
        return scale[0] * axes[1], axes[0]

    return convert


def complaint_of(convert):
    """What judge and judge_probes say of all that a check sends."""
    program, joys = Converter(convert), numbered_joys(20)
    numbered = [(axes, program((axes, buttons))) for axes, buttons in joys]
    assert not judge(numbered)[0]
    sent = [*probes(joys), *small_and_button_probes()]
    return judge_probes(numbered, [(joy, program(joy)) for joy in sent])[0]


@pytest.mark.parametrize(
    "convert",
    [
        lambda my, a, b: (a[1], a[0]),
        lambda my, a, b: (a[1] if abs(a[1]) > 0.35 else 0.0, 0.5 * a[0]),
        lambda my, a, b: (max(-0.5, min(0.5, a[1])), a[0]),
        lambda my, a, b: (a[1] ** 3, a[0]),
        lambda my, a, b: (b[4] * a[1], b[4] * a[0]),
        lambda my, a, b: ((1.0 if b[4] else 0.5) * a[1], a[0]),
        lambda my, a, b: ((2.0 if b[5] else 0.3 if b[7] else 1.0) * a[1], a[0]),
        lambda my, a, b: (0.0, 0.0) if b[1] else (a[1], a[0]),
        lambda my, a, b: (a[1] if abs(a[1]) > 0.02 else 0.0, a[0] if abs(a[0]) > 0.1 else 0.0),
        lambda my, a, b: (round(0.5 * a[1], 2), round(0.5 * a[0], 2)),
    ],
)
def test_right_whatever_came_before(convert):
    assert complaint_of(convert) == ""


@pytest.mark.parametrize(
    ("convert", "words"),
    [
        (lambda my, a, b: (a[1] or my.x, a[0]), "linear.x stays 0.70 when axes[1] is 0.00"),
        (lambda my, a, b: (a[1], a[0] if abs(a[0]) > 0.1 else my.z), "angular.z stays 0.60"),
        (lambda my, a, b: (a[1], a[0]) if b[4] else (my.x, my.z), "and LB released"),
        (lambda my, a, b: (a[1], a[0]) if a[1] else (0.0, 0.0), "axes[0] alone"),
        (lambda my, a, b: (a[1] if any(a) else float("nan"), a[0]), "linear.x is nan"),
        (lambda my, a, b: (a[1] * (1 + (my.x > 0.69)), a[0]), "linear.x depends on earlier Joys"),
        (
            lambda my, a, b: (a[1] if abs(a[1]) > 0.1 or a[1] == 0 else my.x, a[0]),
            "linear.x stays 0.70 when axes[1] is 0.06",
        ),
        (
            lambda my, a, b: (a[1] if abs(a[1] - my.x) > 0.05 else my.x, a[0]),
            "linear.x stays 0.06 when axes[1] is 0.03",
        ),
        (
            lambda my, a, b: (a[1] if abs(a[1] - my.x) > 0.2 else my.x, a[0]),
            "depends on earlier Joys",
        ),
        (cruise(0), "linear.x stays 0.70 when axes[1] is 0.00 and buttons[0] pressed"),
        (cruise(5, lets_go=True), "linear.x stays -0.70 when axes[1] is 0.00"),
        (faster(5), "the same Joy gives linear.x = 0.70 and, once buttons[5] was pressed, 0.93"),
    ],
)
def test_wrong_by_what_came_before(convert, words):
    assert words in complaint_of(convert)


def test_silence_is_named():
    joys = numbered_joys(20)
    rest = ((0.0,) * 6, joys[0][1])
    released = (joys[0][0], (0,) * 12)
    assert "at rest" in silence(rest, joys[0])[0]
    assert "the same Joy again" in silence(joys[0], joys[0])[0]
    stop = (joys[0][0], (0, 1, 0, 0, 1, *(0,) * 7))
    assert "buttons[1] pressed: the robot drives on" in silence(stop, joys[0])[0]
    assert "LB released" in silence(released, joys[0])[0]
    again = (joys[1][0], (0,) * 12)
    assert "LB released" in silence(again, released, (0.3,))[0]
    assert "only one zero after LB is released" in silence(again, released, (0.0,))[0]
    assert "with axes[1] = 0" in silence(((0.5, *rest[0][1:]), joys[0][1]), joys[0])[0]


def twice(convert):
    """What is said of a program that is asked the same Joys twice, and then one at rest."""
    program = Converter(convert)
    first, again = ([(a, program((a, ()))) for a in AXES] for _ in range(2))
    return judge(again, first, program(((0.0,) * 6, ())))[0]


@pytest.mark.parametrize(
    ("convert", "words"),
    [
        (lambda my, a, b: (my.x + a[1], my.z + a[0]), "linear.x depends on earlier Joys: it grows"),
        (lambda my, a, b: (my.x + 0.1 * a[1], a[0]), "linear.x depends on earlier Joys: it grows"),
        (lambda my, a, b: (0.8 * my.x + 0.2 * a[1], a[0]), "linear.x depends on earlier Joys: the"),
        (lambda my, a, b: (a[1], 0.5 * (my.z + a[0])), "angular.z depends on earlier Joys: the"),
        (lambda my, a, b: (max(0.2, a[1]), a[0]), "linear.x is 0.20 at rest, all axes 0"),
        (lambda my, a, b: (a[1], max(a[0], -0.1) + 0.3), "angular.z is 0.30 at rest"),
    ],
)
def test_what_a_second_pass_and_rest_show(convert, words):
    assert words in twice(convert)


@pytest.mark.parametrize(
    ("curves", "words"), [(1, "linear.x is a curve of"), (2, "linear.x and angular.z are curves")]
)
def test_curves_in_plain_english(curves, words):
    _, remark = judge(samples(lambda a: a[1] ** 3, lambda a: a[0] ** 3 if curves == 2 else a[0]))
    assert remark.startswith(words)


def test_the_wrong_field():
    complaint, _ = judge(samples(lambda a: a[1], lambda a: 0.0, lambda a: a[0]))
    assert complaint == "linear.y follows axes[0], angular.z stays 0"


def test_a_field_too_many():
    complaint, _ = judge(samples(lambda a: a[1], lambda a: a[0], lambda a: a[0]))
    assert complaint == "linear.y follows axes[0]"


@pytest.mark.parametrize("count", [1, 2, 3])
def test_few_samples_are_judged(count):
    assert judge(samples(lambda a: a[1] + a[0], lambda a: a[0])[:count])[0]


def test_one_message_late():
    right = samples(lambda a: a[1], lambda a: a[0])
    late = [(axes, before[1]) for (axes, _), before in zip(right[1:], right)]
    assert "message late" in judge(late)[0]
