"""The types of the tutorial, and a hundred others, to ROS 2 and back: nothing is lost."""

import importlib
import io
import random
import struct

import genpy
import pytest

typesys = pytest.importorskip("rosbags.typesys", reason="no rosbags here: PyPI was not reached")
STORE = typesys.get_typestore(typesys.Stores.LATEST)
PACKAGES = [
    "std_msgs",
    "geometry_msgs",
    "sensor_msgs",
    "nav_msgs",
    "diagnostic_msgs",
    "tf2_msgs",
    "trajectory_msgs",
    "shape_msgs",
    "stereo_msgs",
    "visualization_msgs",
    "actionlib_msgs",
]
BRIDGED = {
    "sensor_msgs/Joy", "geometry_msgs/Twist", "nav_msgs/Odometry", "tf2_msgs/TFMessage",
    "sensor_msgs/JointState", "sensor_msgs/LaserScan", "std_msgs/String",
    "diagnostic_msgs/DiagnosticArray",
}  # fmt: skip
RANGES = {f"{sign}int{bits}": bits for sign in ("", "u") for bits in (8, 16, 32, 64)}


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


def value(kind, draw):  # noqa: PLR0911  one for each kind
    """A value of a type, as genpy names it: extremes now and then."""
    base, _, length = kind.partition("[")
    if length:
        count = int(length[:-1] or draw.choice((0, 1, 3)))
        values = [value(base, draw) for _ in range(count)]
        return bytes(values) if base in ("uint8", "char") else values
    if "/" in base:
        return filled(class_of(base), draw)
    if base in RANGES or base in ("byte", "char"):
        bits = RANGES.get(base, 8)
        low = 0 if base.startswith("u") or base == "char" else -(2 ** (bits - 1))
        return draw.choice((low, low + 2**bits - 1, draw.randrange(low, low + 2**bits)))
    if base.startswith("float"):
        numbers = (0.0, -0.0, float("inf"), float("-inf"), 1e-300, draw.uniform(-1e6, 1e6))
        number = draw.choice(numbers)
        return number if base == "float64" else struct.unpack("f", struct.pack("f", number))[0]
    if base == "bool":
        return draw.random() < 0.5
    if base == "string":
        return draw.choice(("", "a", "\u00e4\u20ac{}%s\n", "x" * 1000))
    sign = 1 if base == "time" else draw.choice((1, -1))
    kind = genpy.Time if base == "time" else genpy.Duration
    return kind(sign * draw.randrange(2**31), draw.randrange(10**9))


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


def test_all_of_the_list_and_a_hundred_more_are_tried():
    assert set(TYPES) >= BRIDGED
    assert len(TYPES) >= 100, sorted(TYPES)
