"""Launch files of joy2twist: a recording drives, and the launch ends."""

import os

import rosgraph
import rosnode
import rospkg
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy

from tutorial_testing.claims import claim
from tutorial_testing.hands import record
from tutorial_testing.processes import Program
from tutorial_testing.robot import Robot
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import wait_for

RATE_HZ = 50  # joy.bag and simulation
SAMPLE_S = 6.0  # length of the sample; the tour begins with a second of rest
FILE = "launch_joy_node_realTurtlebot.launch"
TELEOP = "/cmd_vel_mux/input/teleop"
SPEED = 0.35  # [m/s] at full deflection, config/f710_d.yaml


class LaunchFilesTest(RosTest):
    @claim(
        "`launch_bag.launch` drives one velocity for each message, and Ctrl-C leaves a standing "
        "robot"
    )
    def test_launch_bag_drives_one_velocity_for_each_joy_until_ctrl_c(self):
        cmd_vel, robot = self.record("/cmd_vel", Twist), self.enter(Robot())
        folder = os.path.join(rospkg.RosPack().get_path("joy2twist"), "launch")
        command = f"cd '{folder}' && exec roslaunch launch_bag.launch rviz:=false"
        with Program("sh", "-c", command) as launch:
            wait_for(lambda: robot.odometry and cmd_vel, "first messages")
            joy = self.record("/joy", Joy)  # last, so that cmd_vel has the answer to every Joy
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
            # roslaunch prints this when it kills a node that has not exited after 15 s.
            self.assertNotIn("escalating", launch.output)

    @claim("On a TurtleBot: remapped ...", because="end to end, by a recording")
    def test_a_recording_drives_a_turtlebot_once_and_ends_the_launch(self):
        speeds = self.record(TELEOP, Twist)
        path = record(str(self.folder() / "short.bag"))
        launch = self.start("roslaunch", "joy2twist", FILE, f"bag:={path}", "rviz:=false")
        wait_for(lambda: speeds and speeds[-1].linear.x, "velocities")
        self.assertIn("/myjoystick2twist", rosnode.get_node_names())
        publishers, _, _ = rosgraph.Master("/test").getSystemState()
        self.assertNotIn("/cmd_vel", dict(publishers))
        self.check_end(launch)
        self.assertEqual({twist.linear.x for twist in speeds}, {0.0, SPEED})
        self.assertEqual(speeds[-1], Twist())
        self.assertIn("roslaunch: rosbag has finished, which ends this launch\n", launch.output)
        self.assertNotIn("died", launch.output)  # a normal end does not look like a crash
        self.assertIn("axis 1 -> linear.x", launch.output)
        self.assertNotIn("Get from Joy", launch.output)  # it would scroll the mapping away
