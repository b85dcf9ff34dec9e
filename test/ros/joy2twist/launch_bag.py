"""launch_bag.launch: one velocity for every joystick message, and after Ctrl-C a standing robot."""

import os

import rospkg
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy

from tutorial_testing.processes import Program
from tutorial_testing.robot import Robot
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import wait_for

RATE_HZ = 50  # joy.bag and simulation
SAMPLE_S = 6.0  # how much is looked at; the tour begins with a second of rest


class LaunchBagTest(RosTest):
    def test_it_drives_until_ctrl_c(self):
        cmd_vel, robot = self.record("/cmd_vel", Twist), self.enter(Robot())
        folder = os.path.join(rospkg.RosPack().get_path("joy2twist"), "launch")
        command = f"cd '{folder}' && exec roslaunch launch_bag.launch rviz:=false"
        with Program("sh", "-c", command) as launch:
            wait_for(lambda: robot.odometry and cmd_vel, "first messages")
            joy = self.record("/joy", Joy)  # last: every joy below has its cmd_vel above
            robot.first(lambda moment: moment.v > 0.1, "moving robot")
            wait_for(lambda: len(joy) > SAMPLE_S * RATE_HZ, "joystick messages")
            expected = [(message.axes[1], message.axes[0]) for message in joy]
            self.assertGreater(len(set(expected)), RATE_HZ)

            def found():
                sent = [(twist.linear.x, twist.angular.z) for twist in cmd_vel]
                starts = range(len(sent) - len(expected) + 1)
                return any(sent[start : start + len(expected)] == expected for start in starts)

            wait_for(found, "velocities of the joystick, one for one")
            wait_for(lambda: cmd_vel[-1].linear.x > 0.1, "driving robot")
            self.end(launch)
            wait_for(lambda: not launch.left_behind(), "end of every process")
            wait_for(lambda: cmd_vel[-1] == Twist(), "zero as the last velocity")
            # Where a node has not ended after 15 s, roslaunch says so, and kills it.
            self.assertNotIn("escalating", launch.output)
