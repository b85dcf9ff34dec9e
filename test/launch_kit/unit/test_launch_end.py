"""ends_launch: the normal end of a node ends the launch."""

import os
import signal
import subprocess
import sys

import pytest

from tutorial_testing.processes import REPOSITORY

COMMON = REPOSITORY / "common"
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
        [sys.executable, COMMON / "launch_kit/scripts/ends_launch", "sh", "-c", script],
        env={"PYTHONPATH": str(COMMON / "launch_kit/src"), "PATH": "/usr/bin:/bin"},
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True,
    )  # fmt: skip
    assert node.stdout.readline() == "ready\n"
    if number:
        os.killpg(node.pid, number)  # as roslaunch does
    assert (node.communicate(timeout=60)[0], node.returncode) == (said, code)
