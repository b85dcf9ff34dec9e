"""The two functions that programs of ROS by Example import."""

from math import cos, pi, sin

import pytest
from geometry_msgs.msg import Quaternion

from rbx1_nav.transform_utils import normalize_angle, quat_to_angle
from tutorial_testing.claims import claim

pytestmark = claim("Programs after ROS by Example find quat_to_angle and normalize_angle")


@pytest.mark.parametrize("yaw", [0.0, 1.0, -1.0, 3.1, -3.1])
@pytest.mark.parametrize("roll", [0.0, 0.5])
def test_the_angle_of_a_quaternion_is_its_yaw(yaw, roll):
    """The rotation is about x, then about z."""
    c, s, rolled_c, rolled_s = cos(yaw / 2), sin(yaw / 2), cos(roll / 2), sin(roll / 2)
    quaternion = Quaternion(c * rolled_s, s * rolled_s, s * rolled_c, c * rolled_c)
    assert quat_to_angle(quaternion) == pytest.approx(yaw)


@pytest.mark.parametrize(
    ("angle", "normal"),
    [(0.0, 0.0), (pi, pi), (-pi, -pi),
     (4.0, 4.0 - 2 * pi), (-4.0, 2 * pi - 4.0), (50.0, 50.0 - 16 * pi)],
)  # fmt: skip
def test_an_angle_is_turned_by_whole_circles(angle, normal):
    assert normalize_angle(angle) == pytest.approx(normal)
