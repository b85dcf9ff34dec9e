"""From state to messages and back, without a running ROS."""

from math import cos, inf, sin

import numpy as np
import pytest
from genpy import Time
from geometry_msgs.msg import PoseWithCovarianceStamped
from hypothesis import given
from hypothesis import strategies as st

from fake_turtlebot_sim.simulator.parameters import SimulatorParameters
from fake_turtlebot_sim.simulator.robot_messages import RobotMessages, pose_on_plane
from fake_turtlebot_sim.simulator.simulated_robot import SimulatedRobot
from tutorial_testing.claims import claim

STAMP = Time(12, 34)


def pose_message(frame="odom", yaw=0.0, x=1.0, length=1.0):
    message = PoseWithCovarianceStamped()
    message.header.frame_id = frame
    message.pose.pose.position.x, message.pose.pose.position.y = x, 2.0
    message.pose.pose.orientation.z = length * sin(yaw / 2)
    message.pose.pose.orientation.w = length * cos(yaw / 2)
    return message


def told(parameters, prefix="", pose=(1 / 3, 2 / 3, 0.5)):
    """Return the messages of a robot that drives, and the robot."""
    robot = SimulatedRobot(parameters, pose)
    robot.command((0.3, -0.4), 0)
    robot.advance(0)
    messages = RobotMessages(parameters, prefix)
    messages.fill(robot, STAMP)
    return messages, robot


@claim("Odometry, transform and wheels are of one state with one stamp; periods do not drift")
def test_one_stamp_the_right_frames_the_executed_twist_and_the_wheels():
    messages, _ = told(
        SimulatorParameters(left_wheel_joint="left", right_wheel_joint="right"), "ada/"
    )
    odometry, transform, joints = messages.odometry, messages.transform, messages.joints
    assert odometry.header.stamp == transform.header.stamp == joints.header.stamp == STAMP
    assert odometry.header.frame_id == transform.header.frame_id == "ada/odom"
    assert odometry.child_frame_id == transform.child_frame_id == "ada/base_footprint"
    place, moved = odometry.pose.pose, transform.transform
    assert (place.position.x, place.position.y) == (moved.translation.x, moved.translation.y)
    assert 2 * np.arctan2(moved.rotation.z, moved.rotation.w) == pytest.approx(0.5, abs=1e-12)
    assert (place.position.x, place.position.y, place.orientation) == (1 / 3, 2 / 3, moved.rotation)
    assert (odometry.twist.twist.linear.x, odometry.twist.twist.angular.z) == (0.3, -0.4)
    assert joints.name == ["left", "right"]
    assert joints.velocity == pytest.approx((0.346 / 0.035, 0.254 / 0.035))
    pose = np.reshape(odometry.pose.covariance, (6, 6))
    assert (pose == np.diag([0.1, 0.1, 1e10, 1e10, 1e10, 0.05])).all()  # like the Kobuki
    assert not any(odometry.twist.covariance)


@pytest.mark.parametrize(("kobuki", "effort"), [(True, [0.0, 0.0]), (False, [])])
def test_the_joints_of_a_kobuki_have_an_effort_and_those_of_rbx1_have_none(kobuki, effort):
    messages, _ = told(SimulatorParameters(kobuki=kobuki))
    assert messages.joints.effort == effort


def test_with_noise_the_covariance_takes_their_place_and_the_truth_is_told():
    messages, robot = told(SimulatorParameters(wheel_noise=0.01))
    pose = np.reshape(messages.odometry.pose.covariance, (6, 6))
    assert np.linalg.matrix_rank(pose, tol=0) == 6  # at rest, too
    robot.advance(500_000_000)
    messages.fill(robot, STAMP)
    pose = np.reshape(messages.odometry.pose.covariance, (6, 6))
    assert pose[np.ix_([0, 1, 5], [0, 1, 5])] == pytest.approx(robot.covariance(), abs=1e-8)
    assert (np.diag(pose)[2:5] == 1e10).all()
    truth = messages.ground_truth
    assert truth.header.stamp == STAMP
    assert truth.pose.pose.position.x == robot.true_state().x != robot.state().x
    assert not any(truth.pose.covariance)


@given(yaw=st.floats(-3.14, 3.14), length=st.floats(0.01, 100))
def test_a_pose_on_the_plane_is_read_back(yaw, length):
    pose = pose_on_plane(pose_message(yaw=yaw, length=length), ["odom"])
    assert pose == pytest.approx((1.0, 2.0, yaw), abs=1e-9)


@pytest.mark.parametrize(("message", "part"), [
    (pose_message(frame="map"), "frame 'map'; give it in odom or world"),
    (pose_message(x=inf), "finite"),
    (pose_message(length=0.0), "heading"),
])  # fmt: skip
def test_what_is_no_pose_on_the_plane_is_refused(message, part):
    with pytest.raises(ValueError, match=part):
        pose_on_plane(message, ["odom", "world"])
