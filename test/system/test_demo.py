"""./tutorial demo as a user calls it: what it prints, its exit code, what it leaves behind."""

import os
import re
import shutil
import signal
import subprocess
import time
from pathlib import Path

import pytest

from tutorial_testing.ports import free_port
from tutorial_testing.processes import Program, refuse
from tutorial_testing.waiting import BUSY_S, DEADLINE_S, wait_for

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


@pytest.mark.usefixtures("master_uri")
def test_demo_counts_and_drives(tutorial):
    with Program(tutorial, "demo", "--for", "5", "rviz:=false") as demo:
        check_demo(demo, 5)
        assert re.search(r"^demo: first /odom after [\d.]+ s$", demo.output, re.MULTILINE)


def test_demo_says_so_when_the_robot_stands(tutorial, tmp_path, master_uri):
    still = tmp_path / "still.bag"
    subprocess.run(
        [tutorial, "run", "rosbag", "filter", str(BAG), str(still), "not any(m.axes)"],
        check=True, capture_output=True, timeout=DEADLINE_S,
    )  # fmt: skip
    with Program(tutorial, "demo", "--for", "2", *BARE, f"bag:={still}") as demo:
        assert demo.wait() == 1
        assert "driven 0.00 m" in demo.output
    assert master_uri


@pytest.mark.usefixtures("master_uri")
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


@pytest.mark.usefixtures("master_uri")
def test_demo_reports_the_drive_when_ctrl_c_ends_it(tutorial):
    with Program(tutorial, "demo", *BARE) as demo:
        wait_for(lambda: "first /odom" in demo.output, "robot")
        began_s = time.monotonic()
        wait_until_it_drives(tutorial)
        demo.interrupt()
        took_s = time.monotonic() - began_s
        assert demo.wait() == 0, demo.output
        (said,) = LINE.finditer(demo.output)
        assert demo.output.endswith(f"{said[0]}\n")
        assert float(said["seconds"]) == pytest.approx(took_s, abs=BUSY_S)
        assert float(said["driven"]) > 0.0


IN_TERMINAL = "in another terminal: ./tutorial run rostopic echo /odom/pose/pose/position"


@pytest.mark.usefixtures("master_uri")
@pytest.mark.parametrize(
    ("arguments", "look"),
    [
        (["cockpit_port:={port}"], "to see it drive, open http://127.0.0.1:{port}/ in a browser"),
        (["cockpit:=false"], f"to see it drive, {IN_TERMINAL}"),
        ([*BARE], None),  # given by the user
    ],
)
def test_demo_says_where_to_look_without_a_screen(tutorial, arguments, look):
    port = free_port()
    arguments = [argument.format(port=port) for argument in arguments]
    with Program(tutorial, "demo", "--for", "0.5", *arguments, DISPLAY="") as demo:
        demo.wait()
        lines = [line for line in demo.output.splitlines() if "RViz is left out" in line]
        expected = [True] if look else []
        assert [look.format(port=port) in line for line in lines] == expected, demo.output


OWN = re.compile(r"export ROS_MASTER_URI=http://localhost:(\d+)$")


def check_refusal(line, master_uri, names):
    """A demonstration was refused because nodes run; the line says which, and what to do."""
    runs = "run" if " and " in names else "runs"
    assert line.startswith(f"demo: {names} {runs} already on {master_uri}; end "), line
    assert int(OWN.search(line)[1]) > int(master_uri.rsplit(":", 1)[1])


def test_a_second_demo_is_refused_and_the_first_drives_on(tutorial, master_uri):
    names = "/fake_turtlebot, /myjoystick2twist, /robot_state_publisher and /rosbag"
    with Program(tutorial, "demo", "--for", "600", *BARE) as first:
        wait_for(lambda: "first /odom" in first.output, "robot")
        check_refusal(refuse(tutorial, "demo", "--for", "1"), master_uri, names)
        wait_until_it_drives(tutorial)
        first.interrupt()
        assert first.wait() == 130


@pytest.mark.usefixtures("master_uri")
def test_of_two_demos_that_start_at_once_one_drives(tutorial):
    both = [Program(tutorial, "demo", "--for", "4", *BARE) for _ in range(2)]
    with both[0], both[1]:
        wait_for(lambda: both[0].ended or both[1].ended, "end of one")
        refused, drives = sorted(both, key=lambda program: program.ended, reverse=True)
        assert refused.wait() == 1
        assert " already on " in refused.output, refused.output
        assert len(refused.output.splitlines()) == 1
        check_demo(drives, 4)


def test_demo_is_refused_beside_another_sender_but_not_beside_a_dead_node(tutorial, master_uri):
    def start(*command):
        return Program(tutorial, "run", *command)

    def known(name):
        with start("rosnode", "list") as listing:
            assert listing.wait() == 0, listing.output
            return name in listing.output.splitlines()

    with start("roscore", "-p", master_uri.rsplit(":", 1)[1]) as roscore:
        wait_for(lambda: "started core service" in roscore.output, "roscore")
        sender = ("rostopic", "pub", "-r", "1", "/joy", "sensor_msgs/Joy", "{}", "__name:=sender")
        with start(*sender) as rival:
            wait_for(lambda: known("/sender"), "sender")
            check_refusal(refuse(tutorial, "demo", "--for", "1"), master_uri, "/sender")
            rival.interrupt()
            rival.wait()
        with start("rosrun", "fake_turtlebot_sim", "fake_turtlebot.py") as robot:
            wait_for(lambda: known("/fake_turtlebot"), "robot")
            check_refusal(refuse(tutorial, "demo", "--for", "1"), master_uri, "/fake_turtlebot")
            for pid in robot.left_behind():
                os.kill(pid, signal.SIGKILL)
            robot.wait()
        assert known("/fake_turtlebot")
        with Program(tutorial, "demo", "--for", "4", *BARE) as demo:
            check_demo(demo, 4)
        assert not roscore.ended
        roscore.interrupt()
        roscore.wait()


@pytest.mark.usefixtures("master_uri")
def test_demo_counts_no_messages_of_other_nodes(tutorial):
    far = "{pose: {pose: {position: {x: 100}}}}"
    publish = ("run", "rostopic", "pub", "-r", "200", "/odom", "nav_msgs/Odometry", far)
    with Program(tutorial, "demo", "--for", "6", *BARE) as demo:
        wait_for(lambda: "first /odom" in demo.output, "robot")
        with Program(tutorial, *publish) as other:
            check_demo(demo, 6)
            assert not other.ended, other.output
        assert float(LINE.search(demo.output)["driven"]) < 6 * FASTEST_M_PER_S


@pytest.mark.usefixtures("master_uri", "clean_environment")
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
