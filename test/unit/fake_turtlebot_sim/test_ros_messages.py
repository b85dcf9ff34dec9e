"""State to messages and back; the message classes need no running ROS."""

from math import cos, inf, nan, pi, sin

import numpy as np
import pytest
from genpy import Time
from geometry_msgs.msg import PoseWithCovarianceStamped
from hypothesis import given
from hypothesis import strategies as st

from fake_turtlebot_sim.simulator.parameters import Parameters
from fake_turtlebot_sim.simulator.ros_messages import RobotMessages, pose_on_floor, static_transform
from fake_turtlebot_sim.simulator.simulated_robot import RobotState, SimulatedRobot

STATE = RobotState(1.0, 2.0, 0.5, 0.3, -0.4, 10.0, 11.0, 5.0, 6.0)
STAMP = Time(12, 34)


def messages():
    return RobotMessages(Parameters(left_wheel_joint="left", right_wheel_joint="right"))


def pose_message(frame="odom", yaw=0.0, x=1.0, length=1.0):
    message = PoseWithCovarianceStamped()
    message.header.frame_id = frame
    message.pose.pose.position.x, message.pose.pose.position.y = x, 2.0
    message.pose.pose.orientation.z = length * sin(yaw / 2)
    message.pose.pose.orientation.w = length * cos(yaw / 2)
    return message


def test_one_stamp_and_the_right_frames():
    told = messages()
    told.fill(STATE, STAMP)
    headers = (told.odometry.header, told.transform.header, told.joints.header)
    assert [header.stamp for header in headers] == [STAMP] * 3
    assert [header.frame_id for header in headers] == ["odom", "odom", ""]
    assert told.odometry.child_frame_id == told.transform.child_frame_id == "base_footprint"


@given(x=st.floats(-1e3, 1e3), y=st.floats(-1e3, 1e3), yaw=st.floats(-pi, pi))
def test_the_transform_is_the_odometry_to_the_last_bit(x, y, yaw):
    told = messages()
    told.fill(STATE._replace(x=x, y=y, yaw=yaw), STAMP)
    pose, transform = told.odometry.pose.pose, told.transform.transform
    assert (pose.position.x, pose.position.y, pose.position.z) == (x, y, 0.0)
    assert (transform.translation.x, transform.translation.y, transform.translation.z) == (x, y, 0)
    assert transform.rotation == pose.orientation
    q = pose.orientation
    assert q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w == pytest.approx(1, abs=1e-12)
    assert 2 * np.arctan2(q.z, q.w) == pytest.approx(yaw, abs=1e-12)


def test_the_executed_twist_and_the_wheels():
    told = messages()
    told.fill(STATE, STAMP)
    assert (told.odometry.twist.twist.linear.x, told.odometry.twist.twist.angular.z) == (0.3, -0.4)
    assert told.joints.name == ["left", "right"]
    assert told.joints.position == (10.0, 11.0)
    assert told.joints.velocity == (5.0, 6.0)


def test_covariances_of_the_kobuki():
    told = messages()
    told.fill(STATE, STAMP)
    pose = np.reshape(told.odometry.pose.covariance, (6, 6))
    assert (pose == np.diag([0.1, 0.1, 1e10, 1e10, 1e10, 0.05])).all()
    assert not any(told.odometry.twist.covariance)


def test_a_covariance_that_is_known_takes_their_place():
    told, known = messages(), np.array([[4.0, 1.0, 2.0], [1.0, 5.0, 3.0], [2.0, 3.0, 6.0]])
    told.fill_covariance(known)
    pose = np.reshape(told.odometry.pose.covariance, (6, 6))
    assert pose[np.ix_([0, 1, 5], [0, 1, 5])] == pytest.approx(known, abs=1e-8)
    assert (np.diag(pose)[2:5] == 1e10).all()
    told.fill_covariance(np.zeros((3, 3)))
    assert np.linalg.matrix_rank(np.reshape(told.odometry.pose.covariance, (6, 6)), tol=0) == 6


def test_messages_filled_again_keep_nothing_of_the_last_state():
    told = messages()
    told.fill(STATE, STAMP)
    told.fill(RobotState(*[0.0] * 9), Time(13, 0))
    fresh = messages()
    fresh.fill(RobotState(*[0.0] * 9), Time(13, 0))
    assert told.odometry == fresh.odometry
    assert told.transform == fresh.transform
    assert told.joints == fresh.joints


@given(yaw=st.floats(-3.14, 3.14), length=st.floats(0.01, 100))
def test_a_pose_on_the_floor_is_read_back(yaw, length):
    pose = pose_on_floor(pose_message(yaw=yaw, length=length), ["odom"])
    assert pose == pytest.approx((1.0, 2.0, yaw), abs=1e-9)


@pytest.mark.parametrize(
    ("message", "part"),
    [
        (pose_message(frame="map"), "frame 'map'; give it in odom or world"),
        (pose_message(frame=""), "frame ''"),
        (pose_message(x=nan), "finite"),
        (pose_message(x=inf), "finite"),
        (pose_message(length=0.0), "heading"),
        (pose_message(length=nan), "finite"),
    ],
)
def test_what_is_no_pose_on_the_floor_is_refused(message, part):
    with pytest.raises(ValueError, match=part):
        pose_on_floor(message, ["odom", "world"])


def test_a_static_transform_lays_one_frame_on_the_other():
    laid = static_transform("world", "alice/odom", STAMP)
    assert (laid.header.frame_id, laid.child_frame_id, laid.header.stamp) == (
        "world",
        "alice/odom",
        STAMP,
    )
    assert laid.transform.rotation.w == 1.0


def test_a_robot_with_errors_tells_its_covariance_and_the_truth():
    parameters = Parameters(wheel_noise=0.01)
    robot = SimulatedRobot(parameters.robot_model("alice"))
    robot.command((0.5, 1.0), 0)
    robot.advance(500_000_000)
    told = RobotMessages(parameters, prefix="alice/")
    told.tell(robot, STAMP)
    assert told.odometry.header.frame_id == told.ground_truth.header.frame_id == "alice/odom"
    assert told.ground_truth.child_frame_id == "alice/base_footprint"
    assert told.ground_truth.header.stamp == STAMP
    assert told.ground_truth.pose.pose.position.x == robot.true_state().x != robot.state().x
    assert told.odometry.pose.covariance[35] == pytest.approx(robot.covariance()[2, 2] + 1e-9)
    assert not any(told.ground_truth.pose.covariance)
