"""The arguments that roslaunch itself does not check."""

import pytest
import rosbag
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy
from std_msgs.msg import String

from gamepad.arguments import check
from gamepad.ros.bags import check_recording
from tutorial_testing.processes import REPOSITORY

JOY_BAG = REPOSITORY / "common" / "gamepad" / "bag" / "joy.bag"
TRUE_OR_FALSE = "must be true or false"


def refused(name, value):
    """Why an argument will not do; the line begins with it."""
    with pytest.raises(ValueError) as caught:
        check(name, value)
    line = str(caught.value)
    assert line.startswith(f"{name}:={value}: ") and "\n" not in line
    return line[len(f"{name}:={value}: ") :]


@pytest.mark.parametrize(
    ("name", "good", "bad", "why"),
    [
        *[(name, ["true", "false", "True", "False", "1", "0"], ["yes", "no", "", "2"],
           TRUE_OR_FALSE) for name in ("lan", "loop", "ros2", "rviz", "virtual")],
        ("cockpit", ["true", "False", "auto"], ["yes", "", "Auto "], "must be true, false or auto"),
        ("cockpit_port", ["1", "8080", "65535"], ["0", "65536", "-1", "http", "8080.5", ""],
         "must be a port, a number from 1 to 65535"),
        ("joystick", ["gamepad", "browser"], ["keys", ""], "must be gamepad or browser"),
        ("vigilance_timeout", ["0", "0.0", "1", "3.0", "60"], ["-1", "0.3", "61", "soon", ""],
         "must be a number from 1 to 60 s, or 0 for off"),
        ("joy_timeout", ["0", "0.5", "60"], ["-1", "61", "soon"],
         "must be a number up to 60 s, or 0 for off"),
        ("bag", ["none", str(JOY_BAG)], ["./joy.bag"], "must be a whole path, as $PWD is not set"),
        ("bag", [], ["/dev/null"], "not a plain file"),
        ("name", ["robot_7", "ada", "R2D2"], [""],
         "is missing: which robot of the classroom, such as name:=robot_7"),
        ("name", [], ["-"], "must be a letter followed by letters, digits and underscores"),
    ],
)  # fmt: skip
def test_what_is_allowed(name, good, bad, why):
    for value in good:
        check(name, value)
    for value in bad:
        assert refused(name, value) == why


def test_a_preset_that_does_not_exist_is_named_beside_those_that_do(tmp_path):
    for name in ("xbox", "f710_d"):
        (tmp_path / f"{name}.yaml").touch()
    check("joy_config", str(tmp_path / "xbox.yaml"))
    said = "there is none of this name; there are f710_d, xbox"
    assert refused("joy_config", str(tmp_path / "xbos.yaml")) == said


def test_a_recording_that_is_damaged_is_one_line_of_the_guard(tmp_path):
    bag, preset = tmp_path / "joy.bag", JOY_BAG.parents[3] / "joy2twist" / "config" / "f710_d.yaml"
    whole = JOY_BAG.read_bytes()
    bag.write_bytes(whole[:20_000] + b"\xff" * 3000 + whole[23_000:])
    with pytest.raises(ValueError, match=r"joy\.bag: cannot be read: Invalid data[^\n]*\Z"):
        check_recording(str(bag), str(preset))


@pytest.mark.parametrize(
    ("topics", "why"),
    [
        ({"/joy": Joy}, ""),
        ({"/cmd_vel": Twist, "/a": String},
         "no sensor_msgs/Joy on /joy, so nothing would move; it has /a, /cmd_vel; record one with:"
         " rosbag record /joy"),
        ({"/joy": String, "/robot_1/joy": Joy},
         "no sensor_msgs/Joy on /joy, so nothing would move; its joystick is on /robot_1/joy:"
         " rosbag play {path} /robot_1/joy:=/joy"),
        ({}, "no sensor_msgs/Joy on /joy, so nothing would move; it has nothing; record one with:"
         " rosbag record /joy"),
    ],
)  # fmt: skip
def test_a_recording_without_a_joystick_is_refused_with_what_to_do(tmp_path, topics, why):
    path = tmp_path / "other.bag"
    with rosbag.Bag(str(path), "w") as bag:
        for topic, kind in topics.items():
            bag.write(topic, kind())
    if why:
        assert refused("bag", str(path)) == why.format(path=path)
    else:
        check("bag", str(path))


@pytest.mark.parametrize(("name", "near"), [("7", "robot_7"), ("J\u00fcrgen", "J_rgen")])
def test_a_robot_with_a_name_that_ros_does_not_know(name, near):
    assert refused("name", name).endswith(f"digits and underscores; did you mean {near}?")
    check("name", near)
