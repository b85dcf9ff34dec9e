"""A robot's state as messages that share one stamp, and a pose message as a pose."""

from __future__ import annotations

from math import atan2, cos, hypot, isfinite, sin
from typing import Any, Sequence, Tuple

from geometry_msgs.msg import TransformStamped, Vector3
from nav_msgs.msg import Odometry

from fake_turtlebot_sim.simulator.differential_drive import Pose, composed
from fake_turtlebot_sim.simulator.parameters import SimulatorParameters
from fake_turtlebot_sim.simulator.simulated_robot import SimulatedRobot
from kobuki_protocol.odometry_messages import OdometryMessages, fill_odometry

Place = Tuple[float, float, float]  # x, y, z [m]
ORIGIN: Place = (0.0, 0.0, 0.0)
X_Y_YAW = (0, 1, 5)  # the rows of x, y and yaw in the 6 x 6 covariance of a message
# Added to the variances of x, y and yaw, because filters cannot invert a zero covariance.
LEAST_VARIANCE = 1e-9  # [m2, rad2]


class RobotMessages(OdometryMessages):
    """The odometry, transform and wheel joints of one robot, and its ground truth if it differs."""

    def __init__(self, parameters: SimulatorParameters, prefix: str = "") -> None:
        """Take the names of frames and joints from the parameters; prefix: for the frames."""
        odom_frame, base_frame = prefix + parameters.odom_frame, prefix + parameters.base_frame
        joints = parameters.left_wheel_joint, parameters.right_wheel_joint
        super().__init__(odom_frame, base_frame, joints)
        self.ground_truth = Odometry()
        self.ground_truth.header.frame_id = odom_frame
        self.ground_truth.child_frame_id = base_frame
        self.in_map = TransformStamped()  # the origin of the odometry, in the frame of the world
        self.in_map.header.frame_id, self.in_map.child_frame_id = parameters.map_frame, odom_frame
        if parameters.world:
            self.ground_truth.header.frame_id = parameters.map_frame
        self.joints.effort = [0.0, 0.0] if parameters.kobuki else []  # as kobuki_node has it

    def fill(self, robot: SimulatedRobot, stamp: Any) -> None:
        """Write the robot's state at `stamp` into all messages."""
        state = robot.state()
        self.write(state, stamp)
        covariance = robot.covariance()
        if covariance is not None:
            self._fill_covariance(covariance)
        if robot.odometry_differs:
            truth = robot.true_state()
            fill_odometry(self.ground_truth, truth, stamp)
            x, y, yaw = between_frames(truth[:3], state[:3])
            self.in_map.header.stamp = stamp
            self.in_map.transform.translation.x, self.in_map.transform.translation.y = x, y
            self.in_map.transform.rotation.z = sin(0.5 * yaw)
            self.in_map.transform.rotation.w = cos(0.5 * yaw)

    def _fill_covariance(self, covariance: Any) -> None:
        for row, message_row in enumerate(X_Y_YAW):
            for column, message_column in enumerate(X_Y_YAW):
                value = float(covariance[row, column])
                self.odometry.pose.covariance[6 * message_row + message_column] = value
            self.odometry.pose.covariance[7 * message_row] += LEAST_VARIANCE


def between_frames(outer: Pose, inner: Pose) -> Pose:
    """Return the pose of an inner frame, given a body's pose in the outer and in the inner one."""
    return composed((outer[0], outer[1], outer[2] - inner[2]), (-inner[0], -inner[1], 0.0))


def static_transform(frame: tuple[str, str, Place], stamp: Any) -> TransformStamped:
    """Return the TransformStamped, without rotation, of (parent, child, place [m] in it)."""
    transform = TransformStamped()
    transform.header.stamp = stamp
    transform.header.frame_id, transform.child_frame_id, (x, y, z) = frame
    transform.transform.translation = Vector3(x, y, z)
    transform.transform.rotation.w = 1.0
    return transform


def pose_on_plane(message: Any, frames: Sequence[str]) -> Pose:
    """Return the Pose of a PoseWithCovarianceStamped in one of the frames. Raises ValueError."""
    frame = message.header.frame_id.lstrip("/")
    if frame not in frames:
        raise ValueError(f"the pose is in the frame {frame!r}; give it in {' or '.join(frames)}")
    position, q = message.pose.pose.position, message.pose.pose.orientation
    # Not normalised: atan2 does not depend on the length of the quaternion.
    ahead = q.w * q.w + q.x * q.x - q.y * q.y - q.z * q.z
    aside = 2.0 * (q.w * q.z + q.x * q.y)
    pose = (position.x, position.y, atan2(aside, ahead))
    if not all(map(isfinite, pose)) or hypot(ahead, aside) < 1e-6:
        raise ValueError("the pose has no finite position or no heading on the plane")
    return pose
