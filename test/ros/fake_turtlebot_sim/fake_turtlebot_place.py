#!/usr/bin/python3
"""Putting the robot somewhere else: RViz's 2D Pose Estimate and the two resets."""

from math import cos, sin

import rospy
from fake_turtlebot_stepping import CommandedRobot, World
from geometry_msgs.msg import PoseWithCovarianceStamped
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import JointState
from std_msgs.msg import Empty
from std_srvs.srv import Empty as EmptyService

from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import wait_for


def estimate(x, y, yaw, frame="odom"):
    message = PoseWithCovarianceStamped()
    message.header.frame_id = frame
    message.pose.pose.position.x, message.pose.pose.position.y = x, y
    message.pose.pose.orientation.z, message.pose.pose.orientation.w = sin(yaw / 2), cos(yaw / 2)
    return message


class PlaceTest(RosTest):
    @classmethod
    def setUpClass(cls):
        cls.robot, cls.joints, cls.log = CommandedRobot().__enter__(), [], []
        rospy.Subscriber("joint_states", JointState, cls.joints.append)
        rospy.Subscriber("/rosout", Log, cls.log.append)
        cls.initialpose = rospy.Publisher("initialpose", PoseWithCovarianceStamped, queue_size=1)
        topic = "mobile_base/commands/reset_odometry"
        cls.reset_odometry = rospy.Publisher(topic, Empty, queue_size=1)
        cls.world = World([cls.robot])
        for publisher in (cls.initialpose, cls.reset_odometry):
            wait_for(publisher.get_num_connections, f"subscriber of {publisher.name}")

    def setUp(self):
        """Drive to some place other than the origin, and let the robot come to rest."""
        self.world.command(self.robot, 0.5, 0.5)
        self.world.step(1.0)
        self.assertNotEqual(self.robot.now.pose, (0.0, 0.0, 0.0))

    def reaches(self, pose):
        def is_there():
            self.world.step()
            return max(abs(a - b) for a, b in zip(self.robot.now.pose, pose)) < 1e-9

        wait_for(is_there, f"robot at {pose}")

    def wheels(self):
        stamp = self.robot.now.stamp
        wait_for(lambda: self.joints[-1].header.stamp.to_sec() == stamp, "wheel joints")
        return self.joints[-1].position

    def test_a_pose_estimate_moves_the_robot_and_leaves_the_wheels(self):
        wheels = self.wheels()
        self.initialpose.publish(estimate(1.0, -2.0, 0.5))
        self.reaches((1.0, -2.0, 0.5))
        self.assertEqual(self.wheels(), wheels)

    def test_a_pose_estimate_in_another_frame_is_refused_with_a_reason(self):
        before = self.robot.now.pose
        self.initialpose.publish(estimate(1.0, 1.0, 1.0, frame="map"))
        wait_for(lambda: any("'map'" in line.msg for line in self.log), "warning about the frame")
        self.world.step(0.1)
        self.assertEqual(self.robot.now.pose, before)

    def test_the_topic_and_the_service_reset_zero_pose_and_wheels(self):
        rospy.wait_for_service("/fake_turtlebot/reset", timeout=30)
        service = rospy.ServiceProxy("/fake_turtlebot/reset", EmptyService)
        for reset in (self.reset_odometry.publish, service):
            self.setUp()
            reset()
            self.reaches((0.0, 0.0, 0.0))
            self.assertEqual(self.wheels(), (0.0, 0.0))


if __name__ == "__main__":
    run()
