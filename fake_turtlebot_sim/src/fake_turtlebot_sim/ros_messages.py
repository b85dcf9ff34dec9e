"""From the state of a robot to the messages that tell it, all with one stamp.

Frames as REP-105 orders them: the pose of the base in the odometry frame, the twist in the frame
of the base. The message objects are made once and filled again for every state: rospy copies a
message when it publishes it, and making a new Odometry would cost more than all the rest.
"""

from math import cos, sin

from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState

# Diagonal of the pose covariance [m2, rad2] that kobuki_node publishes (odometry.cpp): huge for
# what a robot on a floor cannot know. Its twist covariance is left at zero, "unknown".
POSE_COVARIANCE = (0.1, 0.1, 1e10, 1e10, 1e10, 0.05)


class RobotMessages:
    """The odometry, transform and wheel joints of one robot."""

    def __init__(self, odom_frame, base_frame, wheel_joints):
        """Name the frames and the joints, (left, right)."""
        self.odometry = Odometry()
        self.odometry.header.frame_id = odom_frame
        self.odometry.child_frame_id = base_frame
        self.odometry.pose.covariance = [0.0] * 36
        self.odometry.pose.covariance[::7] = POSE_COVARIANCE
        self.transform = TransformStamped()
        self.transform.header.frame_id = odom_frame
        self.transform.child_frame_id = base_frame
        # One quaternion for both, so that they are equal to the last bit.
        self.transform.transform.rotation = self.odometry.pose.pose.orientation
        self.joints = JointState()
        self.joints.name = list(wheel_joints)

    def fill(self, state, stamp):
        """Tell the RobotState of the instant `stamp`."""
        odometry, transform, joints = self.odometry, self.transform, self.joints
        odometry.header.stamp = transform.header.stamp = joints.header.stamp = stamp
        position, translation = odometry.pose.pose.position, transform.transform.translation
        position.x = translation.x = state.x
        position.y = translation.y = state.y
        orientation = odometry.pose.pose.orientation
        orientation.z = sin(0.5 * state.yaw)
        orientation.w = cos(0.5 * state.yaw)
        odometry.twist.twist.linear.x = state.v
        odometry.twist.twist.angular.z = state.w
        joints.position = (state.left_angle, state.right_angle)
        joints.velocity = (state.left_rate, state.right_rate)
