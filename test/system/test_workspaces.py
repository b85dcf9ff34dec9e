"""The packages in a workspace of the user's own: built, tested from it, and installed."""

import os
import subprocess
from pathlib import Path

import pytest

CLEAN = {
    "PATH": "/usr/bin:/bin",
    "HOME": os.environ["HOME"],
    "ROS_HOSTNAME": "localhost",
}  # no workspace sourced
NODES = {
    "beginner_tutorials": ["talker.py", "listener.py"],
    "joy2twist": ["joy2twist.py", "display_joy.py", "publish_twist.py"],
    "gamepad": ["joy_node", "virtual_joystick"],
    "tutorial_tools": ["demo.py", "doctor.py", "draw_graph.py"],
    "fake_turtlebot_sim": ["fake_turtlebot.py"],
}


def shell(script, **environment):
    """Run a script with bash in the clean environment; return what it printed."""
    done = subprocess.run(
        ["bash", "-ec", script],
        env={**CLEAN, **environment},
        capture_output=True,
        text=True,
        check=False,
        timeout=300,
    )
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-3000:]
    return done.stdout


@pytest.fixture(scope="module")
def workspace(clone, tmp_path_factory):
    """A catkin workspace with the clone in its src folder, built and installed with catkin_make."""
    noetic = Path("/opt/ros/noetic/setup.bash")
    folder = tmp_path_factory.mktemp("catkin_ws")
    (folder / "src").mkdir()
    (folder / "src" / "ros1_tutorial").symlink_to(clone)
    source = f"source {noetic}; " if noetic.exists() else ""
    shell(f"{source}cd '{folder}' && catkin_make -DPYTHON_EXECUTABLE=/usr/bin/python3 install")
    return folder


@pytest.mark.parametrize("space", ["devel", "install"])
def test_every_node_and_file_is_found(workspace, space):
    enter = f"source '{workspace}/{space}/setup.bash'"
    for package, nodes in NODES.items():
        for node in nodes:
            found = shell(f"{enter}; catkin_find --libexec {package} {node}").split()
            assert len(found) == 1, node
            assert Path(found[0]).read_text().startswith("#!/usr/bin/python3\n")
    for package, name in (
        ("joy2twist", "bag/joy.bag"),
        ("joy2twist", "launch/launch_bag.launch"),
        ("fake_turtlebot_sim", "rviz/sim.rviz"),
        ("fake_turtlebot_sim", "urdf/turtlebot.urdf"),
    ):
        assert shell(f"{enter}; test -f $(rospack find {package})/{name} && echo there")


def test_the_installed_suite_drives(workspace, master_uri):
    said = shell(
        f"source '{workspace}/install/setup.bash'; rosrun tutorial_tools demo.py --for 3"
        " rviz:=false",
        ROS_MASTER_URI=master_uri,
    )
    assert "driven 0.00 m" not in said
    assert f"{workspace}/src" not in said  # nothing of the source space is used
