"""Who reads a launch file: it matters only where the nodes will be started on the master of all."""

import pytest

from node_kit import launch
from node_kit.launch import complaint, will_start

PYTHON = "/usr/bin/python3"


@pytest.mark.parametrize(
    ("command", "starts"),
    [
        ([PYTHON, "/usr/bin/roslaunch", "joy2twist", "launch_bag.launch"], True),
        (["/usr/bin/roslaunch", "--wait", "a.launch"], True),
        ([PYTHON, "/usr/bin/roslaunch", "--nodes", "joy2twist", "launch_bag.launch"], False),
        ([PYTHON, "/usr/bin/roslaunch", "--ros-args", "joy2twist", "launch_bag.launch"], False),
        ([PYTHON, "/usr/bin/roslaunch", "--dump-params", "a.launch"], False),
        ([PYTHON, "/usr/bin/rostest", "a.test"], False),  # a master of its own
        ([PYTHON, "/usr/bin/roslaunch-check", "launch"], False),
        ([PYTHON, "-c", "pass", "roslaunch"], False),
        ([""], False),
    ],
)
def test_only_roslaunch_starts_nodes(command, starts):
    assert will_start(command) is starts


def test_the_first_name_that_is_held_is_told_with_what_to_do(monkeypatch):
    held = {"/robot_7/joy_node": ("http://here:1", "at http://here:1, process 5")}
    monkeypatch.setattr(launch, "holder", lambda _, name: held.get(name))
    line = complaint(["/rosbag", "/robot_7//joy_node"], "http://localhost:11311")
    assert line.startswith("/robot_7/joy_node runs already, at http://here:1, process 5: end it")
    assert "rosnode kill /robot_7/joy_node" in line
    assert "ROS_MASTER_URI=" in line
    assert complaint(["rosbag"], "http://localhost:11311") is None
