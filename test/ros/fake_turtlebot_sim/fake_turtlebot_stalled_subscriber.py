#!/usr/bin/python3
"""A subscriber that connects and never reads does not hold up the robot or the others."""

import socket
import sys
import unittest
from xmlrpc.client import ServerProxy

import rosgraph
import rospy
import rostest
from nav_msgs.msg import Odometry
from rosgraph.network import encode_ros_handshake_header

from tutorial_testing.nodes import init_node
from tutorial_testing.waiting import DEADLINE_S, wait_for

NODE, STALLED = "/fake_turtlebot", "/stalled"
LATER = 12_000  # messages of 700 bytes, for which no socket has room


class StalledSubscriberTest(unittest.TestCase):
    def test_it_gets_the_newest_and_the_others_hear_everything(self):
        heard = []
        rospy.Subscriber("odom", Odometry, heard.append)
        wait_for(lambda: heard, "odometry")
        node = ServerProxy(rosgraph.Master("/test").lookupNode(NODE))
        with self.connect(node) as connection:
            wait_for(lambda: self.is_connected(node), "connection that never reads")
            count = len(heard)
            wait_for(lambda: len(heard) > count + LATER, "odometry after that")
            self.assertTrue(self.is_connected(node))
            last = heard[-1].header.seq
            numbers = self.numbers_until(connection, last)
        # Whole messages; what had no room is left out, but for the newest.
        self.assertEqual(numbers, sorted(set(numbers)))
        self.assertLess(len(numbers), last - numbers[0])
        seqs = [odometry.header.seq for odometry in heard]
        self.assertEqual(seqs, list(range(seqs[0], seqs[0] + len(seqs))))

    @staticmethod
    def connect(node):
        """Subscribe to /odom by hand, with the smallest buffer, and read nothing."""
        _, _, (_, host, port) = node.requestTopic(STALLED, "/odom", [["TCPROS"]])
        connection = socket.socket()
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1)
        connection.connect((host, port))
        header = {
            "callerid": STALLED,
            "topic": "/odom",
            "type": Odometry._type,
            "md5sum": Odometry._md5sum,
        }
        connection.sendall(encode_ros_handshake_header(header))
        return connection

    @staticmethod
    def numbers_until(connection, last):
        """The numbers of the messages that come, until the number `last` or a later one."""
        connection.settimeout(DEADLINE_S)
        numbers, stream = [], connection.makefile("rb")

        def block():
            return stream.read(int.from_bytes(stream.read(4), "little"))

        block()  # the header of the connection
        while not numbers or numbers[-1] < last:
            numbers.append(int.from_bytes(block()[:4], "little"))
        return numbers

    @staticmethod
    def is_connected(node):
        return any(STALLED in map(str, connection) for connection in node.getBusInfo("/test")[2])


if __name__ == "__main__":
    init_node("fake_turtlebot_stalled_subscriber")
    rostest.rosrun(
        "ros1_tutorial_test", "fake_turtlebot_stalled_subscriber", StalledSubscriberTest, sys.argv
    )
