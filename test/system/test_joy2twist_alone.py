"""joy2twist in a workspace of someone else's: the commands of its README, with two folders."""

import re
from pathlib import Path

import pytest

from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for

REPOSITORY = Path(__file__).resolve().parents[2]
README = (REPOSITORY / "joy2twist/README.md").read_text()
SECTION = README.partition("## In your own workspace")[2].partition("\n## ")[0]
BASH, YAML = (
    re.findall(rf"^```{kind}\n(.*?)^```", SECTION, re.M | re.S)[0] for kind in ("bash", "yaml")
)
HELD = "{axes: [0.5, 1, 0, 0, 0, 0, 0, 0], buttons: [0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0]}"


@pytest.fixture
def alone(tmp_path, master_uri, monkeypatch):
    """alone(script): a Program of bash, as a user with Debian's ROS, and nothing of the suite."""
    for name in ("CMAKE_PREFIX_PATH", "ROS_PACKAGE_PATH", "PYTHONPATH", "ROS_ETC_DIR"):
        monkeypatch.delenv(name, raising=False)
    (tmp_path / "ros1_tutorial").symlink_to(REPOSITORY)
    (tmp_path / "xbox.yaml").write_text(YAML)

    def begin(script):
        return Program("bash", "-ec", f"cd; {script}", PATH="/usr/bin:/bin", HOME=str(tmp_path))

    with begin(f"roscore -p {master_uri.rsplit(':', 1)[1]}") as roscore:
        wait_for(lambda: "started core service" in roscore.output, "roscore")
        yield begin


def test_two_folders_and_a_file_of_teleop_twist_joy_drive_another_robot(alone):
    with alone(BASH) as node:
        wait_for(lambda: "hold button 5" in node.output or node.ended, "joy2twist")
        assert not node.ended, node.output
        with alone(f'rostopic pub -r 10 joy sensor_msgs/Joy "{HELD}"'), alone(
            "rostopic echo -n 1 /base/cmd_vel"
        ) as robot:
            assert robot.wait() == 0
            velocity = list(map(float, re.findall(r"[xyz]: (\S+)", robot.output)))
    assert velocity == pytest.approx([0.7, 0, 0, 0, 0, 0.2])
