"""What hints of section 6.2 tell a student to write, in both languages."""

from __future__ import annotations

from dataclasses import dataclass

from tutorial_check import SourceFacts


@dataclass(frozen=True)
class ClassWords:
    """The words of a language."""

    is_class: str  # what section 6.2 asks for
    class_parts: str
    makes_object: str  # {name} is the class
    shares: str  # what a class has in place of globals
    stops_robot: str
    unsubscribes: str  # before the zero
    waits: str  # for the first message
    arguments: str  # roslaunch adds some


PYTHON = ClassWords(
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
CPP = ClassWords(
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


def words_for(facts: SourceFacts) -> ClassWords:
    """Return the words for the language of a program."""
    return PYTHON if facts.is_python else CPP
