"""What the text of a program in C++ shows of its end: handlers of Ctrl-C, and what comes late."""

import pytest

from tutorial_check.submission.cpp_facts import CppFacts
from tutorial_testing.claims import claim

pytestmark = claim(
    "The checker reads from C++ how a program ends: its handler of Ctrl-C, and a zero that "
    "comes when roscpp has closed the topics"
)
CLASS = """#include <ros/ros.h>
class Node
{
public:
  void stop() { sub_.shutdown(); pub_.publish(geometry_msgs::Twist()); }
  ros::NodeHandle handle_;
};
Node* robot = nullptr;
void onCtrlC(int)
{
  robot->stop();
  ros::shutdown();
}
"""
MAIN = """int main(int argc, char** argv)
{
  ros::init(argc, argv, "node", ros::init_options::NoSigintHandler);
  Node node;
  robot = &node;
  signal(SIGINT, onCtrlC);
  ros::spin();
}
"""
STRUCT = """  struct sigaction action;
  action.sa_handler = onCtrlC;
  sigaction(SIGINT, &action, NULL);
"""


def facts(old="", new="", text=CLASS + MAIN):
    assert old in text
    return CppFacts({"a.cpp": text.replace(old, new)})


def test_a_handler_that_stops_the_robot():
    right = facts()
    assert right.ending.own_sigint == 16
    assert not (right.ending.late or right.ending.shutdown_first or right.ending.unset_pointer)
    assert [(call.line, call.words) for call in right.calls["on_shutdown"]] == [(19, ["onCtrlC"])]
    called = right.called_by("on_shutdown", 0)
    # Subscriber::shutdown is another function.
    assert (called["publish"], called["signal_shutdown"], called["shutdown"]) == ([5], [12], [5])


@pytest.mark.parametrize("installed", [
    STRUCT, "  std::signal(SIGINT, &onCtrlC);\n",
    "  signal(SIGINT, [](int) { robot->stop(); ros::shutdown(); });\n",
])  # fmt: skip
def test_ways_to_install_a_handler(installed):
    called = facts("  signal(SIGINT, onCtrlC);\n", installed).called_by("on_shutdown", 0)
    assert {"publish", "signal_shutdown"} <= called.keys()
    assert "on_shutdown" not in facts("SIGINT", "SIGUSR1").calls


@pytest.mark.parametrize(("old", "new", "name", "line"), [
    ("  robot->stop();\n  ros::shutdown();\n", "  ros::shutdown();\n  robot->stop();\n",
        "shutdown_first", 11),
    ("  robot->stop();\n", "  ros::Duration(1).sleep();\n  robot->stop();\n", "sleep_first", 11),
    ("{ sub_.shutdown();", "{ ros::shutdown();", "shutdown_first", 5),
    ("  robot = &node;\n", "", "unset_pointer", 8),
    ("  Node node;\n  robot = &node;\n  signal(SIGINT, onCtrlC);\n",
        "  signal(SIGINT, onCtrlC);\n  Node node;\n  robot = &node;\n", "replaced", 17),
    ("  ros::spin();\n", "  ros::spin();\n  robot->stop();\n", "late", 21),
    ("  ros::spin();\n", "  while (ros::ok())\n    ros::spinOnce();\n  node.stop();\n", "late", 22),
    ("  void stop()", "  ~Node()", "late", 5),
])  # fmt: skip
def test_what_keeps_the_zero_from_the_robot(old, new, name, line):
    assert not getattr(facts().ending, name)
    assert getattr(facts(old, new).ending, name) == line


@claim("The checker reads from C++ ...", because="the classes that a program makes")
@pytest.mark.parametrize(("made", "is_made"), [
    ("Node node;", True), ("Node node{};", True), ("Node node(handle);", True),
    ("Node* node = new Node;", True), ("auto node = std::make_shared<Node>();", True),
    ("Node node = Node();", True), ("Node node();", False), ("Node();", False), ("", False),
])  # fmt: skip
def test_an_object_that_lasts(made, is_made):
    program = facts("  Node node;\n  robot = &node;\n", f"  {made}\n")
    (node,) = program.classes
    assert (node.name, node.is_node, node.instantiated) == ("Node", True, is_made)
    assert node.unmade == ((17, made) if made and not is_made else ())


def test_an_object_without_a_name_lasts_if_its_constructor_spins():
    spins = ("  void stop()", "  Node() { ros::spin(); }\n  void stop()")
    text = (CLASS + MAIN).replace(*spins).replace("  Node node;\n  robot = &node;\n", "  Node();\n")
    assert [node.instantiated for node in CppFacts({"a.cpp": text}).classes] == [True]


def test_a_class_in_a_header_is_made_in_main():
    program = CppFacts({"main.cpp": MAIN, "node.h": CLASS})
    assert [(node.name, node.instantiated) for node in program.classes] == [("Node", True)]


def test_publishers_outside_of_the_class_are_globals():
    assert not facts().globals
    assert facts("Node* robot", "ros::Publisher pub;\nNode* robot").globals == [8]
