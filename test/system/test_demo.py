"""./tutorial demo as a user calls it: what it prints, its exit code, what it leaves behind."""

import re
import shutil
import subprocess
import time
from pathlib import Path

import pytest

from tutorial_testing.ports import free_port
from tutorial_testing.processes import Program, refuse
from tutorial_testing.waiting import BUSY_S, DEADLINE_S, wait_for

pytestmark = pytest.mark.usefixtures("master_uri")
BAG = Path(__file__).resolve().parents[2] / "joy2twist" / "bag" / "joy.bag"
LINE = re.compile(
    r"^demo: (?P<seconds>[\d.]+) s: (?P<joy>\d+) /joy, (?P<cmd_vel>\d+) /cmd_vel, "
    r"(?P<odom>\d+) /odom; driven (?P<driven>[\d.]+) m; "
    r"final pose x -?[\d.]+ m, y -?[\d.]+ m, yaw -?[\d.]+ deg$",
    re.MULTILINE,
)
FASTEST_M_PER_S = 0.7  # a TurtleBot 2
# For what is not about the page or the view: the demonstration works less.
BARE = ("rviz:=false", "cockpit:=false")
DRIVEN = """
import rospy
from nav_msgs.msg import Odometry
rospy.init_node("look", anonymous=True, log_level=rospy.ERROR)
while rospy.wait_for_message("/odom", Odometry, 30).twist.twist.linear.x < 0.1:
    pass
"""


def wait_until_it_drives(tutorial):
    with Program(tutorial, "run", "python3", "-c", DRIVEN) as look:
        assert look.wait() == 0, look.output


def check_demo(program, seconds):
    """The demonstration ran for a time: its line, its counts, its exit code."""
    assert program.wait(seconds + DEADLINE_S) == 0, program.output
    said = LINE.search(program.output)
    assert said, program.output
    for topic in ("joy", "cmd_vel", "odom"):
        assert int(said[topic]) == pytest.approx(50 * seconds, rel=0.2)
    assert float(said["driven"]) > 0.3
    assert "Traceback" not in program.output
    wait_for(lambda: not program.left_behind(), "end of every process")


def test_demo_counts_drives_and_says_where_to_look_without_a_screen(tutorial):
    port = free_port()
    with Program(tutorial, "demo", "--for", "5", f"cockpit_port:={port}", DISPLAY="") as demo:
        check_demo(demo, 5)
        assert re.search(r"^demo: first /odom after [\d.]+ s$", demo.output, re.MULTILINE)
        look = f"RViz is left out; to see it drive, open http://127.0.0.1:{port}/ in a browser"
        assert look in demo.output, demo.output


def test_demo_says_so_when_the_robot_stands(tutorial, tmp_path):
    still = tmp_path / "still.bag"
    subprocess.run(
        [tutorial, "run", "rosbag", "filter", str(BAG), str(still), "not any(m.axes)"],
        check=True, capture_output=True, timeout=DEADLINE_S,
    )  # fmt: skip
    with Program(tutorial, "demo", "--for", "2", *BARE, f"bag:={still}", DISPLAY="") as demo:
        assert demo.wait() == 1
        assert "driven 0.00 m" in demo.output
        assert "RViz is left out" not in demo.output  # by the user's own wish


@pytest.mark.parametrize("sign", ["process[fake_turtlebot", "first /odom"])
def test_demo_ends_cleanly_on_ctrl_c(tutorial, sign):
    """While the nodes still load, and later; nothing is left behind."""
    with Program(tutorial, "demo", "--for", "600", "rviz:=false") as demo:
        wait_for(lambda: sign in demo.output, sign)
        demo.interrupt()
        assert demo.wait() == 130
        wait_for(lambda: not demo.left_behind(), "end of every process")
        # Python prints a traceback if it is interrupted in its very first milliseconds.
        assert sign != "first /odom" or "Traceback" not in demo.output


def test_a_second_demo_is_refused_and_the_first_drives_on_until_ctrl_c(tutorial, master_uri):
    look = "in another terminal: ./tutorial run rostopic echo /odom/pose/pose/position"
    names = "/fake_turtlebot, /myjoystick2twist, /robot_state_publisher and /rosbag"
    with Program(tutorial, "demo", "cockpit:=false", DISPLAY="") as first:
        wait_for(lambda: "first /odom" in first.output, "robot")
        began_s = time.monotonic()
        assert f"to see it drive, {look}\n" in first.output
        line = refuse(tutorial, "demo", "--for", "1")
        assert line.startswith(f"demo: {names} run already on {master_uri}; end "), line
        own = re.search(r"export ROS_MASTER_URI=http://localhost:(\d+)$", line)
        assert int(own[1]) > int(master_uri.rsplit(":", 1)[1])
        wait_until_it_drives(tutorial)
        first.interrupt()
        took_s = time.monotonic() - began_s
        assert first.wait() == 0, first.output
        (said,) = LINE.finditer(first.output)
        assert first.output.endswith(f"{said[0]}\n")
        assert float(said["seconds"]) == pytest.approx(took_s, abs=BUSY_S)
        assert float(said["driven"]) > 0.0


def test_of_two_demos_that_start_at_once_one_drives(tutorial):
    both = [Program(tutorial, "demo", "--for", "4", *BARE) for _ in range(2)]
    with both[0], both[1]:
        wait_for(lambda: both[0].ended or both[1].ended, "end of one")
        refused, drives = sorted(both, key=lambda program: program.ended, reverse=True)
        assert refused.wait() == 1
        assert " already on " in refused.output, refused.output
        assert len(refused.output.splitlines()) == 1
        check_demo(drives, 4)


def test_demo_drives_beside_a_dead_node_and_counts_no_messages_of_others(tutorial, master_uri):
    port = master_uri.rsplit(":", 1)[1]
    far = "{pose: {pose: {position: {x: 100}}}}"
    publish = ("rostopic", "pub", "-r", "200", "/odom", "nav_msgs/Odometry", far)
    list_nodes = [tutorial, "run", "rosnode", "list"]

    def robot_is_known():
        listed = subprocess.run(list_nodes, capture_output=True, text=True, check=False)
        return "/fake_turtlebot\n" in listed.stdout

    with Program(tutorial, "run", "roscore", "-p", port) as roscore:
        wait_for(lambda: "started core service" in roscore.output, "roscore")
        with Program(tutorial, "run", "rosrun", "fake_turtlebot_sim", "fake_turtlebot.py") as robot:
            wait_for(robot_is_known, "robot")
            robot.kill()
        assert robot_is_known()
        with Program(tutorial, "demo", "--for", "6", *BARE) as demo:
            wait_for(lambda: "first /odom" in demo.output or demo.ended, "robot")
            with Program(tutorial, "run", *publish) as other:
                check_demo(demo, 6)
                assert not other.ended, other.output
            assert float(LINE.search(demo.output)["driven"]) < 6 * FASTEST_M_PER_S
        assert not roscore.ended
        roscore.interrupt()
        roscore.wait()


@pytest.mark.usefixtures("clean_environment")
def test_a_clone_below_a_path_with_spaces_beside_another_python(clone, tmp_path, monkeypatch):
    """What a user's machine may have: spaces in the path, a python3 without ROS first on PATH."""
    other = tmp_path / "bin"
    other.mkdir()
    (other / "python3").write_text("#!/bin/sh\necho 'not the Python of ROS' >&2\nexit 1\n")
    (other / "python3").chmod(0o755)
    monkeypatch.setenv("PATH", str(other), prepend=":")
    monkeypatch.setenv("TUTORIAL_WORKSPACE", str(tmp_path / "ws"))
    with Program(str(clone / "tutorial"), "demo", "--for", "4", *BARE) as demo:
        wait_for(lambda: "first /odom" in demo.output or demo.ended, "workspaces and robot", 300)
        check_demo(demo, 4)
        assert "not the Python of ROS" not in demo.output
    shutil.rmtree(tmp_path / "ws")
