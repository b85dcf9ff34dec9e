"""Messages of a hundred types are converted to ROS 2 and back without a loss."""

import importlib
import io
import random
import struct
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


def whole(low, high):
    return lambda draw: draw.choice((low, high, draw.randint(low, high)))


def real(draw):
    return draw.choice((0.0, -0.0, inf, -inf, 1e-300, draw.uniform(-1e6, 1e6)))


VALUES = {  # by genpy's names of types: a function that draws a value, extremes now and then
    **{f"int{bits}": whole(-(2 ** (bits - 1)), 2 ** (bits - 1) - 1) for bits in (8, 16, 32, 64)},
    **{f"uint{bits}": whole(0, 2**bits - 1) for bits in (8, 16, 32, 64)},
    "byte": whole(-128, 127),
    "char": whole(0, 255),
    "bool": lambda draw: draw.random() < 0.5,
    "float64": real,
    "float32": lambda draw: struct.unpack("f", struct.pack("f", real(draw)))[0],
    "string": lambda draw: draw.choice(("", "a", "\u00e4\u20ac{}%s\n", "x" * 1000)),
    "time": lambda draw: genpy.Time(draw.randrange(2**31), draw.randrange(10**9)),
    "duration": lambda draw: genpy.Duration(
        whole(-(2**31), 2**31 - 1)(draw), draw.randrange(10**9)
    ),
}


def value(kind, draw):
    """A value of a type, as genpy names it; seq, which ROS 2 lacks, is 0."""
    base, _, length = kind.partition("[")
    if length:
        values = [value(base, draw) for _ in range(int(length[:-1] or draw.choice((0, 1, 3))))]
        return bytes(values) if base in ("uint8", "char") else values
    if "/" not in base:
        return VALUES[base](draw)
    made = class_of(base)()
    for field, part in fields_of(made):
        setattr(made, field, 0 if field == "seq" else value(part, draw))
    return made


@pytest.mark.parametrize("name", sorted(TYPES))
def test_a_type_is_carried_without_a_loss(name):
    for seed in range(40):
        buffer, kind = io.BytesIO(), name.replace("/", "/msg/")
        value(name, random.Random(seed)).serialize(buffer)
        cdr = bytes(STORE.ros1_to_cdr(buffer.getvalue(), kind))
        assert bytes(STORE.cdr_to_ros1(cdr, kind)) == buffer.getvalue(), seed


def test_the_bridged_types_and_a_hundred_in_all_are_tried():
    assert set(TYPES) >= BRIDGED
    assert len(TYPES) >= 100, sorted(TYPES)
