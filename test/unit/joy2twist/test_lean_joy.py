"""LeanJoy reads the same as sensor_msgs/Joy does, and is one to every peer."""

import io

import pytest
from hypothesis import given
from hypothesis import strategies as st

Joy = pytest.importorskip("sensor_msgs.msg", reason="no ROS for this Python: ./tutorial setup").Joy
from joy_to_twist.node import LeanJoy  # noqa: E402  needs sensor_msgs

uint32 = st.integers(0, 2**32 - 1)


def wire(joy):
    buffer = io.BytesIO()
    joy.serialize(buffer)
    return buffer.getvalue()


@given(
    uint32,
    uint32,
    st.text(max_size=30),
    st.lists(st.floats(width=32, allow_nan=False), max_size=12),
    st.lists(st.integers(-(2**31), 2**31 - 1), max_size=20),
)
def test_it_reads_what_joy_reads(secs, nsecs, frame_id, axes, buttons):
    joy = Joy(axes=axes, buttons=buttons)
    joy.header.stamp.secs, joy.header.stamp.nsecs = secs, nsecs
    joy.header.frame_id = frame_id
    data = wire(joy)
    expected, lean = Joy().deserialize(data), LeanJoy().deserialize(data)
    assert lean.axes == expected.axes
    assert lean.buttons == expected.buttons
    assert lean.stamp_ns == secs * 10**9 + nsecs
    assert (LeanJoy._type, LeanJoy._md5sum) == (Joy._type, Joy._md5sum)  # to every peer
