#!/usr/bin/python3
"""The whole of minimal.launch, seen from outside as a TurtleBot 2 is."""

from math import nan

import rosgraph
import rospy
from geometry_msgs.msg import Twist, Vector3
from rosgraph_msgs.msg import Log
from std_msgs.msg import Empty, String

from node_kit.questions import call
from tutorial_testing.robot import Robot
from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import wait_for

# Topic: (type, node that publishes it, node that subscribes to it).
TOPICS = {
    "/cmd_vel_mux/input/safety_controller": ("geometry_msgs/Twist", None, "/cmd_vel_mux"),
    "/cmd_vel_mux/input/teleop": ("geometry_msgs/Twist", None, "/cmd_vel_mux"),
    "/cmd_vel_mux/input/switch": ("geometry_msgs/Twist", None, "/cmd_vel_mux"),
    "/cmd_vel_mux/input/navi": ("geometry_msgs/Twist", None, "/cmd_vel_mux"),
    "/cmd_vel_mux/active": ("std_msgs/String", "/cmd_vel_mux", None),
    "/mobile_base/commands/velocity": ("geometry_msgs/Twist", "/cmd_vel_mux", "/mobile_base"),
    "/mobile_base/commands/reset_odometry": ("std_msgs/Empty", None, "/mobile_base"),
    "/odom": ("nav_msgs/Odometry", "/mobile_base", None),
    "/joint_states": ("sensor_msgs/JointState", "/mobile_base", None),
    "/tf": ("tf2_msgs/TFMessage", "/mobile_base", None),
}


def mux_has_its_base():
    """Whether the base is connected to the mux."""
    uri = call(rosgraph.get_master_uri(), "lookupNode", "/cmd_vel_mux")[1]
    links = call(uri, "getBusInfo")[1] or []
    return any(link[4] == "/mobile_base/commands/velocity" for link in links)


class MinimalTest(RosTest):
    def test_topics_and_their_types(self):
        master = rosgraph.Master(rospy.get_name())

        def missing():
            publishers, subscribers, _ = map(dict, master.getSystemState())
            kinds = dict(master.getTopicTypes())
            return [
                topic
                for topic, (kind, publisher, subscriber) in TOPICS.items()
                if kinds.get(topic) != kind
                or publisher not in [None, *publishers.get(topic, [])]
                or subscriber not in [None, *subscribers.get(topic, [])]
            ]

        wait_for(lambda: not missing(), "topics of a TurtleBot 2")
        # The base hears the mux alone.
        self.assertNotIn("/cmd_vel", dict(master.getTopicTypes()))

    def test_driving(self):
        robot, log = self.enter(Robot()), self.record("/rosout", Log)
        commands = self.record("mobile_base/commands/velocity", Twist)
        active = self.record("cmd_vel_mux/active", String)
        teleop, safety = (
            self.publisher(f"cmd_vel_mux/input/{name}", Twist, queue_size=1)
            for name in ("teleop", "safety_controller")
        )
        reset = self.publisher("mobile_base/commands/reset_odometry", Empty)
        for publisher in (teleop, safety, reset):
            wait_for(publisher.get_num_connections, f"subscriber of {publisher.name}")
        wait_for(lambda: robot.odometry and active, "first messages")
        # Who comes in the middle of a motion would be held, and so would a base that starts late.
        wait_for(mux_has_its_base, "connection of mux and base")

        def is_driven(name, speed):
            return active[-1].data == name and robot.now.v == speed

        def place():
            return robot.now.x

        forwards = Twist(Vector3(0.3, 0.01, 0.02), Vector3(0.03, 0.04, 0.05))
        backwards = Twist(linear=Vector3(-0.1, 0.0, 0.0))

        self.assertEqual(place(), 0.0)
        wait_for(lambda: teleop.publish(forwards) or is_driven("teleop", 0.3), "teleop")
        wait_for(lambda: teleop.publish(forwards) or place() > 0.1, "way forwards")
        self.assertEqual(commands[-1], forwards)  # all six numbers, unchanged

        def both():
            teleop.publish(forwards)
            safety.publish(backwards)

        wait_for(lambda: both() or is_driven("safety_controller", -0.1), "safety_controller")
        farthest = place()
        wait_for(lambda: both() or place() < farthest - 0.05, "way back")
        backwards.linear.x = nan  # neither obeyed nor a sign of life, and reported

        def is_reported():
            return any("safety_controller: a command is not a finite" in one.msg for one in log)

        wait_for(lambda: both() or (is_driven("teleop", 0.3) and is_reported()), "teleop again")
        wait_for(lambda: is_driven("idle", 0.0), "robot that stands")

        reset.publish()
        wait_for(lambda: place() == 0.0, "odometry at zero")


if __name__ == "__main__":
    run()
