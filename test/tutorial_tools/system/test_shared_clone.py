"""A clone that its users cannot write, such as a teacher's in /opt: it builds, drives, checks."""

import os
import re
import shutil
import tempfile
from pathlib import Path

import pytest

from tutorial_testing.claims import claim
from tutorial_testing.processes import MARK, Program

USER = 54321  # an unused id
LONGEST_S = 600.0  # two builds and the check
# A user's environment, plus what identifies a Program. ./tutorial builds before it drives.
AS_USER = (
    f'exec env -i {MARK}="${MARK}" ROS_MASTER_URI="$ROS_MASTER_URI" HOME="$1" PATH=/usr/bin:/bin'
    f' setpriv --reuid={USER} --regid={USER} --clear-groups bash -exc "$0" "$2"'
)
SCRIPT = """
    cd "$0"
    ./tutorial demo --for 3 rviz:=false cockpit:=false
    mkdir ~/catkin_ws && cp -r test/tutorial_check/exercises/literal ~/catkin_ws/src
    ./tutorial check --in ~/catkin_ws 2 3
"""


@pytest.fixture
def folder():
    """A folder that all users may enter."""
    with tempfile.TemporaryDirectory() as made:
        Path(made).chmod(0o755)
        yield Path(made)


@claim(
    "A user without rights builds, drives and checks from a clone of another user, such as a "
    "teacher's"
)
@pytest.mark.long
@pytest.mark.skipif(os.geteuid() != 0, reason="only root can be another user")
@pytest.mark.usefixtures("master_uri")
def test_a_user_without_rights_builds_drives_and_checks(clone, folder):
    home, shared = folder / "home", folder / "ros1 tutorial"
    home.mkdir()
    os.chown(home, USER, USER)
    shutil.copytree(clone, shared, symlinks=True)
    for path in (shared, *shared.rglob("*")):
        if not path.is_symlink():
            path.chmod(path.stat().st_mode & 0o555 | 0o444)
    with Program("bash", "-c", AS_USER, SCRIPT, str(home), str(shared)) as program:
        assert program.wait(LONGEST_S) == 0, program.output
        assert re.search(r"driven (?!0\.00)", program.output)
        assert "2 of 2 exercises done" in program.output
