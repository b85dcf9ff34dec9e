"""The arguments that roslaunch itself does not check."""

from pathlib import Path

import pytest

from gamepad.arguments import INDEX, RULES, check

WHOLE = (Path(__file__).parents[3] / "common" / "gamepad" / "bag" / "joy.bag").read_bytes()


@pytest.fixture
def bag(tmp_path):
    path = tmp_path / "joy.bag"
    path.write_bytes(WHOLE)
    return str(path)


def refused(name, value):
    """Why an argument will not do; the line begins with it."""
    with pytest.raises(ValueError) as caught:
        check(name, value)
    line = str(caught.value)
    assert line.startswith(f"{name}:={value}: ") and "\n" not in line
    return line[len(f"{name}:={value}: ") :]


@pytest.mark.parametrize("name", ["virtual", "lan", "loop", "rviz"])
def test_true_or_false(name):
    """What roslaunch itself takes for one of the two."""
    for value in ("true", "false", "True", "False", "1", "0"):
        check(name, value)
    for value in ("yes", "no", "", "2", "perhaps"):
        assert refused(name, value) == "must be true or false"


def test_the_page_of_the_cockpit():
    for value in ("true", "False", "auto"):
        check("cockpit", value)
    for value in ("yes", "", "Auto "):
        assert refused("cockpit", value) == "must be true, false or auto"
    for value in ("1", "8080", "65535"):
        check("cockpit_port", value)
    for value in ("0", "65536", "-1", "http", "8080.5", ""):
        assert refused("cockpit_port", value) == "must be a port, a number from 1 to 65535"


def test_a_preset(tmp_path):
    for name in ("xbox", "f710_d"):
        (tmp_path / f"{name}.yaml").touch()
    check("joy_config", str(tmp_path / "xbox.yaml"))
    said = "there is none of this name; there are f710_d, xbox"
    assert refused("joy_config", str(tmp_path / "xbos.yaml")) == said


def test_what_moves_the_robot():
    check("joystick", "gamepad")
    check("joystick", "browser")
    assert refused("joystick", "keys") == "must be gamepad or browser"


def test_a_recording(bag, tmp_path):
    check("bag", bag)
    check("bag", "none")
    assert refused("bag", "./joy.bag") == "must be a whole path, as $PWD is not set"
    assert refused("bag", f"{bag}x") == "cannot be read: No such file or directory"
    assert refused("bag", str(tmp_path)) == "cannot be read: Is a directory"
    (tmp_path / "joy.bag").write_text("#!/bin/sh")
    assert refused("bag", bag) == "is no recording of rosbag"


@pytest.mark.parametrize(
    "content",
    [
        *(WHOLE[:size] for size in (13, 30, 5000, 40_000)),
        INDEX.sub(b"index_pos=" + bytes(8), WHOLE, 1),  # as rosbag record leaves it when killed
    ],
    ids=len,
)
def test_a_recording_that_is_cut_short(bag, content):
    Path(bag).write_bytes(content)
    assert refused("bag", bag) == f"is cut short; mend it with: rosbag reindex {bag}"


@pytest.mark.parametrize(
    ("name", "near"),
    [
        ("robot-7", "robot_7"),
        ("robot 7", "robot_7"),
        ("7", "robot_7"),
        ("/ada", "ada"),
        ("a/b", "a_b"),
        ("J\u00fcrgen", "J_rgen"),
    ],
)
def test_a_robot_with_a_name_that_ros_does_not_know(name, near):
    why = "must be a letter followed by letters, digits and underscores"
    assert refused("name", name) == f"{why}; did you mean {near}?"
    check("name", near)


def test_a_robot():
    for name in ("robot_7", "ada", "R2D2"):
        check("name", name)
    assert "such as name:=robot_7" in refused("name", "")
    assert refused("name", "-").endswith("underscores")


def test_only_arguments_with_a_rule_are_asked_for():
    assert set(RULES) == {
        "bag", "cockpit", "cockpit_port", "joy_config", "joy_pkg", "joystick", "lan", "loop",
        "name", "ros2", "rviz", "vigilance_timeout", "virtual",
    }  # fmt: skip


def test_what_joy2twist_would_refuse_later():
    for value in ("0", "0.0", "1", "3.0", "60"):
        check("vigilance_timeout", value)
    for value in ("-1", "0.3", "61", "soon", ""):
        assert "must be a number from 1 to 60 s, or 0 for off" in refused(
            "vigilance_timeout", value
        )


def test_the_package_of_the_driver():
    for value in ("gamepad", "joy", "another"):
        check("joy_pkg", value)
    assert "give joy or gamepad" in refused("joy_pkg", "joy2twist")
