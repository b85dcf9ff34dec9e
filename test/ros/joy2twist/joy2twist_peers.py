#!/usr/bin/python3
"""What joy2twist does when a subscriber or the master is killed, stopped or does not answer."""

import os
import signal
import socket
import sys
import threading
import unittest

import rosgraph
import rospy
import rostest
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy

from tutorial_testing.nodes import init_node, node_path
from tutorial_testing.processes import Program, suspend
from tutorial_testing.waiting import BUSY_S, DEADLINE_S, wait_for

LONGEST_EXIT_S = 1.5 + BUSY_S
PUBLISH_JOY = ("rostopic", "pub", "-r", "50", "joy", "sensor_msgs/Joy", "{axes: [0.0, 0.5]}")
ECHO_SPEED = ("rostopic", "echo", "-p", "cmd_vel/linear/x")


def joy2twist(*parameters, **environment):
    return Program(node_path("joy2twist", "joy2twist.py"), *parameters, **environment)


def send_signal(number, program):
    for pid in program.left_behind():
        os.kill(pid, number)


class SubscriberTest(unittest.TestCase):
    def test_one_that_never_reads_is_not_noticed_by_the_others(self):
        speeds, came = [], threading.Event()

        def on_twist(twist):
            speeds.append(twist.linear.x)
            came.set()

        def answer_to(axis):
            came.clear()
            joystick.publish(Joy(axes=[0, axis]))
            self.assertTrue(came.wait(DEADLINE_S), "no velocity came")

        robot = rospy.Subscriber("cmd_vel", Twist, on_twist, tcp_nodelay=True)
        self.addCleanup(robot.unregister)
        joystick = rospy.Publisher("joy", Joy, queue_size=1000)
        self.addCleanup(joystick.unregister)
        with joy2twist("_log_rate:=0"), Program(*ECHO_SPEED, PYTHONUNBUFFERED="1") as echo:
            wait_for(lambda: joystick.publish(Joy(axes=[0, 0.5])) or ",0.5" in echo.output, "echo")
            suspend(echo.left_behind())
            rounds = 20_000  # more than the connection holds: see below
            for _ in range(rounds):
                answer_to(0.5)
            answer_to(0.0)
            self.assertEqual(speeds[-1], 0.0)
            send_signal(signal.SIGCONT, echo)
            wait_for(lambda: echo.output.endswith(",0.0\n"), "stop at the one that slept")
            self.assertLess(echo.output.count("\n"), rounds)


class MasterTest(unittest.TestCase):
    """On a master of its own, which is killed or stopped."""

    def setUp(self):
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            self.port = str(probe.getsockname()[1])
        self.own = {"ROS_MASTER_URI": f"http://localhost:{self.port}", "PYTHONUNBUFFERED": "1"}

    def start(self, *command):
        program = Program(*command, **self.own)
        self.addCleanup(program.__exit__)
        return program

    def start_master(self):
        # Not roscore, which has its master in a session of its own, out of reach.
        master = self.start("rosmaster", "--core", "-p", self.port)
        client = rosgraph.Master("/joy2twist_peers", self.own["ROS_MASTER_URI"])
        wait_for(client.is_online, "master")
        return master

    def start_driving(self):
        node = self.start(node_path("joy2twist", "joy2twist.py"))
        self.start(*PUBLISH_JOY)
        echo = self.start(*ECHO_SPEED)
        wait_for(lambda: ",0.5" in echo.output, "velocity")
        return node, echo

    def check_drives_on(self, echo):
        count = echo.output.count(",0.5")
        wait_for(lambda: echo.output.count(",0.5") > count + 50, "more velocities")
        self.assertNotIn(",0.0", echo.output)

    def check_end(self, node, echo):
        node.interrupt()
        self.assertEqual(node.wait(LONGEST_EXIT_S), 0)
        wait_for(lambda: echo.output.endswith(",0.0\n"), "zero")
        self.assertNotIn("Traceback", node.output)

    def test_without_its_master_it_drives_on_and_a_master_that_returns_changes_nothing(self):
        master = self.start_master()
        node, echo = self.start_driving()
        send_signal(signal.SIGKILL, master)
        self.check_drives_on(echo)
        master.wait()
        self.start_master()
        self.check_drives_on(echo)
        self.check_end(node, echo)

    def test_a_master_that_does_not_answer_does_not_hold_the_end(self):
        master = self.start_master()
        node, echo = self.start_driving()
        suspend(master.left_behind())
        self.check_drives_on(echo)
        self.check_end(node, echo)


if __name__ == "__main__":
    init_node("joy2twist_peers")
    rostest.rosrun("ros1_tutorial_test", "joy2twist_peers", "__main__", sys.argv)
