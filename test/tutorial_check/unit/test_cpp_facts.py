"""Facts from a program in C++, by rospy's names."""

import pytest

from tutorial_check.submission.cpp_facts import CppFacts, message_of
from tutorial_check.submission.cpp_tree import below, parsed
from tutorial_testing.claims import claim

NODE = """\
#include <ros/ros.h>
#include "drive.h"
void heard(const std_msgs::String::ConstPtr& message) { show(*message); }
void show(const std_msgs::String& text) { ROS_INFO_STREAM_THROTTLE(1, text.data); }
int main(int argc, char** argv)
{
  ros::init(argc, argv, "listener", ros::init_options::AnonymousName);
  ros::NodeHandle n;
  ros::Publisher pub = n.advertise<geometry_msgs::Twist>("/cmd_vel", 5, true);
  ros::Subscriber sub = n.subscribe("chatter", 10, heard);
  ros::Rate rate(10);
  while (ros::ok())
  {
    pub.publish(geometry_msgs::Twist());
    ros::spinOnce();
    rate.sleep();
  }
}
"""


def facts_of(text):
    return CppFacts({"src/node.cpp": text})


@claim("A program in C++ has the facts of one in Python: calls, topics, types, queues, callbacks")
def test_the_calls_of_a_node():
    facts = facts_of(NODE)
    init, publisher, subscriber = map(facts.first, ("init_node", "Publisher", "Subscriber"))
    assert (init.line, init.words, init.names) == (7, ["listener"], {"anonymous": "True"})
    assert (publisher.line, publisher.words) == (9, ["/cmd_vel", "Twist"])
    assert publisher.names == {"queue_size": "5", "latch": "True"}
    assert (subscriber.line, subscriber.words) == (10, ["chatter", "String", "heard"])
    assert facts.first("Rate").words == ["10"]
    assert facts.lines("is_shutdown", "publish", "spinOnce", "sleep") == [12, 14, 15, 16]
    assert facts.loops == [12]
    assert facts.publishing_loops == [14]
    assert facts.called_back == {"show": [3], "loginfo_throttle": [4]}
    assert facts.imports == {"ros/ros.h", "drive.h"}
    assert facts.functions == {"heard": 3, "show": 4, "main": 5}
    assert facts.has_main


@pytest.mark.parametrize("odd", ["\ufeff", "// Empf\ufffdnger\n", "#define NAME \\\n  3\n", "\r"])
def test_a_mark_or_a_comment_of_an_editor_moves_no_line(odd):
    text = f"{odd}{NODE}".replace("\n", "\r\n")
    assert facts_of(text).first("init_node").line == 7 + odd.count("\n")
    assert facts_of(text).imports == {"ros/ros.h", "drive.h"}


@claim("A line of C++ is named in its own file, also of a program of several")
def test_a_line_is_in_its_own_file():
    header = "#pragma once\nclass Drive { ros::NodeHandle n; void spin() { ros::spin(); } };"
    facts = CppFacts({"src/node.cpp": NODE, "include/p/drive.h": header})
    (line,) = facts.lines("spin")
    assert facts.place("src/node.cpp", line) == "include/p/drive.h:2"
    assert facts.place("src/node.cpp", facts.first("Rate").line) == "src/node.cpp:11"
    assert facts.place("src/node.cpp", 0) == "src/node.cpp"
    assert facts.classes[0].is_node


@pytest.mark.parametrize(
    ("subscribe", "kind", "callback"),
    [
        ('n.subscribe<sensor_msgs::Joy>("joy", 1, &Node::drive, this)', "Joy", "drive"),
        ('n->subscribe("joy", 1, boost::bind(&Node::drive, this, _1))', "Joy", "drive"),
        ('this->n.subscribe("joy", 1, [](const sensor_msgs::JoyConstPtr& j) {})', "Joy", "lambda"),
        ('n.subscribe<Joy>("joy", 1, std::bind(&Node::drive, &node, _1))', "Joy", "drive"),
        ("n.subscribe(joy, 1, unknown)", "", "unknown"),
    ],
)
def test_the_ways_to_subscribe(subscribe, kind, callback):
    drive = "void Node::drive(const sensor_msgs::Joy::ConstPtr& joy) {}\n"
    words = facts_of(f"{drive}int main() {{ s = {subscribe}; }}").first("Subscriber").words
    assert words[1:] == [kind, callback]


@pytest.mark.parametrize(
    ("parameter", "message"),
    [
        ("const std_msgs::String::ConstPtr& msg", "String"), ("std_msgs::StringPtr m", "String"),
        ("const sensor_msgs::Joy& joy", "Joy"), ("boost::shared_ptr<Joy const> const& j", "Joy"),
        ("const ros::MessageEvent<std_msgs::String const>& event", "String"), ("int x", ""),
    ],
)  # fmt: skip
def test_the_message_of_a_callback(parameter, message):
    (node,) = below(parsed(f"void f({parameter}) {{}}"), "parameter_declaration")
    assert message_of(node) == message


def test_a_for_loop_with_an_end_is_no_loop_of_a_node():
    text = (
        "int main() {\n  for (int i = 0; i < 3; ++i) f();\n  for (;;) g();\n  do h(); while (1);\n}"
    )
    assert sorted(facts_of(text).loops) == [3, 4]
