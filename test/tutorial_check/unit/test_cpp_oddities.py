"""What C++ accepts and a node does not survive is seen in its source, and nothing else is."""

from dataclasses import replace

import pytest

from tutorial_check.submission.cpp_facts import CppFacts
from tutorial_check.submission.oddities import LostSubscriber, OddIndex, Oddities
from tutorial_testing.claims import claim

HEAD = "#include <ros/ros.h>\nros::Publisher pub;\nstruct Node { Node(); ros::Subscriber sub_; };\n"
MAIN = "int main() {\n  ros::NodeHandle n;\n  %s\n  ros::spin();\n}\n"
SUBSCRIBE = 'n.subscribe("/joy", 1, heard)'


def oddities_of(text):
    return CppFacts({"src/node.cpp": HEAD + text}).oddities


@claim("A diagnosis knows lines of C++ that compile and fail: objects that end, private topics")
@pytest.mark.parametrize(
    ("text", "name", "oddity"),
    [
        (f"void f() {{\n  {SUBSCRIBE};\n}}", "lost_subscriber", LostSubscriber(5, "", "", False)),
        (f"void f() {{\n  ros::Subscriber s = {SUBSCRIBE};\n}}", "lost_subscriber",
            LostSubscriber(5, "s", "f()", False)),
        (f"Node::Node() {{ ros::Subscriber sub_ = {SUBSCRIBE}; }}", "lost_subscriber",
            LostSubscriber(4, "sub_", "Node()", True)),
        (MAIN % f"{{ auto s = {SUBSCRIBE}; }}", "lost_subscriber",
            LostSubscriber(6, "s", "its block", False)),
        (MAIN % 'ros::Publisher pub = n.advertise<T>("/t", 1);', "hidden_publisher", (6, "pub")),
        ("void f() {\n  pub.publish(t);\n}", "unmade_publisher", (5, "pub")),
        (MAIN % "Node node();", "function_declared", (6, "Node node();")),
        ('ros::NodeHandle own("~");\nauto p = own.advertise<T>("t", 1);', "private",
            (("Publisher", 4),)),
        ('Node::Node() : n_("~") { sub_ = n_.subscribe("t", 1, f); }', "private",
            (("Subscriber", 4),)),
        ("float half = 1 / 2 * x;", "whole_division", (4, "1 / 2")),
        ("void f() { int speed = joy->axes[1]; }", "whole_axis", (4, "speed")),
        ("void f() { t.linear.x = (int) joy->axes[1]; }", "whole_axis", (4, "int")),
        ("void f() { x = joy->axes[6] + joy->buttons.at(12); }", "indices",
            (OddIndex(4, "axes", 6), OddIndex(4, "buttons", 12))),
        ("ros::Publisher* out;\nvoid f() { out->publish(t); }", "unset_pointer", (5, "out")),
        ("T::ConstPtr last;\nvoid f(T::ConstPtr m) { last = m; last->x; }\nvoid g() { last->x; }",
            "unset_pointer", (6, "last")),
        ("T::Ptr twist;\nvoid f() { twist->linear.x = 1; }", "unset_pointer", (5, "twist")),
    ],
)  # fmt: skip
def test_an_oddity_has_its_line(text, name, oddity):
    assert getattr(oddities_of(text), name) == oddity


@pytest.mark.parametrize(
    "text",
    [
        MAIN % f"ros::Subscriber s = {SUBSCRIBE};",
        f"void f() {{ static ros::Subscriber s = {SUBSCRIBE}; }}",
        f"void f() {{ auto s = {SUBSCRIBE}; ros::spin(); }}",
        f"void f() {{ auto s = {SUBSCRIBE}; kept.push_back(s); }}",
        f"ros::Subscriber f() {{ return {SUBSCRIBE}; }}",
        "message_filters::Subscriber<T> s;\nvoid f() { s.subscribe(n, topic, 1); }",
        MAIN % 'pub = n.advertise<T>("/t", 1);\n  Node node;',
        'ros::NodeHandle own("~");\nauto p = own.advertise<T>("/t", 1);',
        'ros::NodeHandle own("~"), n;\nauto p = n.advertise<T>("t", 1);',
        "float half = 1.0 / 2 + 4 / 2;",
        "void f() { int button = joy->buttons[1]; float x = joy->axes[1]; }",
        "Out* out;\nvoid f() { out->send(t); }\nvoid g() { out = new Out; }",
        "void f(const T::ConstPtr& joy) { joy->axes; }",
    ],
)
def test_what_is_right_is_no_oddity(text):
    assert replace(oddities_of(text), indices=()) == Oddities()
