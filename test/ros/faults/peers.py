#!/usr/bin/python3
"""Other programs that speak to a node: another joystick, broken messages, silence, no name."""

import io
import socket
import struct

import rosgraph
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rosgraph.network import encode_ros_handshake_header, read_ros_handshake_header
from sensor_msgs.msg import Joy

from node_kit.questions import call
from tutorial_testing.nodes import node_path
from tutorial_testing.rig import BASE, DRIVER, MUX
from tutorial_testing.rostests import RosTest, run
from tutorial_testing.seat_room import serialised
from tutorial_testing.waiting import DEADLINE_S, wait_for

NEUTRAL = Joy(axes=[0.0] * 6, buttons=[0] * 12)
LB = 4
HELD = Joy(axes=[0.0, 1.0, 0.0, 0.0, 0.0, 0.0], buttons=[0] * 4 + [1] + [0] * 7)
INPUTS = '[{"name": "a", "topic": "input", "timeout": 1.0, "priority": 1}]'
MUX_COMMAND = (node_path("fake_turtlebot_sim", "cmd_vel_mux.py"), f"_subscribers:={INPUTS}")


class Wire(Joy):
    """A Joy of the bytes that a test wants."""

    __slots__ = ("raw",)

    def __init__(self, raw=b""):
        super().__init__()
        self.raw = raw

    def serialize(self, buff):
        buff.write(self.raw)


def way_to(node, topic):
    """Return [TCPROS, host, port] of a topic of a node, or None."""
    uri = call(rosgraph.get_master_uri(), "lookupNode", node)[1]
    return uri and call(uri, "requestTopic", topic, [["TCPROS"]])[1]


def greeting(way, topic, kind):
    """Return a node's answer to a new subscriber, by hand: rospy counts one before its greeting."""
    with socket.create_connection((way[1], way[2])) as subscriber:
        subscriber.settimeout(DEADLINE_S)
        header = {"callerid": "/new", "topic": topic, "type": kind._type, "md5sum": kind._md5sum}
        subscriber.sendall(encode_ros_handshake_header(header))
        return read_ros_handshake_header(subscriber, io.BytesIO(), 4096)


class FaultsOfThePeers(RosTest):
    def setUp(self):
        self.velocities = self.record("cmd_vel", Twist)

    def test_a_second_joystick_is_not_armed_by_the_first(self):
        joy2twist = node_path("joy2twist", "joy2twist.py")
        self.start(joy2twist, "_enable_button:=4", "_arm_on_neutral:=true")
        first = self.publisher("joy", Joy)
        wait_for(lambda: first.publish(NEUTRAL) or self.velocities, "zero of joy2twist")
        wait_for(lambda: first.publish(HELD) or self.velocities[-1].linear.x, "velocity")
        for _ in range(3):
            first.publish(NEUTRAL)
        wait_for(lambda: not self.velocities[-1].linear.x, "zero")
        del self.velocities[:]
        held = []
        self.hear("joy", Joy, lambda joy: held.extend(joy.buttons[LB : LB + 1]))
        self.start("rostopic", "pub", "-r", "50", "/joy", "sensor_msgs/Joy", str(HELD))
        # The first one goes on, so that it is not its silence that disarms.
        wait_for(lambda: first.publish(NEUTRAL) or sum(held) >= 50, "second joystick")
        self.assertEqual([v.linear.x for v in self.velocities if v.linear.x], [])

    def test_a_message_that_cannot_be_read_makes_no_node_deaf(self):
        node = self.start(node_path("joy2twist", "joy2twist.py"))
        bad = self.publisher("joy", Wire)
        good = Wire(raw=serialised(HELD))
        wait_for(lambda: bad.publish(good) or self.velocities, "velocity")
        for raw in (
            b"",
            serialised(HELD)[:20],  # cut
            serialised(HELD)[:12] + struct.pack("<I", 10**6),  # a text that is not there
            serialised(HELD)[:16] + struct.pack("<I", 2**31),  # so many axes
        ):
            said = node.output.count("cannot be read")

            def warns(said=said, raw=raw):
                bad.publish(Wire(raw=raw))
                return node.output.count("cannot be read") > said

            wait_for(warns, "warning")
            del self.velocities[:]
            wait_for(lambda: bad.publish(good) or self.velocities, f"velocity after {raw!r}")

    def test_a_peer_that_says_nothing_holds_up_no_node(self):
        self.start(node_path("joy2twist", "joy2twist.py"))
        self.start(node_path("fake_turtlebot_sim", "fake_turtlebot.py"))
        self.start(*MUX_COMMAND)
        for node, topic, kind in (
            (DRIVER, "/cmd_vel", Twist),
            (MUX, "/cmd_vel_mux/output", Twist),
            (BASE, "/odom", Odometry),
        ):
            way = wait_for(lambda node=node, topic=topic: way_to(node, topic), topic)
            with socket.create_connection((way[1], way[2])) as silent:
                silent.settimeout(DEADLINE_S)
                self.assertEqual(greeting(way, topic, kind)["callerid"], node)
                self.assertEqual(silent.recv(1), b"")  # closed

    def test_a_publisher_without_a_name_is_obeyed_by_the_mux(self):
        mux = self.start(*MUX_COMMAND, "cmd_vel_mux/output:=cmd_vel")
        self.start("/usr/bin/python3", "-c", NAMELESS)
        wait_for(lambda: self.velocities and self.velocities[-1].linear.x == 0.25, "velocity")
        self.assertNotIn("Traceback", mux.output)


NAMELESS = """
import rospy, time
from geometry_msgs.msg import Twist
from rospy.impl.tcpros_pubsub import TCPROSPub
fields = TCPROSPub.get_header_fields
TCPROSPub.get_header_fields = lambda self: {
    name: value for name, value in fields(self).items() if name != "callerid"}
rospy.init_node("nameless")
publisher = rospy.Publisher("/cmd_vel_mux/input", Twist, queue_size=10)
twist = Twist()
twist.linear.x = 0.25
while not rospy.is_shutdown():
    publisher.publish(twist)
    time.sleep(0.05)
"""


if __name__ == "__main__":
    run()
