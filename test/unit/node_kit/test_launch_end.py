"""ends_launch where no roslaunch has started it: it is the node, its exit code and its signals."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from node_kit.launch import name_of

KIT = Path(__file__).resolve().parents[3] / "common" / "node_kit"


def ends_launch(script):
    """Start it with a node that is a script of the shell."""
    return subprocess.Popen(
        [sys.executable, KIT / "scripts" / "ends_launch", "sh", "-c", script],
        env={"PYTHONPATH": str(KIT / "src"), "PATH": "/usr/bin:/bin"},
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True,
    )  # fmt: skip


@pytest.mark.parametrize(("script", "code"), [("true", 0), ("exit 3", 3), ("kill -9 $$", 137)])
def test_its_exit_code_is_that_of_the_node(script, code):
    node = ends_launch(script)
    assert (node.communicate(timeout=60)[0], node.returncode) == ("", code)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_it_as_it_ends_the_node(number):
    node = ends_launch("trap 'echo ended; exit 5' INT TERM; echo ready; while :; do read x; done")
    assert node.stdout.readline() == "ready\n"
    os.killpg(node.pid, number)  # as roslaunch does
    assert (node.communicate(timeout=60)[0], node.returncode) == ("ended\n", 5)


def test_the_name_that_roslaunch_gives():
    assert name_of(["/usr/lib/rosbag/play", "a.bag", "__name:=rosbag"]) == "rosbag"
    assert name_of(["play"]) == "play"
