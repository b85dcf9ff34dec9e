#!/usr/bin/python3
"""joy2twist as a program: how it starts, what it shows and how it ends."""

import time

import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy

from tutorial_testing.nodes import node_path
from tutorial_testing.processes import Program
from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import BUSY_S, wait_for

LONGEST_EXIT_S = 1.5 + BUSY_S
NOWHERE = "http://localhost:9"  # the port named "discard": no master lives there


def joy2twist(*parameters, **environment):
    return Program(node_path("joy2twist", "joy2twist.py"), *parameters, **environment)


class RunningTest(RosTest):
    """The node runs; this process is its joystick and its robot."""

    def setUp(self):
        self.speeds = []
        self.joystick = self.publisher("joy", Joy)
        self.robot = self.hear("cmd_vel", Twist, lambda t: self.speeds.append(t.linear.x))

    def forward(self):
        self.joystick.publish(Joy(axes=[0.0, 0.5, -0.25]))

    def drive(self, *parameters):
        """Start the node, and push the stick until it drives."""
        node = self.enter(joy2twist(*parameters))
        wait_for(lambda: self.forward() or self.speeds, "velocity")
        return node

    def check_stop(self, node):
        """The stick stays forward, but the last velocity is zero, and the end comes in time."""
        begin = time.monotonic()
        wait_for(lambda: self.forward() or node.ended, "end")
        self.assertLess(time.monotonic() - begin, LONGEST_EXIT_S)
        self.check_end(node)
        wait_for(lambda: self.robot.get_num_connections() == 0, "end of the connection")
        self.assertEqual(self.speeds[-1], 0.0)
        self.assertEqual(set(self.speeds[:-1]), {0.5})
        self.assertIn("Stopping the node", node.output)

    def test_ctrl_c_stops_the_robot(self):
        node = self.drive()
        node.interrupt()
        self.check_stop(node)

    def test_rosnode_kill_stops_the_robot(self):
        node = self.drive()
        with Program("rosnode", "kill", "/NewJoy2Twist") as kill:
            wait_for(lambda: self.forward() or self.speeds[-1] == 0.0, "zero")
            self.check_stop(node)
            kill.wait()

    def test_a_newer_node_of_the_same_name_takes_over(self):
        node = self.drive()
        with joy2twist():
            wait_for(lambda: self.forward() or 0.0 in self.speeds, "zero of the older node")
            zeros = len(self.speeds)
            self.check_end(node, deadline_s=LONGEST_EXIT_S)
            wait_for(lambda: self.forward() or 0.5 in self.speeds[zeros:], "newer node")

    def test_every_message_of_a_bag_is_displayed_as_in_the_tutorial(self):
        # Ten times the default, as a busy machine may hold messages back and deliver some at once.
        node = self.drive("_log_rate:=500")
        sent = [Joy(axes=[0.5] * (number % 9) + [number]) for number in range(100)]
        for joy in sent:
            self.joystick.publish(joy)
            time.sleep(1 / 50)
        values = [", ".join(f"{axis:.2f}" for axis in joy.axes) for joy in sent]
        lines = [f": /NewJoy2Twist: Get from Joy [{axes}]\n" for axes in values]
        wait_for(lambda: all(node.output.count(line) == 1 for line in lines), "100 lines")


class StartTest(RosTest):
    def test_a_mistake_and_a_missing_master_get_one_line(self):
        rospy.set_param("/wrong/joy_timeout", -1)
        for node, words in (
            (joy2twist("__name:=wrong"), ("~joy_timeout", "-1", "0 to 60 s", "/wrong")),
            (joy2twist("_axis_linear:=["), ("command-line",)),
            (joy2twist(ROS_MASTER_URI=NOWHERE), (NOWHERE, "roscore")),
            (joy2twist(ROS_MASTER_URI="nonsense"), ("'nonsense'", "http://localhost:11311")),
        ):
            self.check_mistake(node, *words)

    def test_the_mapping_is_said_in_words(self):
        with joy2twist("_scale_linear:=0.7", "_enable_button:=4", "__name:=words") as node:
            wait_for(lambda: "axis 0" in node.output, "mapping")
            self.assertIn("axis 1 -> linear.x at 0.7 m/s; hold button 4", node.output)


if __name__ == "__main__":
    run()
