"""Where a robot is, and the way that it has covered, from its odometry."""

from math import nan, pi

import pytest
from geometry_msgs.msg import Quaternion
from nav_msgs.msg import Odometry

from cockpit_server.feeds import read
from cockpit_server.motion import Motion, covered, motion
from tutorial_testing.seat_room import serialised


def test_motion_of_an_odometry_is_place_and_speed():
    odometry = Odometry()
    odometry.pose.pose.position.x, odometry.pose.pose.position.y = 1.0, -2.0
    odometry.pose.pose.orientation = Quaternion(0.0, 0.0, 1.0, 0.0)
    odometry.twist.twist.linear.x, odometry.twist.twist.angular.z = 0.5, -0.25
    assert motion(read(Odometry, serialised(odometry))) == (1.0, -2.0, pi, 0.5, -0.25)
    assert read(Odometry, serialised(odometry)[:200]) is None


@pytest.mark.parametrize(
    ("x", "yaw", "way"),
    [(1.1, 0.5, 7.1), (1.1, 0.0, 7.1), (1.6, 0.5, 7.0), (0.0, 0.0, 0.0), (nan, 0.5, 7.0)],
    ids=["drives", "drives straight", "was carried", "was reset", "is nowhere"],
)
def test_way_grows_only_by_driving(x, yaw, way):
    last = Motion(1.0 if x else 0.2, 0.0, yaw, 0.5, 0.0)
    assert covered(last, Motion(x, 0.0, yaw, 0.5, 0.0), 7.0) == pytest.approx(way)
