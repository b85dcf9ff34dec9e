"""The odometry, transform and wheel joints of one robot, for the driver and the simulation.

The frames are those of REP-105: the pose of the base is in the odometry frame, the twist in the
frame of the base. The message objects are created once and filled again for every state: rospy
copies a message when it publishes it, and a new Odometry would cost more than all the rest.
"""

from __future__ import annotations

from math import cos, sin
from typing import Any, Sequence

from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState

# Diagonal of the pose covariance [m2, rad2]: huge where a robot on a plane knows nothing, larger
# for the heading without the gyro. The twist's is zero, "unknown" (odometry.cpp).
POSE_COVARIANCE = (0.1, 0.1, 1e10, 1e10, 1e10, 0.05)
YAW_VARIANCE_OF_WHEELS = 0.2


class OdometryMessages:
    """The messages of odom, /tf and joint_states for one state, with one stamp."""

    def __init__(self, odom_frame: str, base_frame: str, joints: Sequence[str]) -> None:
        """Take the names of the frames, and of the joints of the left and the right wheel."""
        self.odometry = Odometry()
        self.odometry.header.frame_id = odom_frame
        self.odometry.child_frame_id = base_frame
        self.odometry.pose.covariance = [0.0] * 36
        self.odometry.pose.covariance[::7] = POSE_COVARIANCE
        self.transform = TransformStamped()
        self.transform.header.frame_id = odom_frame
        self.transform.child_frame_id = base_frame
        # Both share one quaternion, so that they are equal to the last bit.
        self.transform.transform.rotation = self.odometry.pose.pose.orientation
        self.joints = JointState(name=list(joints))

    def write(self, state: Any, stamp: Any) -> None:
        """Write a state, with the fields of odometry.OdometryState, into all messages."""
        fill_odometry(self.odometry, state, stamp)
        self.transform.header.stamp = self.joints.header.stamp = stamp
        self.transform.transform.translation.x = state.x
        self.transform.transform.translation.y = state.y
        self.joints.position = (state.left_angle, state.right_angle)
        self.joints.velocity = (state.left_rate, state.right_rate)


def fill_odometry(odometry: Odometry, state: Any, stamp: Any) -> None:
    """Write the pose and the twist of a state into an Odometry."""
    odometry.header.stamp = stamp
    odometry.pose.pose.position.x = state.x
    odometry.pose.pose.position.y = state.y
    odometry.pose.pose.orientation.z = sin(0.5 * state.yaw)
    odometry.pose.pose.orientation.w = cos(0.5 * state.yaw)
    odometry.twist.twist.linear.x = state.v
    odometry.twist.twist.angular.z = state.w
