"""The arguments that roslaunch itself does not check."""

import pytest
import rosbag
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy
from std_msgs.msg import String

from launch_kit.arguments import Argument, check, check_all, without_effect
from launch_kit.ros import packages
from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY

JOY_BAG = REPOSITORY / "common/gamepad/bag/joy.bag"
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
        ("bag", [str(JOY_BAG)], ["./joy.bag"], "must be a whole path, as $PWD is not set"),
        ("cmd_vel", ["cmd_vel", "/robot_1/cmd_vel"], ["", "a b", "7", "a//b", "cmd_vel/"],
         "must be a topic, such as cmd_vel or /robot_1/cmd_vel"),
        ("robots", ["3", "[ada, bob]", "{ada: [0, 0, 1]}"], ["[a"], "is not YAML"),
        ("scan_no_return", ["nan", "inf"], ["0"], "must be inf or nan"),
        ("world", ["room", ""], [], ""),
        ("world", [], ["rom"],
         "no world of this package has that name: take maze, room, table or a file"),
        ("world", [], ["/no/room.yaml"], "cannot be read: No such file or directory"),
        ("x", ["1", "-2.5", "1e3", ""], ["one", "1e7", "true", "nan"],
         "must be a number from -1e+06 to 1e+06 m, or empty"),
        ("rviz_config", [], ["sim.rviz"], "must be a whole path, as $PWD is not set"),
        ("bag", [], ["/dev/null"], "not a plain file"),
        ("name", ["robot_7", "ada", "R2D2"], [""],
         "is missing: which robot of the classroom, such as name:=robot_7"),
        ("name", [], ["-"], "must be a letter followed by letters, digits and underscores"),
    ],
)  # fmt: skip
def test_what_is_allowed(monkeypatch, name, good, bad, why):
    monkeypatch.delenv("PWD", raising=False)
    for value in good:
        check(name, value)
    for value in bad:
        assert refused(name, value) == why


def test_a_preset_that_does_not_exist_is_named_beside_those_that_do(monkeypatch, tmp_path):
    monkeypatch.setattr(packages, "folder", lambda _: tmp_path)
    check("joy_config", "f710_d")  # of a package without presets
    (tmp_path / "config").mkdir()
    for name in ("xbox", "f710_d"):
        (tmp_path / f"config/{name}.yaml").touch()
    check("joy_config", "xbox")
    assert refused("joy_config", "xbos") == "there is none of this name; there are f710_d, xbox"


@pytest.mark.parametrize(
    ("name", "text", "why"),
    [
        ("config", "rate: 50", ""),
        ("config", "# nothing yet", ""),
        ("config", "- 50", "must be a YAML file with a map, such as rate: 50"),
        ("mux_config", "a: [", "line 1 is not YAML: expected the node content"),
        ("urdf", "<robot/>", ""),
        ("urdf", "<launch/>", "must be a URDF, whose first tag is <robot>; this one's is <launch>"),
        ("urdf", "robot", "is not XML: syntax error: line 1, column 0"),
    ],
)
def test_a_file_holds_what_its_argument_needs(monkeypatch, tmp_path, name, text, why):
    monkeypatch.setenv("PWD", str(tmp_path))
    (tmp_path / "file").write_text(text)
    if why:
        assert refused(name, "file").startswith(why)
    else:
        check(name, "file")
    assert refused(name, "none") == "there is no such file"


def test_a_default_is_allowed_and_each_file_has_its_own():
    check_all([Argument("a", "bag", "none", "none"), Argument("a", "rviz_config", "auto", "auto")])
    with pytest.raises(ValueError, match=r"^bag:=none: "):
        check_all([Argument("b", "bag", "none", "joy.bag")])
    with pytest.raises(ValueError, match=r"^name:=: is missing"):
        check_all([Argument("a", "name", "", "")])


def test_what_has_one_value_here_gets_a_line_for_another():
    given = [Argument("a", "base", "kobuki"), *[Argument("b", "base", "create", "create")] * 2]
    assert without_effect(given) == [
        "base:=create is ignored: it changes nothing about the simulated robot"
    ]


@claim("A wrong argument or bag is named before the start", because="a bag")
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
