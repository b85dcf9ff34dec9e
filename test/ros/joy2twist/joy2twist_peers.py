#!/usr/bin/python3
"""What joy2twist does when a subscriber does not read, or the master is gone."""

import signal
import threading

import rosgraph
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy

from tutorial_testing.nodes import node_path
from tutorial_testing.ports import free_port
from tutorial_testing.processes import Program, suspend
from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import BUSY_S, DEADLINE_S, wait_for

LONGEST_EXIT_S = 1.5 + BUSY_S
PUBLISH_JOY = ("rostopic", "pub", "-r", "50", "joy", "sensor_msgs/Joy", "{axes: [0.0, 0.5]}")
JOY2TWIST = node_path("joy2twist", "joy2twist.py")
ECHO_SPEED = ("rostopic", "echo", "-p", "cmd_vel/linear/x")


class SubscriberTest(RosTest):
    def test_one_that_never_reads_is_not_noticed_by_the_others(self):
        speeds, came = [], threading.Event()

        def on_twist(twist):
            speeds.append(twist.linear.x)
            came.set()

        def answer_to(axis):
            came.clear()
            joystick.publish(Joy(axes=[0, axis]))
            self.assertTrue(came.wait(DEADLINE_S), "no velocity came")

        self.hear("cmd_vel", Twist, on_twist)
        joystick = self.publisher("joy", Joy)
        with Program(JOY2TWIST, "_log_rate:=0"), Program(*ECHO_SPEED) as echo:
            wait_for(lambda: joystick.publish(Joy(axes=[0, 0.5])) or ",0.5" in echo.output, "echo")
            suspend(echo.left_behind())
            rounds = 20_000  # more than the connection holds: see below
            for _ in range(rounds):
                answer_to(0.5)
            answer_to(0.0)
            self.assertEqual(speeds[-1], 0.0)
            echo.signal(signal.SIGCONT)
            wait_for(lambda: echo.output.endswith(",0.0\n"), "stop at the one that slept")
            self.assertLess(echo.output.count("\n"), rounds)


class MasterTest(RosTest):
    def test_without_its_master_it_drives_on_and_stops_at_the_end(self):
        port = str(free_port())
        own = {"ROS_MASTER_URI": f"http://localhost:{port}"}
        # Not roscore, which has its master in a session of its own, out of reach.
        master = self.start("rosmaster", "--core", "-p", port, **own)
        wait_for(rosgraph.Master("/test", own["ROS_MASTER_URI"]).is_online, "master")
        node = self.start(JOY2TWIST, **own)
        self.start(*PUBLISH_JOY, **own)
        echo = self.start(*ECHO_SPEED, **own)
        wait_for(lambda: ",0.5" in echo.output, "velocity")
        master.kill()
        count = echo.output.count(",0.5")
        wait_for(lambda: echo.output.count(",0.5") > count + 50, "more velocities")
        self.assertNotIn(",0.0", echo.output)
        self.end(node, deadline_s=LONGEST_EXIT_S)
        wait_for(lambda: echo.output.endswith(",0.0\n"), "zero")


if __name__ == "__main__":
    run()
