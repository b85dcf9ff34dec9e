"""The packages in the user's own workspace: built and installed."""

import os
import subprocess
from pathlib import Path

import pytest

from tutorial_testing.claims import claim
from tutorial_testing.waiting import LONGEST_S

# No workspace sourced.
CLEAN = {"PATH": "/usr/bin:/bin", "HOME": os.environ["HOME"], "ROS_HOSTNAME": "localhost"}


def shell(script, **environment):
    """Run a script with bash in the clean environment; return what it printed."""
    done = subprocess.run(
        ["bash", "-ec", script], env={**CLEAN, **environment},
        capture_output=True, text=True, check=False, timeout=LONGEST_S,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-3000:]
    return done.stdout


@claim("The suite works in a catkin workspace of one's own, and installed without its sources")
@pytest.mark.night  # it builds all packages
def test_the_installed_suite_is_whole_and_drives_without_its_sources(clone, tmp_path, master_uri):
    """It is built in a catkin workspace whose src folder has a link to the clone."""
    noetic, suite = Path("/opt/ros/noetic/setup.bash"), tmp_path / "src/ros1_tutorial"
    suite.parent.mkdir()
    suite.symlink_to(clone)
    source = f"source {noetic}; " if noetic.exists() else ""
    shell(f"{source}cd '{tmp_path}' && catkin_make -DPYTHON_EXECUTABLE=/usr/bin/python3 install")
    for folder in ("", "common/", "common/stand_ins/"):
        for script in suite.glob(f"{folder}*/scripts/*[!_]"):
            installed = tmp_path / "install/lib" / script.parts[-3] / script.name
            assert script.is_dir() or installed.read_text().startswith("#!/usr/bin/python3\n")
    demo = "rosrun tutorial_tools demo.py --for 3 rviz:=false"
    said = shell(f"source '{tmp_path}/install/setup.bash'; {demo}", ROS_MASTER_URI=master_uri)
    assert "driven 0.00 m" not in said and f"{tmp_path}/src" not in said
