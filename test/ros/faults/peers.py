#!/usr/bin/python3
"""Whoever else speaks to a node: another joystick, broken messages, silence, no name."""

import contextlib
import io
import socket
import struct
import sys
import threading
import unittest
from socketserver import ThreadingMixIn
from xmlrpc.server import SimpleXMLRPCServer

import rosgraph
import rospy
import rostest
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rosgraph.network import encode_ros_handshake_header, read_ros_handshake_header
from sensor_msgs.msg import Joy

from node_kit.questions import call
from tutorial_testing.nodes import init_node, node_path
from tutorial_testing.processes import Program
from tutorial_testing.rig import BASE, DRIVER, MUX
from tutorial_testing.waiting import DEADLINE_S, wait_for

LB, FORWARD = [0] * 4 + [1] + [0] * 7, [0.0, 1.0, 0.0, 0.0, 0.0, 0.0]
NEUTRAL = Joy(axes=[0.0] * 6, buttons=[0] * 12)
HELD = Joy(axes=FORWARD, buttons=LB)


INPUTS = '[{"name": "a", "topic": "input", "timeout": 1.0, "priority": 1}]'
MUX_COMMAND = (
    node_path("fake_turtlebot_sim", "cmd_vel_mux.py"), f"_subscribers:={INPUTS}",
    "cmd_vel_mux/output:=cmd_vel",
)  # fmt: skip


class Wire(Joy):
    """A Joy whose bytes are what a test wants."""

    __slots__ = ("raw",)

    def __init__(self, raw=b""):
        super().__init__()
        self.raw = raw

    def serialize(self, buff):
        buff.write(self.raw)


def whole(message):
    """The bytes of a message."""
    buff = io.BytesIO()
    message.serialize(buff)
    return buff.getvalue()


def way_to(node, topic):
    """[TCPROS, host, port] of a topic of a node, or None."""
    uri = call(rosgraph.get_master_uri(), "lookupNode", node)[1]
    return uri and call(uri, "requestTopic", topic, [["TCPROS"]])[1]


def greeting(way, topic, kind):
    """What a node answers to a new subscriber, by hand: rospy counts one before it is greeted."""
    with socket.create_connection((way[1], way[2])) as subscriber:
        subscriber.settimeout(DEADLINE_S)
        header = {"callerid": "/new", "topic": topic, "type": kind._type, "md5sum": kind._md5sum}
        subscriber.sendall(encode_ros_handshake_header(header))
        return read_ros_handshake_header(subscriber, io.BytesIO(), 4096)


class SlowPublisher(ThreadingMixIn, SimpleXMLRPCServer):
    """A publisher that tells its way only to two who ask at once, or after a while to one."""

    daemon_threads = True
    WHILE_S = 2.0

    def __init__(self):
        super().__init__(("127.0.0.1", 0), logRequests=False, allow_none=True)
        self.uri = f"http://127.0.0.1:{self.server_address[1]}/"
        self.asked, self._asked_twice = 0, threading.Event()
        self.way = socket.create_server(("127.0.0.1", 0))
        self.way.settimeout(DEADLINE_S)
        self.register_function(self.request_topic, "requestTopic")
        threading.Thread(target=self.serve_forever, daemon=True).start()

    def request_topic(self, *_):
        self.asked += 1
        if self.asked > 1:
            self._asked_twice.set()
        self._asked_twice.wait(self.WHILE_S)
        return 1, "", ["TCPROS", *self.way.getsockname()]

    def end(self):
        self.shutdown()
        self.server_close()
        self.way.close()


class FaultsOfThePeers(unittest.TestCase):
    """Whoever else speaks to a node."""

    def setUp(self):
        self.velocities = []
        self.robot = rospy.Subscriber("cmd_vel", Twist, self.velocities.append)
        self.addCleanup(self.robot.unregister)

    def joy2twist(self, *parameters):
        program = Program(node_path("joy2twist", "joy2twist.py"), *parameters)
        self.addCleanup(program.__exit__)
        return program

    def publisher(self, kind=Joy):
        publisher = rospy.Publisher("joy", kind, queue_size=10)
        self.addCleanup(publisher.unregister)
        return publisher

    def test_a_second_joystick_is_not_armed_by_the_first(self):
        self.joy2twist("_enable_button:=4", "_arm_on_neutral:=true")
        first = self.publisher()
        wait_for(lambda: first.publish(NEUTRAL) or self.velocities, "zero of joy2twist")
        wait_for(lambda: first.publish(HELD) or self.velocities[-1].linear.x, "velocity")
        for _ in range(3):
            first.publish(NEUTRAL)
        wait_for(lambda: not self.velocities[-1].linear.x, "zero")
        del self.velocities[:]
        with Program("/usr/bin/python3", "-c", SECOND_JOYSTICK) as second:
            # The first one goes on, so that it is not its silence that disarms.
            wait_for(
                lambda: first.publish(NEUTRAL) or "sent 50" in second.output, "second joystick"
            )
            self.assertEqual([v.linear.x for v in self.velocities if v.linear.x], [])

    def test_a_message_that_cannot_be_read_makes_nobody_deaf(self):
        node = self.joy2twist()
        bad = self.publisher(Wire)
        good = Wire(raw=whole(HELD))
        wait_for(lambda: bad.publish(good) or self.velocities, "velocity")
        for raw in (
            b"",
            whole(HELD)[:20],  # cut
            whole(HELD)[:12] + struct.pack("<I", 10**6),  # a text that is not there
            whole(HELD)[:16] + struct.pack("<I", 2**31),  # so many axes
        ):
            said = node.output.count("cannot be read")
            wait_for(
                lambda said=said, raw=raw: (
                    bad.publish(Wire(raw=raw)) or node.output.count("cannot be read") > said
                ),
                "warning",
            )
            del self.velocities[:]
            wait_for(lambda: bad.publish(good) or self.velocities, f"velocity after {raw!r}")

    def test_a_length_that_lies_makes_nobody_deaf(self):
        node = self.joy2twist()
        bad = self.publisher(Wire)
        good = Wire(raw=whole(HELD))
        wait_for(lambda: bad.publish(good) or self.velocities, "velocity")

        def lie(length):
            for connection in list(bad.impl.connections):
                with contextlib.suppress(OSError):  # it is being made anew
                    connection._connection.socket.sendall(struct.pack("<I", length))
            bad.publish(good)

        for length in (10**6, 3):
            said = node.output.count("cannot be read")
            # Again and again: within a second of a warning there is no other.
            wait_for(
                lambda said=said, length=length: (
                    lie(length) or node.output.count("cannot be read") > said
                ),
                f"warning about {length} bytes",
            )
            del self.velocities[:]
            wait_for(lambda: bad.publish(good) or self.velocities, "velocity")

    def test_a_peer_that_says_nothing_holds_up_nobody(self):
        self.joy2twist()
        simulator = Program(node_path("fake_turtlebot_sim", "fake_turtlebot.py"))
        self.addCleanup(simulator.__exit__)
        mux = Program(*MUX_COMMAND[:-1])  # with its output under its own name
        self.addCleanup(mux.__exit__)
        for node, topic, kind in (
            (DRIVER, "/cmd_vel", Twist),
            (MUX, "/cmd_vel_mux/output", Twist),
            (BASE, "/odom", Odometry),
        ):
            way = wait_for(lambda node=node, topic=topic: way_to(node, topic), topic)
            with socket.create_connection((way[1], way[2])) as silent:
                silent.settimeout(DEADLINE_S)
                self.assertEqual(greeting(way, topic, kind)["callerid"], node)
                self.assertEqual(silent.recv(1), b"")  # let go

    def test_a_publisher_that_is_heard_of_twice_is_connected_to_once(self):
        """The two ends may each give up another one of two connections, and the node is deaf."""
        self.joy2twist()
        publisher = SlowPublisher()
        self.addCleanup(publisher.end)

        def tell():
            node = call(rosgraph.get_master_uri(), "lookupNode", DRIVER)[1]
            if node:  # perhaps not yet subscribed, or the one of another test, which ends
                call(node, "publisherUpdate", "/joy", [publisher.uri, publisher.uri])

        wait_for(lambda: tell() or publisher.asked, "question for the way")
        connection, _ = publisher.way.accept()
        self.addCleanup(connection.close)
        self.assertEqual(publisher.asked, 1)

    def test_a_publisher_without_a_name_is_obeyed_by_the_mux(self):
        mux = Program(*MUX_COMMAND)
        self.addCleanup(mux.__exit__)
        with Program("/usr/bin/python3", "-c", NAMELESS):
            wait_for(lambda: self.velocities and self.velocities[-1].linear.x == 0.25, "velocity")
        self.assertNotIn("Traceback", mux.output)


SECOND_JOYSTICK = """
import rospy, time
from sensor_msgs.msg import Joy
rospy.init_node("second_joystick")
joy = rospy.Publisher("joy", Joy, queue_size=10)
while not joy.get_num_connections():
    time.sleep(0.01)
for number in range(1, 51):
    joy.publish(Joy(axes=[0, 1.0, 0, 0, 0, 0], buttons=[0] * 4 + [1] + [0] * 7))
    time.sleep(0.02)
    print("sent", number, flush=True)
rospy.spin()
"""

NAMELESS = """
import rospy, time
from geometry_msgs.msg import Twist
from rospy.impl.tcpros_pubsub import TCPROSPub
fields = TCPROSPub.get_header_fields
def nameless(self):
    return {name: value for name, value in fields(self).items() if name != "callerid"}
TCPROSPub.get_header_fields = nameless
rospy.init_node("nameless")
publisher = rospy.Publisher("/cmd_vel_mux/input", Twist, queue_size=10)
twist = Twist()
twist.linear.x = 0.25
while not rospy.is_shutdown():
    publisher.publish(twist)
    time.sleep(0.05)
"""


if __name__ == "__main__":
    init_node("peers")
    rostest.rosrun("ros1_tutorial_test", "peers", "__main__", sys.argv)
