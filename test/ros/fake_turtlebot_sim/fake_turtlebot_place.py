#!/usr/bin/python3
"""Putting the robot somewhere else: RViz's 2D Pose Estimate and the two resets."""

from math import cos, sin

import rospy
from fake_turtlebot_stepping import SteppedRobot
from geometry_msgs.msg import PoseWithCovarianceStamped
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import JointState
from std_msgs.msg import Empty
from std_srvs.srv import Empty as EmptyService

from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import wait_for


def estimate(x, y, yaw, frame):
    message = PoseWithCovarianceStamped()
    message.header.frame_id = frame
    message.pose.pose.position.x, message.pose.pose.position.y = x, y
    message.pose.pose.orientation.z, message.pose.pose.orientation.w = sin(yaw / 2), cos(yaw / 2)
    return message


class PlaceTest(RosTest):
    def reaches(self, pose):
        def is_there():
            self.robot.step()
            return max(abs(a - b) for a, b in zip(self.robot.now.pose, pose)) < 1e-9

        wait_for(is_there, f"robot at {pose}")

    def wheels(self):
        stamp = self.robot.now.stamp
        wait_for(lambda: self.joints[-1].header.stamp.to_sec() == stamp, "wheel joints")
        return self.joints[-1].position

    def test_a_pose_estimate_and_two_resets_put_the_robot_elsewhere(self):
        log, self.joints = self.record("/rosout", Log), self.record("joint_states", JointState)
        initialpose = self.publisher("initialpose", PoseWithCovarianceStamped)
        reset_odometry = self.publisher("mobile_base/commands/reset_odometry", Empty)
        service = rospy.ServiceProxy("/fake_turtlebot/reset", EmptyService)
        service.wait_for_service(30)
        self.robot = self.enter(SteppedRobot())
        for publisher in (initialpose, reset_odometry):
            wait_for(publisher.get_num_connections, f"subscriber of {publisher.name}")
        for reset in (reset_odometry.publish, service):
            self.robot.command(0.5, 0.5)
            self.robot.step(1.0)
            before, wheels = self.robot.now.pose, self.wheels()
            self.assertNotIn(0.0, (*before, *wheels))
            del log[:]
            initialpose.publish(estimate(1.0, 1.0, 1.0, frame="map"))
            wait_for(lambda: any("'map'" in line.msg for line in log), "warning about the frame")
            self.robot.step(0.1)
            self.assertEqual(self.robot.now.pose, before)
            initialpose.publish(estimate(1.0, -2.0, 0.5, frame="odom"))
            self.reaches((1.0, -2.0, 0.5))
            self.assertEqual(self.wheels(), wheels)
            reset()
            self.reaches((0.0, 0.0, 0.0))
            self.assertEqual(self.wheels(), (0.0, 0.0))


if __name__ == "__main__":
    run()
