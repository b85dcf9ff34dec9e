"""What a program in C++ does too early, too late or never is seen in its source."""

import pytest

from tutorial_check.submission.cpp_facts import CppFacts
from tutorial_check.submission.cpp_lapses import ABOVE, OUTSIDE
from tutorial_check.submission.oddities import Lapses
from tutorial_testing.claims import claim

INIT, NODE, SPIN = 'ros::init(argc, argv, "talker");', "ros::NodeHandle n;", "ros::spin();"
SUB = 'auto sub = n.subscribe("chatter", 1, heard);'
PUB = 'auto pub = n.advertise<std_msgs::String>("chatter", 1);'
LOOP = "while (ros::ok()) { pub.publish(text); rate.sleep(); }"
RIGHT = (INIT, NODE, SUB, PUB, LOOP)


def lapses_of(*lines, above=""):
    """Return the Lapses of a main with these lines, of which the first is line 2."""
    text = "\n".join(lines)
    text = f"{above}int main(int argc, char** argv) {{\n{text}\n}}\n"
    return CppFacts({"src/talker.cpp": text}).lapses


@claim("A diagnosis knows what a program in C++ does too early, too late or never")
@pytest.mark.parametrize(("seen", "lapses"), [
    (lapses_of(NODE, INIT, LOOP), Lapses(early_handle=(2, ABOVE))),
    (lapses_of(INIT, LOOP, above=f"{NODE}\n"), Lapses(early_handle=(1, OUTSIDE))),
    (lapses_of(INIT, NODE, SPIN, SUB), Lapses(late_subscriber=5)),
    (lapses_of(INIT, NODE, PUB, SPIN, LOOP), Lapses(late_loop=6)),
    (lapses_of(INIT, NODE, "while (ros::ok()) {", PUB, "}"), Lapses(repeated_publisher=5)),
    (lapses_of(INIT, NODE, "while (ros::ok) {}"), Lapses(bare_ok=4)),
    (lapses_of('ROS_INFO("%s", msg->data);'), Lapses(text_as_object=(2, "msg->data"))),
    (lapses_of('printf("%s", msg.data);'), Lapses(text_as_object=(2, "msg.data"), unended_line=2)),
    (lapses_of("while (ros::ok()) {", "pub.publish(text);", SPIN, "}"), Lapses(looped_spin=4)),
    (lapses_of(INIT, "while (ros::ok());"), Lapses(empty_loop=3)),
    (lapses_of("std::cout << msg->data;"), Lapses(unended_line=2)),
])  # fmt: skip
def test_a_lapse_has_its_line(seen, lapses):
    assert seen == lapses


@pytest.mark.parametrize("lines", [
    (*RIGHT, SPIN), ("ros::NodeHandle* n;", INIT, "n = new ros::NodeHandle;"), (NODE, SUB, SPIN),
    ("while (ros::ok())", SPIN),
    ('ROS_INFO("%s", msg->data.c_str());', 'ROS_INFO("%d", number->data);'),
    ("std::cout << msg->data << std::endl;", 'std::cout << msg->data << "\\n";', 'puts("x");'),
    ('printf("heard");', "fflush(stdout);"),
    ('std::cout << "heard ";', "std::cout << msg->data << std::endl;"),
    ("ros::NodeHandle;", "ROS_INFO();", "ros::;", "advertise();"),
])  # fmt: skip
def test_what_is_right_is_no_lapse(lines):
    assert lapses_of(*lines) == Lapses()
