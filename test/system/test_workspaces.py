"""The packages in a workspace of the user's own: built, tested from it, and installed."""

import os
import subprocess
from pathlib import Path

import pytest

# No workspace sourced.
CLEAN = {"PATH": "/usr/bin:/bin", "HOME": os.environ["HOME"], "ROS_HOSTNAME": "localhost"}
NODES = [
    ("beginner_tutorials", "talker.py"), ("joy2twist", "joy2twist.py"), ("gamepad", "joy_node"),
    ("tutorial_tools", "doctor.py"), ("fake_turtlebot_sim", "fake_turtlebot.py"),
]  # fmt: skip
FILES = [
    ("joy2twist", "bag/joy.bag"), ("joy2twist", "launch/launch_bag.launch"),
    ("fake_turtlebot_sim", "rviz/sim.rviz"), ("fake_turtlebot_sim", "urdf/turtlebot.urdf"),
]  # fmt: skip


def shell(script, **environment):
    """Run a script with bash in the clean environment; return what it printed."""
    done = subprocess.run(
        ["bash", "-ec", script], env={**CLEAN, **environment},
        capture_output=True, text=True, check=False, timeout=300,
    )  # fmt: skip
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
    find = [f"source '{workspace}/{space}/setup.bash'"]
    find += [f"catkin_find --libexec {package} {node}" for package, node in NODES]
    find += [f"test -f $(rospack find {package})/{name}" for package, name in FILES]
    nodes = shell("\n".join(find)).splitlines()
    assert [Path(path).name for path in nodes] == [node for _, node in NODES]
    assert all(Path(path).read_text().startswith("#!/usr/bin/python3\n") for path in nodes)


def test_the_installed_suite_drives_without_its_sources(workspace, master_uri):
    demo = "rosrun tutorial_tools demo.py --for 3 rviz:=false"
    said = shell(f"source '{workspace}/install/setup.bash'; {demo}", ROS_MASTER_URI=master_uri)
    assert "driven 0.00 m" not in said and f"{workspace}/src" not in said
