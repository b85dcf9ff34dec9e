#!/usr/bin/python3
"""What a hunt for faults found, each once more: it moved, went deaf or would not end."""

import contextlib
import io
import math
import os
import signal
import socket
import struct
import sys
import threading
import time
import unittest

import rosgraph
import rospy
import rostest
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Joy

from node_kit.questions import call
from tutorial_testing.processes import Program
from tutorial_testing.rig import BASE, DRIVER, JOYSTICK, MUX, Rig, go_on, stop
from tutorial_testing.waiting import BUSY_S, DEADLINE_S, wait_for

LONGEST_END_S = 1.5 + BUSY_S
WATCHED_S = 1.5  # in which nothing may move
LB, FORWARD = [0] * 4 + [1] + [0] * 7, [0.0, 1.0, 0.0, 0.0, 0.0, 0.0]
INPUTS = '[{"name": "a", "topic": "input", "timeout": 1.0, "priority": 1}]'
MUX_COMMAND = (
    "rosrun", "fake_turtlebot_sim", "cmd_vel_mux.py", f"_subscribers:={INPUTS}",
    "cmd_vel_mux/output:=cmd_vel",
)  # fmt: skip
NEUTRAL = Joy(axes=[0.0] * 6, buttons=[0] * 12)
HELD = Joy(axes=FORWARD, buttons=LB)


@contextlib.contextmanager
def hung_master():
    """The master takes connections and answers nobody."""
    pids = [call(rosgraph.get_master_uri(), "getPid")[1]]
    stop(pids)
    try:
        yield
    finally:
        go_on(pids)


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


class FaultsOfTheRobot(unittest.TestCase):
    """Through all nodes, with LB held."""

    def check_stays(self, rig, what):
        """The robot stands, although LB is held, until all is released."""
        rig.wait_for_rest()
        began = rig.speeds[-1][0]
        wait_for(lambda: rig.since(began + WATCHED_S), f"odometry after {what}")
        moved = [stamp - began for stamp, speed in rig.since(began) if speed]
        self.assertEqual(moved, [], what)
        rig.drive()

    def kill(self, rig, node):
        pid = rig.pid(node)
        os.kill(pid, signal.SIGKILL)
        rig.programs[node].wait()

    def test_a_robot_or_mux_that_is_started_anew_waits_for_the_release(self):
        with Rig(with_mux=True) as rig:
            for node in (MUX, BASE):
                rig.drive()
                self.kill(rig, node)
                rig.start(node)
                rig.pid(node)
                self.check_stays(rig, f"{node} was started anew")

    def test_the_same_without_a_mux(self):
        with Rig(with_mux=False) as rig:
            rig.drive()
            self.kill(rig, BASE)
            rig.start(BASE)
            rig.pid(BASE)
            self.check_stays(rig, "the robot was started anew")

    def test_joy2twist_that_is_started_anew_waits_for_the_release(self):
        with Rig(with_mux=False) as rig:
            rig.drive()
            self.kill(rig, DRIVER)
            rig.start(DRIVER)
            rig.pid(DRIVER)
            self.check_stays(rig, "joy2twist was started anew")

    def test_a_suspended_base_obeys_no_stale_command(self):
        with Rig(with_mux=False) as rig:
            rig.drive()
            base, driver = rig.pid(BASE), rig.pid(DRIVER)
            stop([base])
            threading.Event().wait(1.0)
            os.kill(driver, signal.SIGKILL)
            rig.programs[DRIVER].wait()
            threading.Event().wait(1.0)
            ended = go_on([base])
            wait_for(lambda: rig.since(ended + WATCHED_S), "odometry")
            # The first odometry may still tell of the time before.
            moved = [stamp - ended for stamp, speed in rig.since(ended + 0.1) if speed]
            self.assertEqual(moved, [])


class FaultsUnderAHungMaster(unittest.TestCase):
    """What is connected stays so; whatever asks the master waits for ever."""

    def check_end(self, number):
        with Rig(with_mux=True) as rig:
            rig.drive()
            pids = {node: rig.pid(node) for node in rig.nodes}
            with hung_master():
                for node in (JOYSTICK, DRIVER, MUX, BASE):
                    began = time.monotonic()
                    os.kill(pids[node], number)
                    rig.programs[node].wait()
                    self.assertLess(time.monotonic() - began, LONGEST_END_S, node)
                    if node == JOYSTICK:
                        rig.wait_for_rest()
                self.assertFalse(rig.is_moving())

    def test_every_node_ends_on_sigint(self):
        self.check_end(signal.SIGINT)

    def test_every_node_ends_on_sigterm(self):
        self.check_end(signal.SIGTERM)

    def check_driven_end(self, node):
        """The wheels are at rest before the node that moved them is gone."""
        with Rig(with_mux=True) as rig:
            rig.drive()
            pid = rig.pid(node)
            with hung_master():
                os.kill(pid, signal.SIGINT)
                rig.programs[node].wait()
                wait_for(lambda: not rig.is_moving(), f"robot at rest after the end of {node}")

    def test_the_end_of_the_mux_leaves_a_standing_robot(self):
        self.check_driven_end(MUX)

    def test_the_end_of_the_base_leaves_a_standing_robot(self):
        self.check_driven_end(BASE)

    def test_a_warning_makes_nobody_deaf(self):
        """NaN and a speed beyond the robot's bring a warning of the mux and of the base."""
        moving, command = [], Twist()
        odom = rospy.Subscriber("odom", Odometry, lambda o: moving.append(o.twist.twist.linear.x))
        pilot = rospy.Publisher("/cmd_vel_mux/input", Twist, queue_size=10)
        self.addCleanup(odom.unregister)
        self.addCleanup(pilot.unregister)

        def speed(value):
            command.linear.x = value
            pilot.publish(command)
            return moving and moving[-1]

        nodes = [
            Program(*MUX_COMMAND),
            Program("rosrun", "fake_turtlebot_sim", "fake_turtlebot.py"),
        ]
        for node in nodes:
            self.addCleanup(node.__exit__)
        wait_for(lambda: speed(0.2), "robot that moves")
        with hung_master():
            for bad in (math.nan, 5.0, -5.0):
                speed(bad)
            wait_for(lambda: speed(0.0) == 0.0, "robot that obeys zero")
            wait_for(lambda: speed(0.2), "robot that obeys")


class FaultsOfThePeers(unittest.TestCase):
    """Whoever else speaks to a node."""

    def setUp(self):
        self.velocities = []
        self.robot = rospy.Subscriber("cmd_vel", Twist, self.velocities.append)
        self.addCleanup(self.robot.unregister)

    def joy2twist(self, *parameters):
        program = Program("rosrun", "joy2twist", "joy2twist.py", *parameters)
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
            wait_for(lambda: "sent 50" in second.output, "second joystick")
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
            bad.publish(Wire(raw=raw))
            wait_for(lambda said=said: node.output.count("cannot be read") > said, "warning")
            del self.velocities[:]
            wait_for(lambda: bad.publish(good) or self.velocities, f"velocity after {raw!r}")

    def test_a_length_that_lies_makes_nobody_deaf(self):
        node = self.joy2twist()
        bad = self.publisher(Wire)
        good = Wire(raw=whole(HELD))
        wait_for(lambda: bad.publish(good) or self.velocities, "velocity")
        for length in (10**6, 3):
            said = node.output.count("cannot be read")
            for connection in bad.impl.connections:
                connection._connection.socket.sendall(struct.pack("<I", length))
            wait_for(
                lambda said=said: bad.publish(good) or node.output.count("cannot be read") > said,
                f"warning about {length} bytes",
            )
            del self.velocities[:]
            wait_for(lambda: bad.publish(good) or self.velocities, "velocity")

    def test_a_peer_that_says_nothing_holds_up_nobody(self):
        self.joy2twist()
        simulator = Program("rosrun", "fake_turtlebot_sim", "fake_turtlebot.py")
        self.addCleanup(simulator.__exit__)
        for node, topic, kind in (
            (DRIVER, "/cmd_vel", Twist),
            (BASE, "/odom", Odometry),
        ):
            way = wait_for(lambda node=node, topic=topic: way_to(node, topic), topic)
            with socket.create_connection((way[1], way[2])) as silent:
                silent.settimeout(DEADLINE_S)
                began = time.monotonic()
                subscriber = rospy.Subscriber(topic, kind)
                wait_for(subscriber.get_num_connections, f"connection to {node}")
                self.assertLess(time.monotonic() - began, 2.0 + BUSY_S)
                subscriber.unregister()
                self.assertEqual(silent.recv(1), b"")  # let go

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
    rospy.init_node("hunt")
    rostest.rosrun("ros1_tutorial_test", "hunt", "__main__", sys.argv)
