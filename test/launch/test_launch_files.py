"""roslaunch can read every launch file, and finds each node and package that it names."""

from pathlib import Path

import pytest
import roslaunch.config
import roslaunch.rlutil

REPOSITORY = Path(__file__).resolve().parents[2]
FOLDERS = ("*", "common/*", "common/stand_ins/*")
FILES = sorted(file for folder in FOLDERS for file in REPOSITORY.glob(f"{folder}/launch/*.launch"))
CAMERA = """camera publish_tf 3d_sensor depth_registration num_worker_threads scan_topic
    rgb_processing ir_processing scan_processing depth_processing depth_registered_processing
    disparity_processing disparity_registered_processing"""
PLACE = "world x y yaw"
# The arguments that a launch file takes, those of upstream and ours.
ARGUMENTS = {
    "turtlebot_bringup/minimal.launch": (
        f"base battery stacks 3d_sensor simulation serialport robot_name robot_type {PLACE}"
    ),
    "turtlebot_bringup/3dsensor.launch": CAMERA,
    "kobuki_node/minimal.launch": f"kobuki_publish_tf {PLACE}",
    "rbx1_bringup/fake_turtlebot.launch": f"urdf_file {PLACE}",
    "turtlebot_teleop/keyboard_teleop.launch": "",
    "turtlebot_teleop/logitech.launch": "",
    "turtlebot_teleop/ps3_teleop.launch": "",
    "turtlebot_teleop/xbox360_teleop.launch": "",
    "fake_turtlebot_sim/fake_turtlebot.launch": PLACE,
    "fake_turtlebot_sim/minimal.launch": PLACE,
    "joy2twist/launch_bag.launch": PLACE,
    "joy2twist/launch_joy_node.launch": PLACE,
}


@pytest.mark.parametrize("file", FILES, ids=lambda file: str(file.relative_to(REPOSITORY)))
def test_a_launch_file_is_read_and_all_that_it_names_is_found(file, monkeypatch):
    # roslaunch reads the arguments of its own command line; student.launch needs this one.
    monkeypatch.setattr("sys.argv", ["roslaunch", "name:=robot_1"])
    assert roslaunch.rlutil.check_roslaunch(str(file), use_test_depends=True) is None


@pytest.mark.parametrize("file", ARGUMENTS)
def test_arguments_of_public_launch_files(file, tmp_path, monkeypatch):
    monkeypatch.setattr("sys.argv", ["roslaunch"])
    values = {"world": "room", "x": "1.5", "scan_topic": "laser", "kobuki_publish_tf": "false"}
    names = ARGUMENTS[file].split()
    given = "".join(f'<arg name="{name}" value="{values.get(name, 1)}"/>' for name in names)
    package, name = file.split("/")
    outer = tmp_path / "outer.launch"
    include = f'<include file="$(find {package})/launch/{name}">{given}</include>'
    outer.write_text(f'<launch><group ns="tb1">{include}</group></launch>')
    config = roslaunch.config.load_config_default([str(outer)], None, verbose=False)
    assert {node.namespace for node in config.nodes} == {"/tb1/"}
    places = {key.split("/")[-1]: one.value for key, one in config.params.items()}
    if "x" in names:
        assert (places["initial_x"], places["initial_y"], places["initial_yaw"]) == (1.5, 1, 1)
