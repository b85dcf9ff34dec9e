"""Why a program in C++ sends no zero at Ctrl-C, and when it need not."""

from pathlib import Path
from types import SimpleNamespace

import pytest

from courses.handout.node_class.checks import DrivingEnd, no_zero, still_running
from courses.handout.node_class.class_text import CPP_DIAGNOSES, ClassProgram, program
from courses.handout.node_class.lack_of_zero import lack_of_zero
from courses.handout.node_class.record import CTRL_C, KILL, LAUNCH, End
from tutorial_check.checking.results import must_pass
from tutorial_check.submission import cpp_tree
from tutorial_check.submission.cpp_facts import CppFacts
from tutorial_testing.claims import claim

pytestmark = claim("What no program ...", because="the end of a class in C++")
CLASS = """class Node
{
public:
  void stop() { pub_.publish(geometry_msgs::Twist()); }
  ros::Publisher pub_;
  ros::NodeHandle handle_;
};
"""
MAIN = """Node* robot;
void onCtrlC(int) { robot->stop(); ros::shutdown(); }
int main(int argc, char** argv)
{
  ros::init(argc, argv, "node", ros::init_options::NoSigintHandler);
  Node node;
  robot = &node;
  signal(SIGINT, onCtrlC);
  ros::spin();
}
"""
HANDLER = "  signal(SIGINT, onCtrlC);\n"
OWN = ", ros::init_options::NoSigintHandler"


def facts(*changes):
    text = CLASS + MAIN
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    return CppFacts({"src/node.cpp": text})


def program_of(text_facts):
    path = "src/node.cpp"
    return ClassProgram(path, path, text_facts.classes[0], {path: text_facts})


@pytest.mark.parametrize(("changes", "line", "words"), [
    ([("robot->stop(); ros::shutdown();", "ros::shutdown(); robot->stop();")], 9, "first the zero"),
    ([(HANDLER, ""), (OWN, ""), ("  Node node;", f"{HANDLER}  Node node;")], 13, "replaces this"),
    ([(HANDLER, ""), (OWN, ""), ("spin();", "spin();\n  node.stop();")], 16, "after ros::spin()"),
    ([(HANDLER, ""), (OWN, ""), ("void stop", "~Node")], 4, "in the destructor"),
    ([(HANDLER, "")], 12, "signal(SIGINT, onCtrlC)"),
    ([("  robot = &node;\n", "")], 8, "points to no object"),
    ([("robot->stop(); ", "")], 9, "onCtrlC has to publish"),
    ([], 4, "all zero"),
    ([(HANDLER, ""), (OWN, "")], 12, ""),
])  # fmt: skip
def test_the_cause_and_its_line(changes, line, words):
    at, hint = lack_of_zero(facts(*changes))
    assert at == line and words in hint


@pytest.mark.parametrize(("way", "is_wrong"), [(CTRL_C, True), (LAUNCH, True), (KILL, False)])
def test_roscpp_leaves_no_time_for_a_zero_after_rosnode_kill(way, is_wrong):
    made = program_of(facts((HANDLER, ""), (OWN, "")))
    silent = End(zero_after_s=None, in_time=True, took_s=0.2, after_zero=0, output="")
    wrong = no_zero(DrivingEnd(None, made, way, silent))
    assert bool(wrong) == is_wrong
    if wrong:
        assert wrong.where == "src/node.cpp:12" and "NoSigintHandler" in wrong.hint


def test_a_handler_that_ends_nothing():
    made = program_of(facts((" ros::shutdown();", "")))
    driving = End(zero_after_s=0.1, in_time=True, took_s=None, after_zero=90, output="")
    wrong = still_running(DrivingEnd(None, made, CTRL_C, driving))
    assert wrong.where == "src/node.cpp:15" and "ros::shutdown()" in wrong.hint


def test_without_a_parser_the_name_of_the_program_decides(monkeypatch):
    monkeypatch.setattr(cpp_tree, "_parser", lambda: None)
    programs = {"src/joy2twist.cpp": facts(), "src/new_joy2twist.cpp": facts()}
    package = SimpleNamespace(folder=Path())
    submission = SimpleNamespace(programs=lambda _: programs, package=lambda _: package)
    made = program(submission)
    assert (made.script, made.at(made.node.line)) == (("src/new_joy2twist.cpp",) * 2)
    assert must_pass(CPP_DIAGNOSES, made) is None
