"""draw_graph.py over two hosts: the picture of the README, which this draws with

TUTORIAL_PICTURE=$PWD/common/doc/two_machines.png ./tutorial test system -k two_machines
"""

import os
import re
import struct
from pathlib import Path

from tutorial_testing.two_hosts.scene import ROBOT, WORKSTATION
from tutorial_testing.waiting import wait_for

START_S = 120.0  # RViz without a graphics card, on a busy machine
DRAW = "rosrun tutorial_tools draw_graph.py"
PICTURE_BYTES = 150_000  # at most, for a README
DRIVE = "/rosbag /joy /myjoystick2twist"
TWO_MACHINES = f"{DRIVE} /cmd_vel_mux/input/teleop /cmd_vel_mux /mobile_base/commands/velocity"
TWO_MACHINES += " /mobile_base /odom /my_rviz /initialpose /mobile_base"
BACK_TO_RVIZ = "/mobile_base /joint_states /robot_state_publisher /tf_static /my_rviz"


def path(names):
    """The arrows from the first name to the last: node, topic, node ..."""
    ends = [f'"{("node", "topic")[i % 2]} {name}"' for i, name in enumerate(names.split())]
    return [f"{one} -> {next_one}" for one, next_one in zip(ends, ends[1:])]


def draw(start, file):
    """Draw with a function that starts a command; the file's bytes."""
    with start(f"{DRAW} {file}") as program:
        assert program.wait() == 0, program.output
    return file.read_bytes()


def complete(start, file, *paths, without="/rosout"):
    """The DOT text, as soon as these paths are in it and another name is not."""
    arrows = {arrow for names in paths for arrow in path(names)}

    def text():
        text = draw(start, file).decode()
        there = arrows <= set(map(str.strip, text.splitlines()))
        return text if there and without not in text else None

    return wait_for(text, f"graph with {paths}", START_S)


def check_picture(start, tmp_path):
    """Draw what the README shows."""
    data = draw(start, Path(os.environ.get("TUTORIAL_PICTURE", tmp_path / "graph.png")))
    assert data.startswith(b"\x89PNG")
    assert struct.unpack(">I", data[16:20])[0] > 800  # [pixel] wide, as a page shows it
    assert len(data) < PICTURE_BYTES


def frame(text, machine):
    """Names of the nodes and topics in a machine's frame."""
    inside = re.search(rf'subgraph "cluster {re.escape(machine)}" {{\n(.*?)\n  }}', text, re.DOTALL)
    return set(re.findall(r'^ *"\w+ (\S+)" \[', inside[1], re.MULTILINE))


def test_graph_of_two_machines(scene, screen, tmp_path):
    scene.launch_robot()
    scene.launch_workstation(
        f"env DISPLAY={screen} LIBGL_ALWAYS_SOFTWARE=1 "
        "roslaunch joy2twist launch_joy_node_realTurtlebot.launch rviz:=true loop:=true "
        "bag:=$(rospack find joy2twist)/bag/joy.bag"
    )
    # The observer belongs to the test.
    with scene.start(ROBOT, "rosnode kill /observer") as program:
        assert program.wait() == 0, program.output

    def start(command):
        return scene.start(WORKSTATION, command)

    file, paths = tmp_path / "graph.dot", (TWO_MACHINES, BACK_TO_RVIZ)
    text = complete(start, file, *paths, without="/observer")
    assert frame(text, "192.168.1.20") == {"/rosbag", "/joy", "/myjoystick2twist", "/my_rviz"}
    robot = {"/cmd_vel_mux", "/mobile_base/commands/velocity", "/mobile_base"}
    assert frame(text, "192.168.1.10") == robot | {"/joint_states", "/robot_state_publisher"}
    check_picture(start, tmp_path)
