"""Bodies and names of a classroom's robots: which there are, from the transforms."""

import pytest
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage

pytest.importorskip("visualization_msgs", reason="no ROS for this Python: ./tutorial setup")

from cockpit_server.classroom.node import MOST_PAIRS, base_frames, joined, markers, robots

STATIC = {
    ("world", "ada/odom"),
    ("world", "robot_2/odom"),
    # Of a student's robot_state_publisher, and of a robot that is no classroom's.
    ("ada/base_footprint", "ada/base_link"),
    ("base_footprint", "base_link"),
}
MOVING = {("ada/odom", "ada/base_footprint"), ("ada/base_link", "ada/wheel_left_link")}


def test_a_robot_has_a_base_once_it_was_seen_to_move():
    assert robots(STATIC) == robots(STATIC | MOVING) == {"ada", "robot_2"}
    assert base_frames(STATIC, MOVING) == {"ada": "ada/base_footprint"}
    both = base_frames(STATIC, MOVING | {("robot_2/odom", "robot_2/base")})
    assert both == {"ada": "ada/base_footprint", "robot_2": "robot_2/base"}
    many = [TransformStamped(child_frame_id=f"link_{n}") for n in range(MOST_PAIRS + 1)]
    assert joined(STATIC, TFMessage(many)) == STATIC  # what is kept has a bound


def test_a_body_and_the_name_above_it():
    *body, name = everything = markers("ada", "ada/base_footprint")
    assert {m.header.frame_id for m in everything} == {"ada/base_footprint"}
    assert all(m.frame_locked and m.color.a == 1.0 for m in everything)
    # A namespace and a number make a marker; of two that are alike only one would be shown.
    assert len({(m.ns, m.id) for m in everything}) == len(everything)
    assert (name.type, name.text) == (name.TEXT_VIEW_FACING, "ada")
    top = max(m.pose.position.z + m.scale.z / 2 for m in body)
    assert 0.41 < top < 0.43  # [m]: 0.420 m, TurtleBot 2's specifications
    assert name.pose.position.z - name.scale.z / 2 > top
    assert max(m.scale.y for m in body) == 0.356  # twice Kobuki's radius
