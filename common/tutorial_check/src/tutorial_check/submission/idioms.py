"""How a program says in Python, or in C++, what a hint tells a student to write."""

from __future__ import annotations

from dataclasses import dataclass

HOMES = {  # {message: its package}
    "Joy": "sensor_msgs", "Twist": "geometry_msgs", "Vector3": "geometry_msgs",
    "String": "std_msgs", "Float32": "std_msgs",
}  # fmt: skip


@dataclass(frozen=True)
class Idioms:
    """The lines and names of a language's ROS library."""

    language: str
    library: str
    init: str
    init_named: str  # with {name}
    init_anonymous: str
    spin: str
    loop: str  # that ends with the node
    in_loop: str  # words for what belongs into it
    info: str  # displays a text
    axes: str  # of a Joy in its callback
    text: str  # of a String in its callback
    format: str  # of a value with two decimals
    show_axes: str  # displays six axes
    show_all_axes: str  # however many there are
    publish: str
    zero: str  # a Twist of zeros
    publisher_name: str  # what makes a Publisher
    a_subscriber: str  # with {topic}, {type}, {home}
    a_typed_subscriber: str  # names the type, likewise
    a_publisher: str
    an_import: str
    rate: str  # with {hz}
    is_class: str  # what section 6.2 asks for
    class_parts: str
    makes_object: str  # of the class {name}
    shares: str  # what a class has in place of globals
    stops_robot: str
    unsubscribes: str  # before the zero
    waits: str  # for the first message
    arguments: str  # that roslaunch adds

    def named(self, name: str) -> str:
        """Return the call that names a node."""
        return self.init_named.format(name=name)

    def subscriber(self, topic: str, kind: str) -> str:
        """Return the line that subscribes to a topic with messages of a kind, such as Joy."""
        return self.a_subscriber.format(topic=topic, type=kind, home=HOMES[kind])

    def typed_subscriber(self, topic: str, kind: str) -> str:
        """Return the line that says which type of messages a Subscriber takes."""
        return self.a_typed_subscriber.format(topic=topic, type=kind, home=HOMES[kind])

    def publisher(self, topic: str, kind: str) -> str:
        """Return the line that makes a Publisher."""
        return self.a_publisher.format(topic=topic, type=kind, home=HOMES[kind])

    def imported(self, kind: str) -> str:
        """Return the line at the top of a program that imports a message."""
        return self.an_import.format(type=kind, home=HOMES[kind])


PYTHON = Idioms(
    language="Python",
    library="rospy",
    init="rospy.init_node",
    init_named="init_node('{name}')",
    init_anonymous="anonymous given to rospy.init_node",
    spin="rospy.spin()",
    loop="while not rospy.is_shutdown():",
    in_loop="while not rospy.is_shutdown(): ..., rate.sleep() within it",
    info="rospy.loginfo",
    axes="data.axes",
    text="data.data",
    format="%.2f",
    show_axes="[%.2f, %.2f, %.2f, %.2f, %.2f, %.2f] % data.axes",
    show_all_axes='", ".join("%.2f" % axis for axis in data.axes)',
    publish="pub.publish(msg)",
    zero="Twist()",
    publisher_name="rospy.Publisher",
    a_subscriber="rospy.Subscriber('{topic}', {type}, callback)",
    a_typed_subscriber="rospy.Subscriber('{topic}', {type}, callback)",
    a_publisher="rospy.Publisher('{topic}', {type}, queue_size=10)",
    an_import="from {home}.msg import {type}",
    rate="rospy.Rate({hz})",
    is_class="a class with __init__, its callback bound to self, created under __main__",
    class_parts="class NewJoy2Twist: with __init__(self), callback(self, data), shutdown(self)",
    makes_object="{name}() with (), under if __name__ == '__main__':",
    shares="a class needs no `global`: self. keeps what its methods share",
    stops_robot="rospy.on_shutdown(self.shutdown), and self.cmd_vel.publish(Twist()) in shutdown",
    unsubscribes="self.sub = rospy.Subscriber(...) in __init__;"
    " in shutdown self.sub.unregister() first, then the zero",
    waits="a Subscriber waits by itself for the first message;"
    " an except should display what it catches",
    arguments="roslaunch gives it arguments such as __name:=...; rospy.myargv() leaves those out",
)
CPP = Idioms(
    language="C++",
    library="roscpp",
    init="ros::init",
    init_named='ros::init(argc, argv, "{name}")',
    init_anonymous="ros::init_options::AnonymousName given to ros::init",
    spin="ros::spin()",
    loop="while (ros::ok())",
    in_loop="while (ros::ok()) { ...; ros::spinOnce(); rate.sleep(); }",
    info="ROS_INFO",
    axes="msg->axes",
    text="msg->data",
    format="%.2f",
    show_axes='ROS_INFO("%.2f %.2f %.2f %.2f %.2f %.2f", msg->axes[0], ... msg->axes[5])',
    show_all_axes="for (float axis : msg->axes)",
    publish="pub.publish(twist)",
    zero="geometry_msgs::Twist()",
    publisher_name="advertise",
    a_subscriber='ros::Subscriber sub = n.subscribe("{topic}", 10, callback)',
    a_typed_subscriber="the callback's message decides: const {home}::{type}::ConstPtr& msg",
    a_publisher='ros::Publisher pub = n.advertise<{home}::{type}>("{topic}", 10)',
    an_import="#include <{home}/{type}.h>",
    rate="ros::Rate rate({hz})",
    is_class="a class with NodeHandle, Publisher and Subscriber, of which main makes an object",
    class_parts="class NewJoy2Twist, with its constructor, a method callback(), and as members"
    " ros::NodeHandle, ros::Publisher, ros::Subscriber",
    makes_object="{name} node; in main, without (), after ros::init and before ros::spin()",
    shares="a class needs no global Publisher: a member keeps what its methods share",
    stops_robot="ros::init(argc, argv, name, ros::init_options::NoSigintHandler); after the object"
    " is made, signal(SIGINT, onCtrlC); onCtrlC publishes geometry_msgs::Twist(), and then calls"
    " ros::shutdown()",
    unsubscribes="a member ros::Subscriber sub_; before the zero sub_.shutdown()",
    waits="ros::spin() waits for messages; before the first, nothing else is there to read",
    arguments="roslaunch gives it arguments such as __name:=...; ros::init(argc, argv, ...) takes"
    " those out, so read argv after it",
)
