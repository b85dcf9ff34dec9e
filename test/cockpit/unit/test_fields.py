"""Numbers in messages, and their names."""

import pytest
from sensor_msgs.msg import Joy

from cockpit_server.fields import numbers_of, parts_of, split, value_at


def test_fields_are_all_numbers_of_a_type_seldom_drawn_ones_last():
    fields = numbers_of("nav_msgs/Odometry")
    assert fields[0] == "pose/pose/position/x"
    assert {"header/stamp", "pose/covariance"} < set(fields)
    assert not {"pose/covariance[0]", "header/frame_id"} & set(fields)
    assert numbers_of("sensor_msgs/Joy")[:2] == ("axes", "buttons")  # both may be empty
    assert "transforms[0]/transform/rotation/w" in numbers_of("tf2_msgs/TFMessage")
    assert numbers_of("no_such/Type") == numbers_of("std_msgs/String") == ()


@pytest.mark.parametrize(
    ("field", "value"),
    [("axes[1]", 0.25), ("header/stamp", 3.0), ("header/seq", 7.0), ("axes[2]", None),
     ("axes", [0.5, 0.25]), ("nothing", None), ("serialize", None), ("header/frame_id", None)],
)  # fmt: skip
def test_value_of_a_field_is_a_number_or_none(field, value):
    joy = Joy(axes=[0.5, 0.25])
    joy.header.stamp.secs, joy.header.seq = 3, 7
    assert value_at(joy, parts_of(field)) == value


@pytest.mark.parametrize("field", ["", "a//b", "a[-1]", "a.b", "__class__"])
def test_malformed_field_has_no_parts(field):
    assert parts_of(field) == []


def test_topic_of_a_field_is_the_longest_that_fits():
    topics = ["/a", "/a/b", "/c"]
    assert split("/a/b/x", topics) == ("/a/b", "x")
    assert split("/a/x", topics) == ("/a", "x")
    assert split("/d/x", topics)[0] == ""
