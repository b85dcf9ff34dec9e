"""roslaunch can read every launch file, and finds the files and nodes that it names."""

import math
import os

import pytest
import roslaunch
import roslaunch.config
import roslaunch.rlutil

from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY

FOLDERS = ("*", "common/*", "common/stand_ins/*")
FILES = sorted(
    file
    for folder in FOLDERS
    for pattern in ("*.launch", "**/*.launch.xml")
    for file in REPOSITORY.glob(f"{folder}/launch/{pattern}")
)
CAMERA = """camera publish_tf 3d_sensor depth_registration num_worker_threads scan_topic
    rgb_processing ir_processing scan_processing depth_processing depth_registered_processing
    disparity_processing disparity_registered_processing"""
PLACE = "world x y yaw"
# The arguments that a launch file accepts: upstream's, and ours.
ARGUMENTS = {
    "turtlebot_bringup/minimal.launch": (
        f"base battery stacks 3d_sensor simulation serialport robot_name robot_type {PLACE}"
    ),
    "turtlebot_bringup/3dsensor.launch": CAMERA,
    "turtlebot_bringup/includes/mobile_base.launch.xml": f"base serialport {PLACE}",
    "turtlebot_bringup/includes/kobuki/mobile_base.launch.xml": "serialport",
    "turtlebot_bringup/includes/robot.launch.xml": "base stacks 3d_sensor",
    "kobuki_node/minimal.launch": f"kobuki_publish_tf serialport simulation {PLACE}",
    "foxglove_bridge/foxglove_bridge.launch": """port address tls certfile keyfile topic_whitelist
        param_whitelist service_whitelist client_topic_whitelist max_update_ms send_buffer_limit
        nodelet_manager num_threads capabilities""",
    "rbx1_bringup/fake_turtlebot.launch": f"urdf_file {PLACE}",
    "fake_turtlebot_sim/fake_turtlebot.launch": PLACE,
    "fake_turtlebot_sim/minimal.launch": PLACE,
    "joy2twist/launch_bag.launch": PLACE,
    "joy2twist/launch_joy_node.launch": PLACE,
}


@claim("roslaunch reads every launch file and finds what it names; upstream's arguments are taken")
@pytest.mark.parametrize("file", FILES, ids=lambda file: str(file.relative_to(REPOSITORY)))
def test_a_launch_file_is_read_and_all_that_it_names_is_found(file, monkeypatch):
    # roslaunch reads the arguments of its own command line; student.launch needs this one.
    monkeypatch.setattr("sys.argv", ["roslaunch", "name:=robot_1"])
    assert roslaunch.rlutil.check_roslaunch(str(file), use_test_depends=True) is None


@claim("roslaunch reads every ...", because="upstream's arguments")
@pytest.mark.parametrize("file", ARGUMENTS)
def test_arguments_of_public_launch_files(file, tmp_path, monkeypatch):
    monkeypatch.setattr("sys.argv", ["roslaunch"])
    values = {"world": "room", "x": "1.5", "scan_topic": "laser", "kobuki_publish_tf": "false"}
    names = ARGUMENTS[file].split()
    given = "".join(f'<arg name="{name}" value="{values.get(name, 1)}"/>' for name in names)
    package, name = file.split("/", 1)
    outer = tmp_path / "outer.launch"
    include = f'<include file="$(find {package})/launch/{name}">{given}</include>'
    outer.write_text(f'<launch><group ns="tb1">{include}</group></launch>')
    config = roslaunch.config.load_config_default([str(outer)], None, verbose=False)
    assert {node.namespace for node in config.nodes} == {"/tb1/"}
    places = {key.split("/")[-1]: param.value for key, param in config.params.items()}
    if "x" in names:
        assert (places["initial_x"], places["initial_y"], places["initial_yaw"]) == (1.5, 1, 1)


@claim("Copies of a TurtleBot's own launch files find what they include")
def test_a_copy_of_upstreams_own_launch_files_finds_what_these_include(tmp_path, monkeypatch):
    """turtlebot_bringup's minimal.launch and turtlebot_teleop's logitech.launch."""
    monkeypatch.setattr("sys.argv", ["roslaunch"])
    included = {
        "turtlebot_bringup/launch/includes/robot": ("base", "stacks", "3d_sensor"),
        "turtlebot_bringup/launch/includes/mobile_base": ("base", "serialport"),
        "turtlebot_bringup/launch/includes/netbook": ("battery",),
        "turtlebot_teleop/launch/includes/velocity_smoother": (),
    }
    lines = []
    for file, names in included.items():
        given = "".join(f'<arg name="{name}" value="kobuki"/>' for name in names)
        path = "$(find {})/{}.launch.xml".format(*file.split("/", 1))
        lines.append(f'<include file="{path}">{given}</include>')
    copy = tmp_path / "minimal.launch"
    copy.write_text(f"<launch>{''.join(lines)}</launch>")
    config = roslaunch.config.load_config_default([str(copy)], None, verbose=False)
    names = ["cmd_vel_mux", "kobuki_safety_controller", "mobile_base"]
    names += ["robot_state_publisher", "teleop_velocity_smoother"]
    assert sorted(node.name for node in config.nodes) == names
    assert config.params["/robot/type"].value == "turtlebot"
    smoother = next(node for node in config.nodes if node.name == names[-1])
    assert smoother.args == "teleop_velocity_smoother/raw_cmd_vel cmd_vel_mux/input/teleop"


def test_rbx1s_robot_has_the_names_of_the_original(monkeypatch):
    """The launch file clears the parameters of an earlier launch before it sets its own."""
    given = loaded(monkeypatch, "rbx1_bringup/fake_turtlebot.launch")
    assert {node.name for node in given.nodes} == {"arbotix", "robot_state_publisher"}
    values = {key: one.value for key, one in given.params.items()}
    assert values["/use_sim_time"] is False
    joints = values["/arbotix/left_wheel_joint"], values["/arbotix/right_wheel_joint"]
    assert joints == ("base_l_wheel_joint", "base_r_wheel_joint")
    assert "/arbotix/" in given.clear_params


def loaded(monkeypatch, file, *arguments):
    """Return roslaunch's configuration for a launch file of joy2twist, or for PACKAGE/FILE."""
    *package, name = file.split("/")
    (path,) = (file for file in FILES if file.parts[-3::2] == (*(package or ["joy2twist"]), name))
    monkeypatch.setattr("sys.argv", ["roslaunch", *arguments])
    return roslaunch.config.load_config_default([str(path)], None, verbose=False)


@claim("`joy_pkg` takes another ...", because="`joy_node`")
@claim(
    "On a TurtleBot: remapped to the multiplexer, with a dead-man, arming and limits, by a gamepad "
    "or a recording"
)
@pytest.mark.parametrize(
    ("file", "preset", "limits"),
    [
        ("launch_joy_node_realTurtlebot.launch", "extreme_3d",
         {"require_enable_button": True, "max_linear_speed": 0.7, "max_angular_speed": 2.0}),
        ("launch_joy_node.launch", "f710_d", {"enable_button": 4}),
    ],
)  # fmt: skip
def test_a_gamepad_arms_and_is_watched_and_leaves_no_parameter(monkeypatch, file, preset, limits):
    """A joy_node started by hand after virtual:=true would wait for the FIFO."""
    given = loaded(monkeypatch, file, f"joy_config:={preset}", "virtual:=true", "rviz:=false")
    values = {key: one.value for key, one in given.params.items()}
    watched = {"arm_on_neutral": True, "joy_timeout": 0.5, "vigilance_timeout": 3.0}
    for name, value in {**limits, **watched}.items():
        assert values[f"/myjoystick2twist/{name}"] == value, name
    assert [name for name in values if name.startswith("/joy_node/")] == []
    assert {"joy_node", "myjoystick2twist"} <= {node.name for node in given.nodes}


def test_a_preset_without_limits_gets_those_of_a_turtlebot(monkeypatch, tmp_path):
    (tmp_path / "bare.yaml").write_text("enable_button: 4")
    preset = os.path.relpath(tmp_path / "bare", REPOSITORY / "joy2twist/config")
    given = loaded(monkeypatch, "joy2twist_turtlebot.launch", f"joy_config:={preset}")
    for part, limit in (("linear", 0.7), ("angular", math.pi)):
        assert given.params[f"/myjoystick2twist/max_{part}_speed"].value == limit


@claim("`joy_pkg` takes another package's node; `joy_node` leaves no parameter")
def test_joy_pkg_is_the_package_whose_node_reads_the_device(monkeypatch):
    given = loaded(monkeypatch, "launch_joy_node.launch", "joy_pkg:=joy", "joy_dev:=/tmp/a b")
    (node,) = (node for node in given.nodes if node.name == "joy_node")
    assert node.package == "joy"
    assert "_dev:='/tmp/a b'" in node.args or "_dev:=/tmp/a b" in node.args


def test_a_recording_by_a_relative_path_is_found_and_parameters_of_before_are_not(monkeypatch):
    folder = REPOSITORY / "joy2twist/bag"
    monkeypatch.setenv("PWD", str(folder))
    given = loaded(monkeypatch, "launch_bag.launch", "bag:=../bag/joy.bag", "rviz:=false")
    (node,) = (node for node in given.nodes if node.name == "rosbag")
    assert f"{folder}/../bag/joy.bag" in node.args
    assert "/myjoystick2twist/" in given.clear_params


@pytest.mark.parametrize(
    ("asked", "opens"), [((), False), (("rviz:=true",), True)], ids=["no screen", "asked for"]
)
def test_rviz_opens_where_there_is_a_screen_or_where_it_is_asked_for(monkeypatch, asked, opens):
    monkeypatch.setenv("DISPLAY", "")
    given = loaded(monkeypatch, "launch_bag.launch", "cockpit:=false", *asked)
    expected = ["/fake_turtlebot", *["/my_rviz"] * opens]
    expected += ["/myjoystick2twist", "/robot_state_publisher", "/rosbag"]
    assert sorted(node.namespace + node.name for node in given.nodes) == expected
