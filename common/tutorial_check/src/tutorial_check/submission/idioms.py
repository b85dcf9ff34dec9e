"""The lines of Python and of C++ that hints have for a student to write."""

from __future__ import annotations

from dataclasses import dataclass

HOMES = {  # {message: its package}
    "Joy": "sensor_msgs", "Twist": "geometry_msgs", "Vector3": "geometry_msgs",
    "String": "std_msgs", "Float32": "std_msgs",
}  # fmt: skip


@dataclass(frozen=True)
class NodeIdioms:
    """How a node begins, loops and ends."""

    language: str
    library: str
    init: str
    init_named: str  # with {name}
    init_anonymous: str
    spin: str
    loop: str  # that ends with the node
    in_loop: str  # words for what belongs into it
    rate: str  # with {hz}

    def named(self, name: str) -> str:
        """Return the call that names a node."""
        return self.init_named.format(name=name)


@dataclass(frozen=True)
class MessageIdioms:
    """How a callback reads, displays and sends messages."""

    info: str  # displays a text
    axes: str  # of a Joy in its callback
    text: str  # of a String in its callback
    format: str  # of a value with two decimals
    show_axes: str  # displays six axes
    show_all_axes: str  # however many there are
    publish: str
    zero: str  # a Twist of zeros
    latched: str  # an argument of a Publisher


@dataclass(frozen=True)
class TopicIdioms:
    """How a node names topics and their types; each line with {topic}, {type} and {home}."""

    publisher_name: str  # what makes a Publisher
    a_subscriber: str
    a_typed_subscriber: str  # names the type
    a_publisher: str
    an_import: str

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


@dataclass(frozen=True)
class Idioms(NodeIdioms, MessageIdioms, TopicIdioms):
    """The lines and names of a language's ROS library."""


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
    latched="latch=True",
    publisher_name="rospy.Publisher",
    a_subscriber="rospy.Subscriber('{topic}', {type}, callback)",
    a_typed_subscriber="rospy.Subscriber('{topic}', {type}, callback)",
    a_publisher="rospy.Publisher('{topic}', {type}, queue_size=10)",
    an_import="from {home}.msg import {type}",
    rate="rospy.Rate({hz})",
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
    latched="latch, the true of advertise",
    publisher_name="advertise",
    a_subscriber='ros::Subscriber sub = n.subscribe("{topic}", 10, callback)',
    a_typed_subscriber="the callback's message decides: const {home}::{type}::ConstPtr& msg",
    a_publisher='ros::Publisher pub = n.advertise<{home}::{type}>("{topic}", 10)',
    an_import="#include <{home}/{type}.h>",
    rate="ros::Rate rate({hz})",
)
