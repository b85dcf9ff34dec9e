#!/usr/bin/python3
"""launch_bag.launch: one velocity for every joystick message, and after Ctrl-C a standing robot."""

import os

import rosbag
import rospkg
import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import JointState, Joy
from tf2_msgs.msg import TFMessage

from tutorial_testing.processes import Program
from tutorial_testing.robot import Robot
from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import wait_for
from tutorial_tools.demo.program import NODES, RVIZ_NODE

RATE_HZ = 50  # of joy.bag and of the simulation
# A recording without autorepeat and without any button: time [s] and axes of each message.
SPARSE = ((0.0, (0.0, 0.0)), (1.0, (0.0, 1.0)), (3.5, (0.0, 0.0)), (6.5, (0.0, 0.0)))
SPARSE_M = 2.5  # the robot drives at 1 m/s between the second and the third
SAMPLE_S = 6.0  # how much is looked at; the tour begins with a second of rest


class LaunchBagTest(RosTest):
    def test_it_drives_until_ctrl_c(self):
        cmd_vel, robot = self.record("/cmd_vel", Twist), self.enter(Robot())
        tf, joints = self.record("/tf", TFMessage), self.record("/joint_states", JointState)
        folder = os.path.join(rospkg.RosPack().get_path("joy2twist"), "launch")
        command = f"cd '{folder}' && exec roslaunch launch_bag.launch rviz:=false"
        with Program("sh", "-c", command) as launch:
            wait_for(lambda: robot.odometry and cmd_vel, "first messages")
            joy = self.record("/joy", Joy)  # last: every joy below has its cmd_vel above
            robot.first(lambda moment: moment.v > 0.1, "moving robot")
            wait_for(lambda: len(joy) > SAMPLE_S * RATE_HZ, "joystick messages")
            sample = joy[:]
            self.check_velocities(sample, cmd_vel)
            self.check_model(joints, tf)
            wait_for(lambda: cmd_vel[-1].linear.x > 0.1, "driving robot")
            self.end(launch)
            wait_for(lambda: not launch.left_behind(), "end of every process")
            wait_for(lambda: cmd_vel[-1] == Twist(), "zero as the last velocity")
            # Where a node has not ended after 15 s, roslaunch says so, and kills it.
            self.assertNotIn("escalating", launch.output)

    def test_a_recording_without_autorepeat_drives_all_the_while(self):
        path = str(self.folder() / "sparse.bag")
        with rosbag.Bag(path, "w") as bag:
            for at_s, axes in SPARSE:
                bag.write("/joy", Joy(axes=axes, buttons=[0] * 12), rospy.Time(1 + at_s))
        bag = (f"bag:={path}", "rviz:=false", "cockpit:=false")
        robot = self.enter(Robot())
        with Program("roslaunch", "joy2twist", "launch_bag.launch", *bag) as launch:
            robot.first(lambda moment: moment.moves, "moving robot")
            robot.wait_for_rest()
            self.assertAlmostEqual(robot.now.x, SPARSE_M, delta=0.05 * SPARSE_M)
            self.end(launch)
        with Program(
            "roslaunch", "joy2twist", "launch_joy_node_realTurtlebot.launch", *bag
        ) as none:
            self.assertNotEqual(none.wait(), 0)
            self.assertIn("LB (button 4) or RB (button 5), the dead-man button of", none.output)
            self.assertNotIn("process[", none.output)

    def check_velocities(self, joy, cmd_vel):
        """Find the messages in the velocities, one for one and with their values."""
        expected = [(message.axes[1], message.axes[0]) for message in joy]
        self.assertGreater(len(set(expected)), RATE_HZ)

        def found():
            sent = [(twist.linear.x, twist.angular.z) for twist in cmd_vel]
            starts = range(len(sent) - len(expected) + 1)
            return any(sent[start : start + len(expected)] == expected for start in starts)

        wait_for(found, "velocities of the joystick, one for one")
        for twist in cmd_vel:
            others = (twist.linear.y, twist.linear.z, twist.angular.x, twist.angular.y)
            self.assertEqual(others, (0, 0, 0, 0))

    def check_model(self, joints, tf):
        self.assertEqual(set(joints[-1].name), {"wheel_left_joint", "wheel_right_joint"})
        for before, after in zip(joints[0].position, joints[-1].position):
            self.assertGreater(after - before, 1.0)  # [rad]: some 0.04 m of way and more
        children = {t.child_frame_id for message in tf for t in message.transforms}
        self.assertLessEqual({"wheel_left_link", "wheel_right_link"}, children)

    def nodes(self, *arguments, **environment):
        """The names of the nodes that launch_bag.launch would start."""
        command = ("roslaunch", "--nodes", "joy2twist", "launch_bag.launch", *arguments)
        with Program(*command, **environment) as listing:
            self.assertEqual(listing.wait(), 0, listing.output)
            return listing.output.split()

    def test_rviz_opens_where_there_is_a_screen_or_where_it_is_asked_for(self):
        for display, asked, opens in (
            (":99", (), True), ("", (), False), ("", ["rviz:=true"], True),
            (":99", ["rviz:=false"], False),
        ):  # fmt: skip
            nodes = self.nodes("cockpit:=false", *asked, DISPLAY=display)
            # The demonstration knows them, too.
            self.assertEqual(sorted(nodes), sorted([*NODES, *[RVIZ_NODE] * opens]))


if __name__ == "__main__":
    run()
