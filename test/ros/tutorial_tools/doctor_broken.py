#!/usr/bin/python3
"""doctor.py where something is broken: no master, dead nodes, names that nobody knows."""

import os
import signal
import socket
import sys

import rosgraph
import rosnode
import rospy
import rostest
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy
from std_msgs.msg import String

from tutorial_testing.doctor_run import DoctorTest
from tutorial_testing.nodes import init_node, node_path
from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for


class BrokenTest(DoctorTest):
    def test_no_master(self):
        self.wrong("nothing listens", "start roscore", ROS_MASTER_URI="http://localhost:9")
        self.wrong("http://HOST:PORT", ROS_MASTER_URI="moon")
        self.wrong("http://HOST:PORT", ROS_MASTER_URI="http://localhost:moon")
        self.wrong("looked up", ROS_MASTER_URI="http://robot.invalid:11311")

    def test_a_master_that_hangs(self):
        with socket.create_server(("localhost", 0)) as server:
            port = server.getsockname()[1]
            self.wrong("does not answer", ROS_MASTER_URI=f"http://localhost:{port}")

    def test_a_node_that_died(self):
        with Program(node_path("beginner_tutorials", "talker.py"), "--unique") as talker:
            wait_for(lambda: "hello" in talker.output, "talker")
            for pid in talker.left_behind():
                os.kill(pid, signal.SIGKILL)
            talker.wait()
            self.wrong("/talker at http://", "has died", "rosnode cleanup")
        rosnode.cleanup_master_blacklist(rosgraph.Master("/test"), ["/talker"])
        self.assertNotIn("/talker", rosnode.get_node_names())

    def register(self, uri):
        master = rosgraph.Master("/far")
        master.registerPublisher("/far", "std_msgs/Empty", uri)
        self.addCleanup(master.unregisterPublisher, "/far", uri)

    def test_a_node_on_a_machine_whose_name_nobody_knows(self):
        self.register("http://robot.invalid:1234/")
        self.wrong('/far at http://robot.invalid:1234/: "robot.invalid" cannot be looked up here')

    def test_a_node_that_hangs(self):
        with socket.create_server(("localhost", 0)) as server:
            self.register(f"http://localhost:{server.getsockname()[1]}/")
            self.wrong("/far at ", "does not answer")

    def test_a_joystick_that_nobody_drives_with_and_a_mux_that_listens_to_another(self):
        joystick = rospy.Publisher("joy", Joy, queue_size=1)
        self.addCleanup(joystick.unregister)
        self.wrong("nothing turns /joy into velocities")
        with Program("roslaunch", "joy2twist", "joy2twist_turtlebot.launch") as driver:
            wait_for(joystick.get_num_connections, "joy2twist")
            self.wrong("nobody listens to /cmd_vel_mux/input/teleop of /myjoystick2twist")
            mux = rospy.Publisher("cmd_vel_mux/active", String, queue_size=1, latch=True)
            base = rospy.Subscriber("cmd_vel_mux/input/teleop", Twist, lambda _: None)
            self.addCleanup(mux.unregister)
            self.addCleanup(base.unregister)
            mux.publish("Navigation")
            wait_for(base.get_num_connections, "connection")
            self.wrong('lets "Navigation" through, and not /cmd_vel_mux/input/teleop')
            self.wrong("/myjoystick2twist says: waiting for the joystick")
            driver.interrupt()
            driver.wait()


if __name__ == "__main__":
    init_node("doctor_broken")
    rostest.rosrun("ros1_tutorial_test", "doctor_broken", BrokenTest, sys.argv)
