"""Messages of a hundred types are converted to ROS 2 and back without a loss."""

import importlib
import io
import re
from importlib.util import find_spec
from math import inf

import genpy
import pytest

typesys = pytest.importorskip("rosbags.typesys", reason="no rosbags here: PyPI was not reached")
STORE = typesys.get_typestore(typesys.Stores.LATEST)
BRIDGED = {
    "sensor_msgs/Joy", "geometry_msgs/Twist", "nav_msgs/Odometry", "tf2_msgs/TFMessage",
    "sensor_msgs/JointState", "sensor_msgs/LaserScan", "std_msgs/String",
    "diagnostic_msgs/DiagnosticArray",
}  # fmt: skip
PACKAGES = {name.split("/")[0] for name in BRIDGED} | {
    "trajectory_msgs", "shape_msgs", "stereo_msgs", "visualization_msgs", "actionlib_msgs",
}  # fmt: skip


def fields_of(kind):
    return list(zip(kind.__slots__, kind._slot_types))


def class_of(name):
    package, _, kind = name.partition("/")
    return getattr(importlib.import_module(f"{package}.msg"), kind)


def is_the_same(kind):
    """Whether ROS 2 has a type with the same fields, but for Header.seq."""
    if kind._type == "std_msgs/Header":
        return True
    known = STORE.fielddefs.get(kind._type.replace("/", "/msg/"))
    inner = [part.split("[")[0] for _, part in fields_of(kind) if "/" in part]
    same = known and [field for field, _ in known[1]] == [field for field, _ in fields_of(kind)]
    return same and all(map(is_the_same, map(class_of, inner)))


def types():
    for package in filter(find_spec, PACKAGES):
        for kind in vars(importlib.import_module(f"{package}.msg")).values():
            if isinstance(kind, type) and issubclass(kind, genpy.Message) and is_the_same(kind):
                yield kind._type, kind


TYPES = dict(types())


def value(kind, high):
    """The highest or lowest value of a type, as genpy names it; seq, which ROS 2 lacks, is 0."""
    base, _, length = kind.partition("[")
    bits = int(re.sub(r"\D", "", base) or 8)
    if length:
        values = [value(base, high)] * int(length[:-1] or 3 * high)
        return bytes(values) if base in ("uint8", "char") else values
    if "/" in base:
        made = class_of(base)()
        for field, part in fields_of(made):
            setattr(made, field, 0 if field == "seq" else value(part, high))
        return made
    if base in ("time", "duration"):
        earliest = -(2**31) if base == "duration" else 0
        return getattr(genpy, base.title())(2**31 - 1 if high else earliest, 999_999_999)
    lowest, highest = -(2 ** (bits - 1)), 2 ** (bits - 1) - 1
    if base.startswith(("u", "char")):
        lowest, highest = 0, 2**bits - 1
    others = {"string": ("", "\u00e4\u20ac{}%s\n"), "bool": (False, True)}
    others.update(dict.fromkeys(("float32", "float64"), (-0.5, inf)))
    return others.get(base, (lowest, highest))[high]


@pytest.mark.parametrize("name", sorted(TYPES))
@pytest.mark.parametrize("high", [False, True], ids=["lowest", "highest"])
def test_a_type_is_carried_without_a_loss(name, high):
    buffer, kind = io.BytesIO(), name.replace("/", "/msg/")
    value(name, high).serialize(buffer)
    cdr = bytes(STORE.ros1_to_cdr(buffer.getvalue(), kind))
    assert bytes(STORE.cdr_to_ros1(cdr, kind)) == buffer.getvalue()


def test_the_bridged_types_and_a_hundred_in_all_are_tried():
    assert set(TYPES) >= BRIDGED
    assert len(TYPES) >= 100, sorted(TYPES)
