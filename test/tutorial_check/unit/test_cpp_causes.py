"""Why a program in C++ fails or receives nothing is found in its source."""

import pytest

from tutorial_check.checking.cpp_causes import cause_of_abort, never_calls_back, unsubscribed
from tutorial_check.submission.cpp_facts import CppFacts
from tutorial_check.submission.python_facts import PythonFacts
from tutorial_testing.claims import claim

SUBSCRIBE = 'ros::Subscriber s = n.subscribe("/joy", 1, heard);'
ADVERTISE = 'p = n.advertise<T>("t", 1);'
INVALID = "Call to publish() on an invalid Publisher"
BEYOND = "Assertion '__n < this->size()' failed."


def facts_of(text):
    return CppFacts({"src/node.cpp": text})


@claim(
    "A program in C++ that receives nothing is explained: a Subscriber that ends, an object that "
    "is a function or never made, a spin that comes first, a loop without spinOnce"
)
@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        (f"void f() {{\n  {SUBSCRIBE}\n}}", 2, "s ends with f()"),
        ('void f() {\n  n.subscribe("/joy", 1, heard);\n}', 2, "is not kept"),
        ("class A { ros::Subscriber s; };\nint main() {\n  A a();\n}", 3, "declares a function"),
        ("class A { ros::Subscriber s; };\nint main() { ros::spin(); }", 1, "no A is ever made"),
        (f"int main() {{\n  ros::spin();\n  {SUBSCRIBE}\n}}", 3, "comes before it"),
    ],
)
def test_why_nothing_is_subscribed(text, line, words):
    cause = unsubscribed(facts_of(text))
    assert cause.line == line
    assert words in cause.seen


def test_a_right_program_has_no_cause():
    facts = facts_of(f"int main() {{ {SUBSCRIBE} ros::spin(); }}")
    assert not unsubscribed(facts)
    assert not never_calls_back(facts)


def test_a_loop_never_calls_back():
    text = f"int main() {{\n  {SUBSCRIBE}\n  while (ros::ok()) rate.sleep();\n}}"
    assert never_calls_back(facts_of(text)).line == 3
    assert not never_calls_back(PythonFacts("x()"))


@claim("A crash in C++ has the line of its cause: which pointer, Publisher or index it is")
@pytest.mark.parametrize(
    ("error", "text", "line", "words"),
    [
        (INVALID, f"ros::Publisher p;\nint main() {{\n  ros::Publisher {ADVERTISE}\n}}", 3,
            "is a second p"),
        (INVALID, "ros::Publisher p;\nvoid f() { p.publish(t); }", 2, "no advertise"),
        (INVALID, f"void f() {{ q.publish(t); }}\nint main() {{ {ADVERTISE} }}", 1,
            "no advertise makes q"),
        (INVALID, f"void f() {{ p.publish(t); }}\nint main() {{\n{SUBSCRIBE}\n{ADVERTISE} }}", 3,
            "below line 4"),
        ("Trying to publish message of type [a]", 'int main() {\n  n.advertise<T>("t", 1);\n}',
            2, "advertise<TYPE>"),
        (BEYOND, "void f() {\n  a = joy->axes[5];\n  b = joy->axes[6];\n}", 3, "axes[6]"),
        ("std::out_of_range: vector", "void f() { joy->buttons.at(12); }", 1, "buttons[12]"),
        (BEYOND, "void f() { joy->axes[i]; }", 0, ""),
        ("SIGSEGV", "T* t;\nvoid f() { t->x = 1; }", 2, "t is a pointer, and points"),
        ("SIGSEGV", "void f() {}", 0, ""),
    ],
)  # fmt: skip
def test_a_crash_has_the_line_of_its_cause(error, text, line, words):
    place, hint = cause_of_abort(error, facts_of(text))
    assert place == line
    assert words in hint
