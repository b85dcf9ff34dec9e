"""Other programs that connect to a node: another joystick, unreadable messages, a silent peer."""

import io
import socket
import struct

import rosgraph
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rosgraph.network import encode_ros_handshake_header, read_ros_handshake_header
from sensor_msgs.msg import Joy

from node_kit.ros.graph.ros_api import call
from tutorial_faults.live.table import HELD, LB, RawJoy
from tutorial_testing.claims import claim
from tutorial_testing.nodes import node_path, serialised
from tutorial_testing.rig import BASE, DRIVER, MUX
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import DEADLINE_S, wait_for

NEUTRAL = Joy(axes=[0.0] * 6, buttons=[0] * 12)
INPUTS = '[{"name": "a", "topic": "input", "timeout": 1.0, "priority": 1}]'
JOY2TWIST = node_path("joy2twist", "joy2twist.py")


@claim(
    "(b) A second joystick is not armed by the first; (h) an unreadable message is reported and "
    "stops no node from receiving; a silent peer holds up no node"
)
class FaultsOfThePeers(RosTest):
    def setUp(self):
        self.velocities = self.record("cmd_vel", Twist)

    def test_a_second_joystick_is_not_armed_by_the_first(self):
        self.start(JOY2TWIST, f"_enable_button:={LB}", "_arm_on_neutral:=true")
        first, seen = self.publisher("joy", Joy), self.record("joy", Joy)
        wait_for(lambda: first.publish(NEUTRAL) or self.velocities, "zero of joy2twist")
        wait_for(lambda: first.publish(HELD) or self.velocities[-1].linear.x, "velocity")
        wait_for(lambda: first.publish(NEUTRAL) or not self.velocities[-1].linear.x, "zero")
        self.velocities.clear()
        seen.clear()
        self.start("rostopic", "pub", "-r", "50", "/joy", "sensor_msgs/Joy", str(HELD))
        # The first joystick goes on, so that its silence does not disarm.
        held = lambda: sum(joy.buttons[LB] for joy in list(seen))  # noqa: E731
        wait_for(lambda: first.publish(NEUTRAL) or held() >= 50, "second joystick")
        self.assertEqual([v.linear.x for v in self.velocities if v.linear.x], [])

    def test_a_message_that_cannot_be_read_is_reported_and_makes_no_node_deaf(self):
        node = self.start(JOY2TWIST)
        joystick, good = self.publisher("joy", RawJoy), serialised(HELD)
        wait_for(lambda: joystick.publish(RawJoy(good)) or self.velocities, "velocity")
        for raw in (good[:20], good[:16] + struct.pack("<I", 2**31)):  # cut; so many axes
            said = node.output.count("cannot be read")

            def is_reported(raw=raw, said=said):
                joystick.publish(RawJoy(raw))
                return node.output.count("cannot be read") > said

            wait_for(is_reported, f"warning: {raw}")
            self.velocities.clear()
            wait_for(lambda: joystick.publish(RawJoy(good)) or self.velocities, "velocity again")

    def test_a_peer_that_says_nothing_holds_up_no_node(self):
        self.start(JOY2TWIST)
        self.start(node_path("fake_turtlebot_sim", "fake_turtlebot.py"))
        self.start(node_path("fake_turtlebot_sim", "cmd_vel_mux.py"), f"_subscribers:={INPUTS}")
        for node, topic, kind in (
            (DRIVER, "/cmd_vel", Twist),
            (MUX, "/cmd_vel_mux/output", Twist),
            (BASE, "/odom", Odometry),
        ):
            way = wait_for(lambda node=node, topic=topic: way_to(node, topic), topic)
            with socket.create_connection(way) as silent:
                silent.settimeout(DEADLINE_S)
                self.assertEqual(greeting(way, topic, kind)["callerid"], node)
                self.assertEqual(silent.recv(1), b"")  # closed


def way_to(node, topic):
    """Return (host, port) of a topic of a node, or None."""
    uri = call(rosgraph.get_master_uri(), "lookupNode", node)[1]
    way = uri and call(uri, "requestTopic", topic, [["TCPROS"]])[1]
    return way and tuple(way[1:])


def greeting(way, topic, kind):
    """Return a node's answer to a new subscriber that has sent its header by hand."""
    with socket.create_connection(way) as subscriber:
        subscriber.settimeout(DEADLINE_S)
        header = {"callerid": "/new", "topic": topic, "type": kind._type, "md5sum": kind._md5sum}
        subscriber.sendall(encode_ros_handshake_header(header))
        return read_ros_handshake_header(subscriber, io.BytesIO(), 4096)
