"""The messages that our list carries are converted to ROS 2 and back without a loss."""

import io
import re
from math import inf

import genpy
import pytest
from roslib.message import get_message_class

typesys = pytest.importorskip("rosbags.typesys", reason="no rosbags here: PyPI was not reached")
STORE = typesys.get_typestore(typesys.Stores.LATEST)
BRIDGED = [
    "sensor_msgs/Joy", "geometry_msgs/Twist", "nav_msgs/Odometry", "tf2_msgs/TFMessage",
    "sensor_msgs/JointState", "sensor_msgs/LaserScan", "std_msgs/String",
    "diagnostic_msgs/DiagnosticArray",
]  # fmt: skip
LIMITS = {  # lowest and highest, as genpy names the types
    "int8": (-128, 127), "int32": (-(2**31), 2**31 - 1), "uint8": (0, 255), "byte": (-128, 127),
    "uint32": (0, 2**32 - 1), "float32": (-0.5, inf), "float64": (-0.5, inf), "bool": (False, True),
    "string": ("", "\u00e4\u20ac{}%s\n"),
    "time": (genpy.Time(0, 0), genpy.Time(2**31 - 1, 999_999_999)),
}  # fmt: skip


def value(kind, high):
    """The highest or lowest value of a type, as genpy names it; seq, which ROS 2 lacks, is 0."""
    base, is_list, length = re.fullmatch(r"([\w/]+)(\[(\d*)\])?", kind).groups()
    if is_list:
        return [value(base, high)] * int(length or 3 * high)
    if base in LIMITS:
        return LIMITS[base][high]
    made = get_message_class(base)()
    for field, part in zip(made.__slots__, made._slot_types):
        setattr(made, field, 0 if field == "seq" else value(part, high))
    return made


@pytest.mark.parametrize("name", BRIDGED)
@pytest.mark.parametrize("high", [False, True], ids=["lowest", "highest"])
def test_a_type_is_carried_without_a_loss(name, high):
    buffer, kind = io.BytesIO(), name.replace("/", "/msg/")
    value(name, high).serialize(buffer)
    cdr = bytes(STORE.ros1_to_cdr(buffer.getvalue(), kind))
    assert bytes(STORE.cdr_to_ros1(cdr, kind)) == buffer.getvalue()
