"""Mistakes in C++ that the compiler, the linker or CMake reports."""

from edits import put, put_cpp, write
from rows import mistake, mistake_in
from solution import CMAKE, JOY_CMAKE, B
from solution_cpp import CLASS, LISTENER, TALKER

talker4, listener4, class4 = (mistake_in(path, "C4") for path in (TALKER, LISTENER, CLASS))
cmake4 = mistake_in(CMAKE, "C4")
STRING = "#include <std_msgs/String.h>\n"
MAIN = "int main(int argc, char** argv)\n"
CALLBACK = "const std_msgs::String::ConstPtr& message"
LINKS = "target_link_libraries(talker ${catkin_LIBRARIES})\n"
ROWS = [
    talker4("a ; forgotten", "text.str();", "text.str()", "talker.cpp:19", "a ; is missing"),
    talker4("a } forgotten", "    rate.sleep();\n  }\n", "    rate.sleep();\n", "talker.cpp:7",
        "the { of this line is never closed"),
    talker4("NodeHandle misspelt", "ros::NodeHandle", "ros::Nodehandle", "talker.cpp:9",
        "is NodeHandle meant?"),
    talker4("a header misspelt", "std_msgs/String.h", "std_msgs/string.h", "talker.cpp:4",
        "is #include <std_msgs/String.h> meant?"),
    talker4("a header as in ROS 2", "<std_msgs/String.h>", "<std_msgs/msg/string.hpp>",
        "talker.cpp:4", "this is ROS 2"),
    talker4("a header not included", STRING, "", "talker.cpp:9",
        "write #include <std_msgs/String.h>"),
    talker4("advertise without a type", "advertise<std_msgs::String>", "advertise",
        "talker.cpp:10", 'advertise<std_msgs::String>("TOPIC", 10)'),
    talker4("a text published", "publish(message)", "publish(text.str())", "talker.cpp:21",
        "publish takes a message"),
    talker4("a system file included", STRING, '&#include "/etc/passwd"\n', "talker.cpp:5",
        "#include of a file outside of the package"),
    talker4("constexpr without an end", MAIN,
        "constexpr int more(int n) { return more(n + 1); }\nconstexpr int all = more(0);\n&",
        "talker.cpp:", "this computes without an end while it is compiled"),
    listener4("subscribe without a queue", '"chatter", 10, hear', '"chatter", hear',
        "listener.cpp:13", "a topic, a queue size and a callback"),
    listener4("a dot for ->", "message->data", "message.data", "listener.cpp:6", "write -> for"),
    mistake("a callback with std::string", [put_cpp(LISTENER, CALLBACK,
        "const std::string& message"), put(LISTENER, "message->data.c_str()",
        "message.c_str()")], "C4", "listener.cpp:13", "std::string is no message"),
    class4("a method without its object", "&NewJoy2Twist::drive, this", "drive",
        "new_joy2twist.cpp:13", "&CLASS::CALLBACK, this"),
    class4("a ; forgotten after a class", "joy_;\n};\n", "joy_;\n}\n", "new_joy2twist.cpp:39",
        "a ; is missing"),
    cmake4("no libraries linked to a program", LINKS, "", f"{CMAKE}:10",
        "write target_link_libraries(talker ${catkin_LIBRARIES})"),
    cmake4("a variable in another case", "talker ${catkin_L", "talker ${CATKIN_L", f"{CMAKE}:11",
        "the libraries of ROS are in ${catkin_LIBRARIES}"),
    cmake4("roscpp not found", " roscpp)", ")", f"{CMAKE}:10", "name roscpp in find_package"),
    cmake4("two files with main", "src/talker.cpp)", "src/talker.cpp src/listener.cpp)",
        f"{CMAKE}:10", "each program has its own add_executable"),
    cmake4("a source misspelt", "src/talker.cpp", "src/taker.cpp", f"{CMAKE}:10",
        "is src/talker.cpp meant?"),
    cmake4("an older C++", f"project({B})", "&\nadd_compile_options(-std=c++98)", f"{CMAKE}:3",
        "asks for another C++"),
    mistake("two packages with one target", [put(JOY_CMAKE, "new_joy2twist ", "talker ")], "C4",
        f"two targets are named talker: this one, and {CMAKE}:10", f"{JOY_CMAKE}:13",
        "OUTPUT_NAME talker"),
    mistake("a folder of headers not named", [put(TALKER, STRING, f"&#include <{B}/words.h>\n"),
        write(f"{B}/include/{B}/words.h", "")], "C4", "talker.cpp:5",
        "include_directories(include ${catkin_INCLUDE_DIRS})"),
]  # fmt: skip
