#!/usr/bin/python3
"""doctor.py beside launch_bag.launch: all is well, and one thing after the other is not."""

import sys

import rospy
import rostest
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry

from tutorial_testing.doctor_run import DoctorTest
from tutorial_testing.nodes import init_node
from tutorial_testing.waiting import wait_for

NOBODYS = "192.0.2.7"  # an address for documentation (RFC 5737)


class WellTest(DoctorTest):
    @classmethod
    def setUpClass(cls):
        moving = []

        def look(odometry):
            if odometry.twist.twist.linear.x > 0.1:
                moving.append(True)

        robot = rospy.Subscriber("/odom", Odometry, look)
        wait_for(lambda: moving, "moving robot")
        robot.unregister()

    def test_all_is_well(self):
        code, levels = self.doctor()
        self.assertEqual((code, levels["wrong"]), (0, []))
        way = "/rosbag -> /joy -> /myjoystick2twist -> /cmd_vel -> /fake_turtlebot"
        self.assertTrue(any(way in line for line in levels["ok"]), levels)
        self.assertTrue(any("says: driving" in line for line in levels["ok"]), levels)

    def test_a_wrong_address_of_this_machine(self):
        lines = self.wrong(f"ROS_IP={NOBODYS} is no address of this machine", ROS_IP=NOBODYS)
        self.assertEqual(len(lines), 1)
        self.wrong("cannot be looked up", ROS_HOSTNAME="nobody.invalid")

    def test_a_second_driver(self):
        rival = rospy.Publisher("/cmd_vel", Twist, queue_size=1)
        self.addCleanup(rival.unregister)
        self.wrong("/cmd_vel is sent by /doctor_well, /myjoystick2twist at once")

    def test_simulated_time_without_a_clock(self):
        rospy.set_param("/use_sim_time", True)
        self.addCleanup(rospy.delete_param, "/use_sim_time")
        self.wrong("no /clock arrives")


if __name__ == "__main__":
    init_node("doctor_well")
    rostest.rosrun("ros1_tutorial_test", "doctor_well", WellTest, sys.argv)
