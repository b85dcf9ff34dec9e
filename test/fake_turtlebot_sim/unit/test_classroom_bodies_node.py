"""Markers for the bodies and names of a classroom's robots."""

import pytest

pytest.importorskip("visualization_msgs", reason="no ROS for this Python: ./tutorial setup")

from fake_turtlebot_sim.ros.classroom_bodies_node import markers
from tutorial_testing.claims import claim


@claim("classroom_bodies gives each robot a body and a name")
def test_a_body_and_the_name_above_it():
    *body, name = everything = markers("ada", "ada/base_footprint")
    assert {m.header.frame_id for m in everything} == {"ada/base_footprint"}
    assert all(m.frame_locked and m.color.a == 1.0 for m in everything)
    # Namespace and number identify a marker: RViz shows only one of two equal ones.
    assert len({(m.ns, m.id) for m in everything}) == len(everything)
    assert (name.type, name.text) == (name.TEXT_VIEW_FACING, "ada")
    top = max(m.pose.position.z + m.scale.z / 2 for m in body)
    assert 0.41 < top < 0.43  # [m]: 0.420 m, TurtleBot 2's specifications
    assert name.pose.position.z - name.scale.z / 2 > top
    assert max(m.scale.y for m in body) == 0.356  # twice Kobuki's radius
