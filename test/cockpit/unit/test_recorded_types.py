"""Types of recorded messages, also of packages that are not installed, and hostile ones."""

import struct
from io import BytesIO

import genpy
import pytest
import rosbag
import rospy
from genpy.dynamic import generate_dynamic
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Joy

from cockpit_server.fields import numbers_in
from cockpit_server.ros.tabs import recorded_types
from cockpit_server.ros.tabs.bag_files import read_messages
from cockpit_server.ros.tabs.playback import raw_kind
from cockpit_server.ros.tabs.recorded_types import Connection, fields_alone
from tutorial_testing.claims import claim

pytestmark = claim("A recording of any type is read, and no text in it runs as a program")
RULE = "=" * 80
DEFINITION = f"""
# A comment with "quotes" and \\
int32 LARGE=3   # a constant
string NAME=it's "#1"
Header header
nowhere/Wheel[] wheels
bool[2] pressed
{RULE}
MSG: std_msgs/Header
uint32 seq
time stamp
string frame_id
{RULE}
MSG: nowhere/Wheel
float64 speed
"""


def connection(type_name, definition, md5sum="0" * 32):
    return Connection("/x", type_name, md5sum, definition, {})


def test_numbers_of_a_type_that_is_not_installed_are_listed():
    kind = connection("nowhere/Base", DEFINITION).kind
    data = bytes(12) + bytes(4) + struct.pack("<Id2B", 1, 0.5, 1, 0)
    message = kind().deserialize(data)
    assert dict(numbers_in(message)) == {
        "header/seq": 0, "header/stamp": 0, "wheels[0]/speed": 0, "pressed": 2,
    }  # fmt: skip
    assert (message.wheels[0].speed, message.header.stamp) == (0.5, genpy.Time())
    assert dict(numbers_in(Joy(axes=[0.0] * 6)))["axes"] == 6
    assert dict(numbers_in(Odometry()))["pose/covariance"] == 36


def test_an_installed_type_of_another_version_is_decoded_by_its_recorded_definition():
    assert connection("sensor_msgs/Joy", Joy._full_text, Joy._md5sum).kind is Joy
    assert connection("sensor_msgs/Joy", "int8 new").kind().new == 0


@pytest.mark.parametrize(
    ("type_name", "definition"),
    [
        ("x/y", 'int32 __import__("rospy").hacked.append(1);A=1\nint32 a'),
        ("x/y", "int32 a\nstring A=\"\"\"; import rospy; rospy.hacked.append(1) #'\n# \\"),
        ("x/y", f"int32 a\n{RULE}\nMSG: x/z;__import__('rospy').hacked.append(1)\nint32 b"),
        ("x/y(__import__('rospy').hacked.append(1))", "int32 a"),
        ("../y", "int32 a"), ("x/y", "z/missing a"), ("x/y", f"{RULE}\n{RULE}"), ("", ""),
    ],
)  # fmt: skip
def test_hostile_definition_runs_nothing(type_name, definition, monkeypatch, tmp_path):
    monkeypatch.setattr(rospy, "hacked", [], raising=False)
    about = connection(type_name, definition)
    assert about.kind is None or about.kind.__slots__ == ["a"]
    assert "hacked" not in fields_alone(definition)
    path = tmp_path / "x.bag"
    with rosbag.Bag(str(path), "w") as bag:
        message = raw_kind(about)().deserialize(b"1234")
        header = {"topic": "/x", "type": type_name, "md5sum": about.md5sum,
                  "message_definition": definition}  # fmt: skip
        raw = (type_name, b"1234", about.md5sum, None, raw_kind(about))
        bag.write("/x", raw, rospy.Time(1), raw=True, connection_header=header)
        assert message.serialize(BytesIO()) is None
    assert [data for *_, data in read_messages(path, ["/x"])[1]] == [b"1234"]
    assert rospy.hacked == []


def test_genpy_alone_would_run_it(monkeypatch):
    monkeypatch.setattr(rospy, "hacked", [], raising=False)
    generate_dynamic("x/y", 'int32 __import__("rospy").hacked.append(1);A=1')
    assert rospy.hacked == [1]
    assert recorded_types.fields_alone("int32 a # b\nint32 A=1\n") == "int32 a"


def test_other_readers_of_bags_get_decoded_messages_before_and_after(tmp_path):
    path = tmp_path / "joy.bag"
    with rosbag.Bag(str(path), "w") as bag:
        bag.write("/joy", Joy(axes=[0.5]))
    read_messages(path, ["/joy"])
    with rosbag.Bag(str(path)) as bag:
        assert [joy.axes for _, joy, _ in bag.read_messages()] == [(0.5,)]
