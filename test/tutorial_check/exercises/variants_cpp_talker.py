"""Right solutions in C++ of section 3: talkers, listeners, and how their package builds them."""

from edits import move, put, put_cpp, write
from manifests import depend, manifest
from rows import right
from solution import CMAKE, JOY_XML, XML, B, J
from solution_cpp import LISTENER, TALKER

HEAR = 'ros::Subscriber subscriber = node.subscribe("chatter", 10, hear);'
HEARD = "const std_msgs::String::ConstPtr& message"
LOOP = "  ros::Rate rate(10);\n  while (ros::ok())\n  {\n"
SAYS = "    publisher.publish(message);\n"
SPIN = "  ros::spin();\n"
TALKER_OF_CMAKE = """add_executable(talker src/talker.cpp)
target_link_libraries(talker ${catkin_LIBRARIES})
"""
BOTH_OF_CMAKE = TALKER_OF_CMAKE + "\n" + TALKER_OF_CMAKE.replace("talker", "listener")


def listener(what, *changes):
    return right(what, "3", *(put_cpp(LISTENER, old, new) for old, new in changes))


def talker(what, *changes):
    return right(what, "3", *(put_cpp(TALKER, old, new) for old, new in changes))


LISTENER_CLASS = """#include <ros/ros.h>
#include <std_msgs/String.h>

class Listener
{
public:
  Listener() : received_(0)
  {
    subscriber_ = node_.subscribe<std_msgs::String>("/chatter", 10, BIND);
  }

private:
  void hear(const std_msgs::String::ConstPtr& message, const std::string& words)
  {
    ++received_;
    ROS_INFO_STREAM(words << " " << message->data << " (" << received_ << ")");
  }

  ros::NodeHandle node_;
  ros::Subscriber subscriber_;
  int received_;
};

int main(int argc, char** argv)
{
  ros::init(argc, argv, "listener", ros::init_options::AnonymousName);
  Listener listener;
  ros::spin();
}
"""
TALKER_TIMER = """#include "ros/ros.h"
#include "std_msgs/String.h"

#include <functional>

class Talker
{
public:
  explicit Talker(ros::NodeHandle& node)
    : publisher_(node.advertise<std_msgs::String>("/chatter", 1)),
      timer_(node.createTimer(ros::Duration(0.1), &Talker::say, this))
  {
  }

private:
  void say(const ros::TimerEvent& event)
  {
    std_msgs::StringPtr message(new std_msgs::String);
    message->data = "tick at " + std::to_string(event.current_real.toSec());
    ROS_INFO_STREAM(message->data);
    publisher_.publish(message);
  }

  ros::Publisher publisher_;
  ros::Timer timer_;
};

int main(int argc, char* argv[])
{
  ros::init(argc, argv, "talker", ros::init_options::AnonymousName);
  ros::NodeHandle node;
  Talker talker(node);
  ros::spin();
  return 0;
}
"""
GREETING_H = """#ifndef BEGINNER_TUTORIALS_GREETING_H
#define BEGINNER_TUTORIALS_GREETING_H
#include <string>

namespace beginner_tutorials
{
std::string greeting(double seconds);
}
#endif
"""
GREETING = """#include <beginner_tutorials/greeting.h>

#include <sstream>

namespace beginner_tutorials
{
std::string greeting(double seconds)
{
  std::ostringstream text;
  text << "good evening at " << std::fixed << seconds;
  return text.str();
}
}
"""
GREETS = [
    write(f"{B}/include/{B}/greeting.h", GREETING_H),
    write(f"{B}/src/greeting.cpp", GREETING),
    put_cpp(TALKER, "#include <sstream>", f"#include <{B}/greeting.h>"),
    put_cpp(TALKER, "std::ostringstream text;", "const double now = ros::Time::now().toSec();"),
    put_cpp(TALKER, '    text << "good day at " << ros::Time::now();\n', ""),
    put_cpp(TALKER, "text.str()", f"{B}::greeting(now)"),
]
HALF = """#include "ros/ros.h"
#include "beginner_tutorials/Half.h"
#include "beginner_tutorials/Number.h"

ros::Publisher halves;

bool half(beginner_tutorials::Half::Request& request, beginner_tutorials::Half::Response& response)
{
  response.half = request.number / 2.0;
  beginner_tutorials::Number number;
  number.number = response.half;
  halves.publish(number);
  return true;
}

int main(int argc, char** argv)
{
  ros::init(argc, argv, "half_server");
  ros::NodeHandle n;
  halves = n.advertise<beginner_tutorials::Number>("halves", 1000);
  ros::ServiceServer service = n.advertiseService("half", half);
  ros::spin();
}
"""
MAKES = """
add_message_files(FILES Number.msg)
add_service_files(FILES Half.srv)
generate_messages(DEPENDENCIES std_msgs)
catkin_package(CATKIN_DEPENDS roscpp rospy std_msgs message_runtime)"""
GENERATED = "${PROJECT_NAME}_generate_messages_cpp"
SERVER_OF_CMAKE = f"""
add_executable(half_server src/half_server.cpp)
target_link_libraries(half_server ${{catkin_LIBRARIES}})
add_dependencies(half_server {GENERATED})
add_dependencies(talker {GENERATED})
add_dependencies(listener {GENERATED})
"""
INSTALL = """
install(TARGETS talker listener RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(DIRECTORY include/${PROJECT_NAME}/ DESTINATION ${CATKIN_PACKAGE_INCLUDE_DESTINATION})
"""
CPP_XML = manifest(J, "3", depend("catkin", "buildtool_depend") + depend(
    "roscpp std_msgs sensor_msgs geometry_msgs", "depend"))  # fmt: skip
XML_1 = manifest(B, "1", depend("catkin", "buildtool_depend") + depend(
    "roscpp rospy std_msgs", "build_depend", "run_depend"))  # fmt: skip

ROWS = [
    right("a class with boost::bind", "3", write(LISTENER, LISTENER_CLASS.replace("BIND",
        'boost::bind(&Listener::hear, this, _1, "heard:")'))),
    right("a class with std::bind", "3", write(LISTENER, LISTENER_CLASS.replace("BIND",
        'std::bind(&Listener::hear, this, std::placeholders::_1, "heard:")'))),
    right("a class with a Timer, without AnonymousName", "3", write(TALKER, TALKER_TIMER)),
    listener("a lambda", (HEAR, """auto subscriber = node.subscribe<std_msgs::String>(
      "chatter", 10, [&node](const std_msgs::String::ConstPtr& message)
      { ROS_INFO_STREAM(node.getNamespace() << " heard: " << message->data); });""")),
    listener("a lambda as a boost::function", ("  ros::Subscriber sub", "  boost::function<void("
        "const std_msgs::String::ConstPtr&)> function =\n      [](const auto& message) "
        "{ hear(message); };\n@"), ("10, hear", "10, function")),
    listener("AsyncSpinner", (SPIN,
        "  ros::AsyncSpinner spinner(2);\n  spinner.start();\n  ros::waitForShutdown();\n")),
    listener("MultiThreadedSpinner", (SPIN,
        "  ros::MultiThreadedSpinner spinner(2);\n  ros::spin(spinner);\n")),
    listener("a loop with spinOnce", (SPIN,
        "  ros::Rate rate(50);\n  while (node.ok())\n  {\n    ros::spinOnce();\n"
        "    rate.sleep();\n  }\n")),
    listener("a reference to the message", (HEARD, "const std_msgs::String& message"),
        ("message->", "message.")),
    listener("StringConstPtr, displayed by cout", (HEARD, "const std_msgs::StringConstPtr& text"),
        ('  ROS_INFO("%s heard: %s", ros::this_node::getName().c_str(), message->data.c_str());',
        '  std::cout << "heard: " << text->data << std::endl;')),
    listener("a MessageEvent, displayed by printf",
        (HEARD, "const ros::MessageEvent<std_msgs::String const>& event"),
        ('  ROS_INFO("%s heard: %s", ros::this_node::getName().c_str(), message->data.c_str());',
        '  printf("%s\\n", event.getMessage()->data.c_str());')),
    talker("counted, with spinOnce and a WallRate",
        (LOOP, "  ros::WallRate rate(5);\n  for (int count = 0; ros::ok(); ++count)\n  {\n"),
        ('"good day at " << ros::Time::now()', '"good day, no. " << count'),
        (SAYS, "@    ros::spinOnce();\n")),
    talker("a sleep in place of a Rate, and a pointer to the message",
        ("  ros::Rate rate(10);\n", ""), ("rate.sleep()", "ros::Duration(0.1).sleep()"),
        ("std_msgs::String message;", "auto words = boost::make_shared<std_msgs::String>();\n"
        "    std_msgs::String& message = *words;"), ("publish(message)", "publish(words)")),
    right("topics with a slash, names that are not anonymous", "3",
        *(put(file, '"chatter"', '"/chatter"') for file in (TALKER, LISTENER)),
        *(put(file, ", ros::init_options::AnonymousName", "") for file in (TALKER, LISTENER))),
    right("a source .cc in nodes, a source .cxx in the package's root", "3",
        move(TALKER, f"{B}/nodes/talker.cc"), put(CMAKE, "src/talker.cpp", "nodes/talker.cc"),
        move(LISTENER, f"{B}/listener.cxx"), put(CMAKE, "src/listener.cpp", "listener.cxx")),
    right("several files, with a header in include", "3",
        *GREETS, put(CMAKE, "src/talker.cpp", "& src/greeting.cpp"),
        put(CMAKE, "include_directories(", "&include ")),
    right("a library, install rules and what catkin_package exports", "3",
        *GREETS, put(CMAKE, "catkin_package()",
        "catkin_package(INCLUDE_DIRS include LIBRARIES greeting CATKIN_DEPENDS roscpp std_msgs)"),
        put(CMAKE, "include_directories(${catkin_INCLUDE_DIRS})", "include_directories(include "
        "${catkin_INCLUDE_DIRS})\n\nadd_library(greeting src/greeting.cpp)"),
        put(CMAKE, "target_link_libraries(talker", "& greeting"),
        put(CMAKE, "listener ${catkin_LIBRARIES})\n", f"&{INSTALL}")),
    right("a prefix and OUTPUT_NAME", "3", put(CMAKE, TALKER_OF_CMAKE,
        "add_executable(${PROJECT_NAME}_talker src/talker.cpp)\n"
        "set_target_properties(${PROJECT_NAME}_talker PROPERTIES OUTPUT_NAME talker PREFIX \"\")\n"
        "add_dependencies(${PROJECT_NAME}_talker ${${PROJECT_NAME}_EXPORTED_TARGETS} "
        "${catkin_EXPORTED_TARGETS})\n"
        "target_link_libraries(${PROJECT_NAME}_talker ${catkin_LIBRARIES})\n")),
    right("names by variables and foreach", "3", put(CMAKE, BOTH_OF_CMAKE,
        "set(NODES talker listener)\nforeach(node ${NODES})\n"
        "  add_executable(${node} src/${node}.cpp)\n"
        "  target_link_libraries(${node} PRIVATE ${catkin_LIBRARIES})\nendforeach()\n")),
    right("names that only contain talker and listener", "3",
        put(CMAKE, "(talker", "(my_talker"), put(CMAKE, "(listener", "(my_listener")),
    right("package.xml of format 1, and C++17", "3", write(XML, XML_1, 0o644),
        put(CMAKE, "find_package", "add_compile_options(-std=c++17 -Wall)\n&")),
    right("beside messages, a service and its server", "3", write(f"{B}/src/half_server.cpp", HALF),
        write(f"{B}/msg/Number.msg", "float64 number\n"),
        write(f"{B}/srv/Half.srv", "int64 number\n---\nfloat64 half\n"),
        put(CMAKE, "rospy roscpp)", "rospy roscpp message_generation)"),
        put(CMAKE, "catkin_package()", MAKES),
        put(CMAKE, "listener ${catkin_LIBRARIES})\n", f"&{SERVER_OF_CMAKE}"),
        put(XML, "  <build_depend>rospy", "  <build_depend>message_generation</build_depend>\n&"),
        put(XML, "  <exec_depend>rospy", "  <exec_depend>message_runtime</exec_depend>\n&")),
    right("sources by file(GLOB), each with main in a folder", "3",
        move(TALKER, f"{B}/src/talker/main.cpp"), move(LISTENER, f"{B}/src/listener/main.cpp"),
        put(CMAKE, BOTH_OF_CMAKE, "foreach(node talker listener)\n"
        "  file(GLOB sources src/${node}/*.cpp)\n  add_executable(${node} ${sources})\n"
        "  target_link_libraries(${node} ${catkin_LIBRARIES})\nendforeach()\n")),
    listener("a message by value, a global subscriber, a NodeHandlePtr",
        (HEARD, "std_msgs::String message"), ("message->", "message."),
        ("int main", "ros::Subscriber subscriber;\n\n@"),
        ("  ros::NodeHandle node;", "  ros::NodeHandlePtr node(new ros::NodeHandle);"),
        ("  ros::Subscriber subscriber = node.", "  subscriber = node->")),
    right("no rospy at all", "3 4.3",
        *(put(XML, f"  <{kind}>rospy</{kind}>\n", "") for kind in ("build_depend", "exec_depend")),
        put(CMAKE, "std_msgs rospy roscpp", "roscpp std_msgs"),
        write(JOY_XML, CPP_XML, 0o644)),
]  # fmt: skip
