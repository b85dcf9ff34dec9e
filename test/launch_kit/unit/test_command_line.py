"""Which command lines start nodes, and with which arguments."""

import pytest

from launch_kit.command_line import given, starting

PYTHON = "/usr/bin/python3"


@pytest.mark.parametrize(
    ("command", "words"),
    [
        ([PYTHON, "/usr/bin/roslaunch", "joy2twist", "launch_bag.launch"],
         ["joy2twist", "launch_bag.launch"]),
        ([PYTHON, "/usr/bin/roslaunch", "--ros-args", "joy2twist", "launch_bag.launch"], []),
        ([PYTHON, "/usr/bin/rostest", "a.test"], []),  # a master of its own
        ([""], []),
    ],
)  # fmt: skip
def test_only_roslaunch_starts_nodes(command, words):
    assert starting(command) == words


def test_the_words_that_every_ros_program_takes_are_no_arguments():
    assert given(["a.launch", "world:=room", "__name:=x", "_rate:=5"]) == ["world:=room"]
