"""Messages of a hundred types are converted to ROS 2 and back without a loss."""

import importlib
import io
import random
import struct
from math import inf

import genpy
import pytest

typesys = pytest.importorskip("rosbags.typesys", reason="no rosbags here: PyPI was not reached")
STORE = typesys.get_typestore(typesys.Stores.LATEST)
PACKAGES = (
    "std_msgs", "geometry_msgs", "sensor_msgs", "nav_msgs", "diagnostic_msgs", "tf2_msgs",
    "trajectory_msgs", "shape_msgs", "stereo_msgs", "visualization_msgs", "actionlib_msgs",
)  # fmt: skip
BRIDGED = {
    "sensor_msgs/Joy", "geometry_msgs/Twist", "nav_msgs/Odometry", "tf2_msgs/TFMessage",
    "sensor_msgs/JointState", "sensor_msgs/LaserScan", "std_msgs/String",
    "diagnostic_msgs/DiagnosticArray",
}  # fmt: skip


def fields_of(kind):
    return list(zip(kind.__slots__, kind._slot_types))


def definitions(name):
    """The names of a type's fields in ROS 2; None if ROS 2 has no such type."""
    known = STORE.fielddefs.get(name.replace("/", "/msg/"))
    return known and [field for field, _ in known[1]]


def is_the_same(kind):
    """Whether ROS 2 has a type with the same fields, but for Header.seq."""
    name = kind._type
    if name == "std_msgs/Header":
        return True
    own = [field for field, _ in fields_of(kind)]
    inner = [part.split("[")[0] for _, part in fields_of(kind) if "/" in part]
    return definitions(name) == own and all(map(is_the_same, map(class_of, inner)))


def class_of(name):
    package, _, kind = name.partition("/")
    return getattr(importlib.import_module(f"{package}.msg"), kind)


def types():
    found = {}
    for package in PACKAGES:
        try:
            module = importlib.import_module(f"{package}.msg")
        except ImportError:
            continue
        for kind in vars(module).values():
            if isinstance(kind, type) and issubclass(kind, genpy.Message) and is_the_same(kind):
                found[kind._type] = kind
    return found


TYPES = types()


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
    """A value of a type, as genpy names it."""
    base, _, length = kind.partition("[")
    if length:
        values = [value(base, draw) for _ in range(int(length[:-1] or draw.choice((0, 1, 3))))]
        return bytes(values) if base in ("uint8", "char") else values
    return filled(class_of(base), draw) if "/" in base else VALUES[base](draw)


def filled(kind, draw):
    """A message of random values; seq, which ROS 2 lacks, is 0."""
    made = kind()
    for field, part in fields_of(kind):
        setattr(made, field, 0 if field == "seq" else value(part, draw))
    return made


def serialized(message):
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


@pytest.mark.parametrize("name", sorted(TYPES))
def test_a_type_is_carried_without_a_loss(name):
    for seed in range(40):
        data = serialized(filled(TYPES[name], random.Random(seed)))
        kind = name.replace("/", "/msg/")
        cdr = bytes(STORE.ros1_to_cdr(data, kind))
        assert bytes(STORE.cdr_to_ros1(cdr, kind)) == data, seed


def test_the_bridged_types_and_a_hundred_in_all_are_tried():
    assert set(TYPES) >= BRIDGED
    assert len(TYPES) >= 100, sorted(TYPES)
