"""Expressions in fields of forms: what they compute, and that a hostile one is one line at once."""

import math
import time

import pytest
import rospy
from roslib.message import get_message_class

from cockpit_server.expressions import LONGEST
from cockpit_server.ros.tabs import forms
from cockpit_server.tabs.form_values import MOST_FIELDS
from tutorial_testing.claims import claim

pytestmark = claim(
    "A numeric field is a number or an expression of i, time() and functions of math; a hostile "
    "one is one line, takes no time, and runs nothing"
)
NOW_S, AT_ONCE_S = 7.5, 0.1


@pytest.fixture
def filled(monkeypatch):
    """A function that fills a field of the 12th message of a type, at NOW_S."""
    monkeypatch.setattr(forms.rospy.Time, "now", lambda: rospy.Time(NOW_S))
    return lambda kind, text, name="data": forms.filled(get_message_class(kind), {name: text}, 12)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("sin(i / 10)", math.sin(1.2)), ("i", 12), (" -2 ** 2 + i % 5 - 7 // 2 ", -5), ("+i", 12),
        ("2 * pi * time()", 15 * math.pi), ("min(i, 3) + abs(-1) + round(2.6)", 7), ("3 * 2", 6),
        ("hypot(3, 4) + floor(0.5) + e - e", 5), ("0 * random() + 0 * uniform(1, 2)", 0),
    ],
)  # fmt: skip
def test_expression_has_the_names_of_rqt_publisher(filled, text, value):
    assert filled("std_msgs/Float64", text).data == pytest.approx(value)


def test_integers_drop_the_fraction_arrays_take_lists_and_texts_stay_texts(filled):
    assert filled("std_msgs/Int8", "-i / 5").data == -2
    assert filled("std_msgs/Bool", "i % 5 // 2").data == 1
    assert filled("std_msgs/Float64MultiArray", "[i / 8, -cos(0)]").data == [1.5, -1]
    assert filled("sensor_msgs/Joy", "[i % 2, 1]", "buttons").buttons == [0, 1]
    assert filled("std_msgs/String", "sin(i)").data == "sin(i)"
    assert filled("std_msgs/Time", "now").data == rospy.Time(NOW_S)
    with pytest.raises(ValueError, match=r"^data: time must be JSON"):
        filled("std_msgs/Time", "i")


@pytest.mark.parametrize(
    "text",
    [
        "9**9**9", "9.0**9**9**9", "3999999**3999999", "'a'*9**9", "[0]*9**9", "factorial(9**9)",
        "().__class__", "i.real", "__import__('os')", "open('/etc/passwd')", "sin.__self__", "i[0]",
        "[i for i in range(9)]", "(lambda: i)()", "(i := 3)", "f'{i}'", "i if i else 0", "i < 3",
        "max(*[1])", "print(1)", "sin", "i(1)", "sin()", "j", "1j", "None", "", "1 +", "1; 2", "\0",
        "1 / 0", "-inf", "2e999 * i", "1e308 * 10", "exp(999)", "log(0)", "sqrt(-1)", "(-8) ** 0.5",
        "(" * LONGEST, "-" * LONGEST + "1", "1+" * LONGEST + "1", "[" * 99 + "i" + "]" * 99,
        "1<<9**9", "\ud800",
    ],
)  # fmt: skip
@pytest.mark.parametrize("kind", ["Float64", "Int32", "Float64MultiArray"])
def test_hostile_expression_is_one_line_at_once(filled, kind, text, capsys):
    began_s = time.thread_time()
    with pytest.raises(ValueError, match=r"^data: \S+ must be a number, or an expr[^\n]{5,250}$"):
        filled(f"std_msgs/{kind}", text)
    assert time.thread_time() - began_s < AT_ONCE_S
    assert capsys.readouterr() == ("", "")


def test_the_longest_form_of_expressions_takes_no_time():
    kind = get_message_class("nav_msgs/Odometry")
    texts = {name: ("-" * LONGEST + "i")[-LONGEST:] for name, _ in forms.form_fields(kind)}
    texts = {name: text for name, text in texts.items() if name.endswith(("x", "y", "z", "w"))}
    assert 10 < len(texts) < MOST_FIELDS
    began_s = time.thread_time()
    forms.form_values.field_values(kind, texts, 1, NOW_S)
    assert time.thread_time() - began_s < AT_ONCE_S
