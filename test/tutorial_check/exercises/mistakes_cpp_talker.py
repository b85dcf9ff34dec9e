"""Mistakes with talker and listener in C++."""

from edits import put, put_cpp, write
from rows import mistake, mistake_in
from solution import CMAKE, B
from solution_cpp import LISTENER, TALKER

talker5, talker6, talker10 = (mistake_in(TALKER, check) for check in ("C5", "C6", "C10"))
listener7 = mistake_in(LISTENER, "C7")
INIT = 'ros::init(argc, argv, "talker", ros::init_options::AnonymousName);\n'
NODE = "ros::NodeHandle node;\n"
PUB = 'ros::Publisher publisher = node.advertise<std_msgs::String>("chatter", 10);\n'
SUB = 'ros::Subscriber subscriber = node.subscribe("chatter", 10, hear);\n'
INFO = 'ROS_INFO("%s heard: %s", ros::this_node::getName().c_str(), message->data.c_str());'
SPIN = "  ros::spin();\n"
SEND = "    publisher.publish(message);\n"
OF_TALKER = (
    "add_executable(talker src/talker.cpp)\ntarget_link_libraries(talker ${catkin_LIBRARIES})\n"
)
INT = put(TALKER, "#include <std_msgs/String.h>", "&\n#include <std_msgs/Int32.h>")


def within(function):
    """Return the listener's main with its Subscriber in another function."""
    return f"void {function}(ros::NodeHandle& node)\n{{\n  {SUB}}}\n\nint main"


ROWS = [
    mistake(
        "the talker is not in CMakeLists.txt",
        [put(CMAKE, OF_TALKER, "")],
        "C5",
        "src/talker.cpp is in no add_executable",
        f"{B}/CMakeLists.txt:",
        "add_executable(talker src/talker.cpp)",
        "target_link_libraries(talker",
    ),
    mistake(
        "a target and a source of another name",
        [put(CMAKE, "talker", "chat"), lambda src: (src / TALKER).rename(src / B / "src/chat.cpp")],
        "C5",
        "the programs are called chat, listener",
        "add_executable(talker ",
    ),
    talker6(
        "another topic",
        '"chatter"',
        '"chater"',
        "talker.cpp:10",
        "publishes on /chater",
        'n.advertise<std_msgs::String>("chatter", 10)',
    ),
    mistake(
        "another type",
        [INT, put(TALKER, "<std_msgs::String>", "<std_msgs::Int32>")],
        "C6",
        "talker.cpp:11",
        "std_msgs/Int32",
    ),
    talker6("a private topic", NODE, 'ros::NodeHandle node("~");\n', "talker.cpp:9", "private"),
    mistake(
        "advertise in the loop",
        [put(TALKER, f"  {PUB}", ""), put(TALKER, "std::ostringstream text", f"{PUB}    &")],
        "C6",
        "talker.cpp:14",
        "in the loop",
    ),
    talker6(
        "sleep forgotten", "    rate.sleep();\n", "", "talker.cpp:13", "a second", "rate.sleep()"
    ),
    talker6(
        "no loop",
        "while (ros::ok())",
        "if (ros::ok())",
        "talker.cpp:21",
        "while (ros::ok())",
        "main returns",
    ),
    talker6("publish forgotten", SEND, "", "publish"),
    talker6(
        "the loop comes after ros::spin",
        "  ros::Rate rate",
        f"{SPIN}&",
        "talker.cpp:14",
        "ros::spin()",
    ),
    talker6("ros::spin in the loop", SEND, f"{SEND}  {SPIN}", "talker.cpp:22", "ros::spinOnce()"),
    talker6(
        "a ; after while",
        "while (ros::ok())",
        "while (ros::ok());",
        "talker.cpp:13",
        "the ; after while (...) is the whole loop",
    ),
    talker6(
        "no init", f"  {INIT}", "", "must call ros::init()", "talker.cpp:8", "first line of main"
    ),
    talker6(
        "init after the NodeHandle",
        f"  {INIT}  {NODE}",
        f"  {NODE}  {INIT}",
        "talker.cpp:8",
        "must call ros::init()",
        "above",
    ),
    mistake(
        "a global NodeHandle",
        [put(TALKER, f"  {NODE}", ""), put(TALKER, "int main", f"{NODE}\n&")],
        "C6",
        "talker.cpp:6",
        "must call ros::init()",
        "before main",
    ),
    talker6("an empty name", '"talker"', '""', "talker.cpp:8", "must not be empty"),
    talker6(
        "a space in the node's name",
        '"talker"',
        '"my talker"',
        "talker.cpp:8",
        "[my talker]",
        "letters, digits",
    ),
    talker6(
        "a slash in the node's name",
        '"talker"',
        '"/talker"',
        "talker.cpp:8",
        "cannot contain /",
        "a node's name has no /",
    ),
    talker6("a space in the topic", '"chatter"', '"chat ter"', "talker.cpp:10", "[chat ter]"),
    talker6(
        "a Publisher without advertise",
        PUB,
        "ros::Publisher publisher;\n",
        "talker.cpp:21",
        "invalid Publisher",
        "no advertise makes publisher",
    ),
    talker6("a rate of 0", "rate(10)", "rate(0)", "talker.cpp:12", "more than 0"),
    talker6(
        "a pointer to no message",
        SEND,
        "    std_msgs::String::Ptr other;\n"
        "    other->data = message.data;\n    publisher.publish(other);\n",
        "px != 0",
        "talker.cpp:22",
        "points to nothing",
    ),
    talker6(
        "an exception of one's own",
        SEND,
        '    throw std::runtime_error("no text");\n',
        "std::runtime_error: no text",
        "talker.cpp:21",
        "nothing catches",
    ),
    talker6(
        "a failed assertion",
        SEND,
        f"    ROS_ASSERT(message.data.empty());\n{SEND}",
        "talker.cpp:21",
        "assertion message.data.empty() failed",
        "asserts this",
    ),
    talker6(
        "a null pointer",
        SEND,
        f"    int* count = nullptr;\n    *count += 1;\n{SEND}",
        "SIGSEGV",
        "segmentation fault",
        "talker.cpp:22",
        "points to nothing",
    ),
    talker10(
        "ros::ok without ()", "ros::ok()", "ros::ok", "talker.cpp:13", "without ()", "ros::ok()"
    ),
    talker10("a loop without end", "ros::ok()", "true", "talker.cpp:13", "ros::ok()"),
    listener7("another topic in the listener", '"chatter"', '"/chat"', "/chat", "listener.cpp:13"),
    mistake(
        "another type in the listener",
        [
            put(LISTENER, "std_msgs/String", "std_msgs/Int32"),
            put(LISTENER, "std_msgs::String", "std_msgs::Int32"),
            put(LISTENER, INFO, 'ROS_INFO("heard %d", message->data);'),
        ],
        "C7",
        "wants Int32",
        "listener.cpp:13",
    ),
    listener7("spin forgotten", SPIN, "", "ros::spin()", "ends"),
    listener7(
        "spinOnce for spin", "ros::spin()", "ros::spinOnce()", "listener.cpp:14", "returns at once"
    ),
    listener7(
        "a spinner without an end",
        SPIN,
        "  ros::AsyncSpinner spinner(1);\n  spinner.start();\n",
        "listener.cpp:14",
        "ros::waitForShutdown()",
    ),
    listener7(
        "a letter that is not there",
        INFO,
        f"{INFO}\n  message->data.at(100);",
        "listener.cpp:7",
        "out_of_range",
        "size()",
    ),
    listener7(
        "spin before subscribe",
        f"  {SUB}{SPIN}",
        f"{SPIN}  {SUB}",
        "listener.cpp:14",
        "above ros::spin()",
    ),
    listener7(
        "a loop without spinOnce",
        SPIN,
        "  ros::Rate rate(10);\n  while (ros::ok())\n    rate.sleep();\n",
        "listener.cpp:15",
        "ros::spinOnce()",
    ),
    mistake(
        "a Subscriber local to a function",
        [
            put_cpp(LISTENER, "int main", within("listen")),
            put(LISTENER, f"{NODE}  {SUB}", f"{NODE}  listen(node);\n"),
        ],
        "C7",
        "listener.cpp:11",
        "listen()",
    ),
    listener7(
        "a Subscriber local to a block",
        f"  {SUB}",
        f"  {{\n  {SUB}  }}\n",
        "listener.cpp:14",
        "block",
    ),
    listener7(
        "a Subscriber that is not kept",
        "ros::Subscriber subscriber = ",
        "",
        "listener.cpp:13",
        "ros::Subscriber sub =",
    ),
    listener7("the listener displays nothing", f"  {INFO}\n", "", "displayed", "ROS_INFO"),
    listener7(
        "the listener displays a number",
        INFO,
        'ROS_INFO("heard %zu", message->data.size());',
        "displayed",
        "msg->data",
    ),
    listener7("the level is debug", "ROS_INFO", "ROS_DEBUG", "listener.cpp:6", "debug"),
    listener7(
        "a text without c_str()",
        INFO,
        'ROS_INFO("heard %s", message->data);',
        "listener.cpp:6",
        "c_str()",
    ),
    listener7("no Subscriber", f"  {SUB}", "", "subscribes to nothing", "n.subscribe("),
    mistake(
        "two nodes of one name",
        [
            put(TALKER, ", ros::init_options::AnonymousName", ""),
            put(LISTENER, '"listener", ros::init_options::AnonymousName', '"talker"'),
        ],
        "C6",
        "same name",
        "listener.cpp:11",
        "ros::init",
    ),
    mistake("an empty file", [write(TALKER, "")], "C4", f"{TALKER}", "the file is empty"),
]
