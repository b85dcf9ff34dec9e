"""joy2twist in another workspace: its README's commands, with only two folders of the suite."""

import re

import pytest

from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY, Program
from tutorial_testing.waiting import wait_for

README = (REPOSITORY / "joy2twist/README.md").read_text()
SECTION = README.partition("## In your own workspace")[2].partition("\n## ")[0]
BASH, YAML = (
    re.findall(rf"^```{kind}\n(.*?)^```", SECTION, re.M | re.S)[0] for kind in ("bash", "yaml")
)
# Everything is released, then LB and the stick are held and tremble as in a hand.
JOYS = "\n---\n".join(
    f"{{axes: [{0.5 * held}, {held}, {0.01 * (number % 2)}], buttons: [0, 0, 0, 0, {held}]}}"
    for number in range(1000) for held in [int(number > 20)]
)  # fmt: skip


@pytest.fixture
def alone(tmp_path, master_uri, monkeypatch):
    """alone(script): start a bash script as a user with Debian's ROS and without the suite."""
    for name in ("CMAKE_PREFIX_PATH", "ROS_PACKAGE_PATH", "PYTHONPATH", "ROS_ETC_DIR"):
        monkeypatch.delenv(name, raising=False)
    (tmp_path / "ros1_tutorial").symlink_to(REPOSITORY)
    (tmp_path / "xbox.yaml").write_text(YAML)
    (tmp_path / "joys.yaml").write_text(JOYS)

    def begin(script):
        return Program("bash", "-ec", f"cd; {script}", PATH="/usr/bin:/bin", HOME=str(tmp_path))

    with begin(f"roscore -p {master_uri.rsplit(':', 1)[1]}") as roscore:
        wait_for(lambda: "started core service" in roscore.output, "roscore")
        yield begin


@claim("In a workspace of another, two folders are enough")
def test_two_folders_and_a_file_of_teleop_twist_joy_drive_another_robot(alone):
    with alone(BASH) as node:
        wait_for(lambda: "hold button 4" in node.output or node.ended, "joy2twist")
        assert not node.ended, node.output
        joys = "rostopic pub -r 20 -f joys.yaml joy sensor_msgs/Joy"
        with alone("rostopic echo -p /base/cmd_vel") as robot:
            with alone(joys) as stick:
                wait_for(lambda: ",0.7," in robot.output or stick.ended, "robot that drives")
                assert ",0.7,0.0,0.0,0.0,0.0,0.2\n" in robot.output, stick.output
            wait_for(lambda: robot.output.splitlines()[-1].endswith(",0.0" * 6), "zeros at the end")
    launch = "joy2twist_turtlebot.launch joy_config:=xbox cmd_vel:=/base/cmd_vel"
    build = "cp -r ~/ros1_tutorial/common/launch_kit own_ws/src; cd own_ws; catkin_make"
    with alone(f"{build}; . devel/setup.bash; roslaunch joy2twist {launch}") as node:
        wait_for(lambda: "hold button 4, or 5" in node.output or node.ended, "joy2twist")
        assert not node.ended, node.output
