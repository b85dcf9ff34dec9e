"""The commands of the page on colcon build the programs, and what they build runs."""

import re
import shutil

import pytest
from drive import REPOSITORY

from node_kit import ros2_python
from tutorial_testing.waiting import wait_for

PAGE = REPOSITORY / "common/doc/ROS2.md"


@pytest.mark.skipif(not shutil.which("colcon"), reason="no colcon in this system's archive")
def test_the_package_is_built_by_colcon_and_runs(start, tmp_path):
    (commands,) = re.findall(r"^## With colcon.*?```bash\n(.*?)```", PAGE.read_text(), re.S | re.M)
    talker = "install/ros2_tutorials/lib/ros2_tutorials/talker"
    script = f'cd "{REPOSITORY}"\nset -e\n{commands}\nexec "$0" {talker}'
    *environment, python = ros2_python.command([])
    program = start(*environment, f"HOME={tmp_path}", "bash", "-c", script, python)
    wait_for(lambda: "hello world" in program.output or program.ended, "talker")
    assert not program.ended, program.output
