"""The programs for launch files: names_free, ends_launch."""

import os
import signal
import subprocess
import sys

import pytest

from node_kit.launch import read_launch, will_start
from tutorial_testing.processes import REPOSITORY

pytest.importorskip("rospy", reason="no ROS for this Python: ./tutorial setup")


KIT = REPOSITORY / "common" / "node_kit"
PYTHON = "/usr/bin/python3"


@pytest.mark.parametrize(
    ("command", "starts"),
    [
        ([PYTHON, "/usr/bin/roslaunch", "joy2twist", "launch_bag.launch"], True),
        ([PYTHON, "/usr/bin/roslaunch", "--ros-args", "joy2twist", "launch_bag.launch"], False),
        ([PYTHON, "/usr/bin/rostest", "a.test"], False),  # a master of its own
        ([""], False),
    ],
)
def test_only_roslaunch_starts_nodes(command, starts):
    assert will_start(command) is starts


TWO_GROUPS = """<launch>
  <arg name="world" default=""/>
  <param name="not_run" command="false"/>
  <group ns="a"><node pkg="rospy" type="none" name="base"/></group>
  <group ns="b" if="$(eval world != '')"><node pkg="rospy" type="none" name="base"/></group>
</launch>"""


def test_nodes_are_found_in_their_namespaces_and_arguments_that_no_file_has(tmp_path):
    file = tmp_path / "two.launch"
    file.write_text(TWO_GROUPS)
    given = ["world:=room", "wrold:=maze", "__name:=x"]
    command = [PYTHON, "/usr/bin/roslaunch", "-p", "11400", str(file), *given]
    nodes, (line,) = read_launch(command)
    assert nodes == ["/a/base", "/b/base"]
    ignored = "which has world:=; did you mean world:=? (ignored)"
    assert line == f"wrold:=maze: not an argument of two.launch, {ignored}"
    file.write_text(TWO_GROUPS.replace("</launch>", "<include file='no'/></launch>"))
    assert read_launch(command) == (["/a/base", "/b/base"], [])  # roslaunch reports what is wrong


RUNS_ON = "trap 'echo ended; exit 5' INT TERM; echo ready; while :; do read x; done"


@pytest.mark.parametrize(
    ("script", "number", "said", "code"),
    [
        ("echo ready; exit 3", 0, "", 3),
        ("echo ready; kill -9 $$", 0, "", 137),
        (RUNS_ON, signal.SIGTERM, "ended\n", 5),
    ],
)
def test_ends_launch_passes_signals_on_and_exits_with_the_code_of_its_node(
    script, number, said, code
):
    node = subprocess.Popen(
        [sys.executable, KIT / "scripts" / "ends_launch", "sh", "-c", script],
        env={"PYTHONPATH": str(KIT / "src"), "PATH": "/usr/bin:/bin"},
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True,
    )  # fmt: skip
    assert node.stdout.readline() == "ready\n"
    if number:
        os.killpg(node.pid, number)  # as roslaunch does
    assert (node.communicate(timeout=60)[0], node.returncode) == (said, code)
