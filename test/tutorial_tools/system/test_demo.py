"""./tutorial demo as a user calls it: its output, its exit code and what it leaves behind."""

import re

import pytest

from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY, Program, free_port
from tutorial_testing.waiting import DEADLINE_S, lost_s, wait_for

pytestmark = pytest.mark.usefixtures("master_uri")
BAG = REPOSITORY / "joy2twist" / "bag" / "joy.bag"
LINE = re.compile(
    r"^demo: (?P<seconds>[\d.]+) s: (?P<joy>\d+) /joy, (?P<cmd_vel>\d+) /cmd_vel, "
    r"(?P<odom>\d+) /odom; driven (?P<driven>[\d.]+) m; "
    r"final pose x -?[\d.]+ m, y -?[\d.]+ m, yaw -?[\d.]+ deg$",
    re.MULTILINE,
)
FASTEST_M_PER_S = 0.7  # a TurtleBot 2
# For tests that need neither page nor view: the demonstration does less.
BARE = ("rviz:=false", "cockpit:=false")


def check_demo(program, seconds):
    """Check the line, counts and exit code of a demonstration of this length."""
    lost = lost_s()
    assert program.wait(seconds + DEADLINE_S) == 0, program.output
    fewest = 40 * (seconds + lost - lost_s())
    said = LINE.search(program.output)
    assert said, program.output
    for topic in ("joy", "cmd_vel", "odom"):
        assert fewest < int(said[topic]) < 60 * seconds
    assert float(said["driven"]) > 0.3
    assert "Traceback" not in program.output
    wait_for(lambda: not program.left_behind(), "end of every process")


@claim("It fails if the robot stands")
def test_demo_says_so_when_the_robot_stands(call, tmp_path):
    still = tmp_path / "still.bag"
    assert call("run", "rosbag", "filter", str(BAG), str(still), "not any(m.axes)")[0] == 0
    code, output = call("demo", "--for", "2", *BARE, f"bag:={still}", DISPLAY="")
    assert code == 1 and "driven 0.00 m" in output
    assert "RViz is left out" not in output  # the user asked for no RViz


@claim("Ctrl-C ends it and leaves nothing")
def test_ctrl_c_ends_a_demo_that_loads_and_nothing_is_left(tutorial):
    with Program(tutorial, "demo", "--for", "600", "rviz:=false") as demo:
        wait_for(lambda: "process[fake_turtlebot" in demo.output, "robot")
        demo.interrupt()
        assert demo.wait() == 130
        wait_for(lambda: not demo.left_behind(), "end of every process")


@claim("Ctrl-C ends it and leaves nothing", because="while it drives")
def test_ctrl_c_ends_a_demo_that_drives_with_its_line_and_nothing_is_left(tutorial):
    with Program(tutorial, "demo", "rviz:=false") as first:
        wait_for(lambda: "first /odom" in first.output, "robot")
        first.interrupt()
        assert first.wait() == 0, first.output
        assert first.output.endswith(f"{LINE.search(first.output)[0]}\n")
        wait_for(lambda: not first.left_behind(), "end of every process")


@claim("A second one is refused with a master of its own to take; of two at once one drives")
@claim("It drives, counts, and says where to look without a screen")
def test_of_two_demos_at_once_one_drives_and_says_where_to_look_without_a_screen(tutorial):
    command = (tutorial, "demo", "--for", "5", f"cockpit_port:={free_port()}")
    both = [Program(*command, DISPLAY="") for _ in range(2)]
    with both[0], both[1]:
        wait_for(lambda: both[0].ended or both[1].ended, "end of one")
        refused, drives = sorted(both, key=lambda program: program.ended, reverse=True)
        assert refused.wait() == 1
        assert re.fullmatch(r".* already on .*\n", refused.output), refused.output
        check_demo(drives, 5)
        look = f"RViz is left out; to see it drive, open http://127.0.0.1:{command[-1][14:]}/ in a"
        assert look in drives.output, drives.output


@claim(
    "It counts its own nodes' messages alone, a dead node hinders nothing, and no line of a log "
    "asks the master"
)
def test_demo_drives_beside_a_dead_node_and_counts_no_messages_of_others(
    tutorial, call, master_uri
):
    far = "{pose: {pose: {position: {x: 100}}}}"
    publish = ("rostopic", "pub", "-r", "200", "/odom", "nav_msgs/Odometry", far)
    with Program(tutorial, "run", "roscore", "-p", master_uri.rsplit(":", 1)[1]) as roscore:
        wait_for(lambda: "process[rosout-1]: started" in roscore.output, "roscore")
        asked = call("run", "rosparam", "get", "/rosout_disable_topics_generation")
        assert asked == (0, "false\n")  # otherwise rospy asks for it with each line
        with Program(tutorial, "run", "rosrun", "fake_turtlebot_sim", "fake_turtlebot.py"):
            nodes = lambda: call("run", "rosnode", "list")[1]  # noqa: E731
            wait_for(lambda: "/fake_turtlebot\n" in nodes(), "robot, to be killed next")
        with Program(tutorial, "demo", "--for", "6", *BARE) as demo:
            wait_for(lambda: "first /odom" in demo.output or demo.ended, "robot")
            with Program(tutorial, "run", *publish) as other:
                check_demo(demo, 6)
                assert not other.ended, other.output
            assert float(LINE.search(demo.output)["driven"]) < 6 * FASTEST_M_PER_S
