"""What the demonstration refuses before it starts, and its line; test_demo.py of system runs it."""

import math

import pytest
import rosbag
from std_msgs.msg import String

from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY
from tutorial_tools.demo.launch import DriveReport
from tutorial_tools.demo.program import check_bag, in_the_way, refusal
from tutorial_tools.launch_arguments import launch_arguments
from tutorial_tools.ros.rqt_bag import BagError

JOY2TWIST = REPOSITORY / "joy2twist"
LAUNCH_FILE = str(JOY2TWIST / "launch" / "launch_bag.launch")
NODES = ["/fake_turtlebot", "/myjoystick2twist", "/rosbag"]
TOPICS = ("/joy", "/cmd_vel", "/odom")


@claim("A wrong argument or bag is named before the start", because="a bag")
def test_a_bag_without_a_joystick_is_refused(tmp_path):
    with rosbag.Bag(str(tmp_path / "a.bag"), "w") as bag:
        bag.write("/chatter", String("hello"))
    with pytest.raises(BagError, match=r"a\.bag: holds no message on /joy"):
        check_bag(str(tmp_path / "a.bag"))


@claim("A wrong argument or bag is named before the start")
@pytest.mark.parametrize(
    ("argument", "line"),
    [
        ("rviz=true", "rviz=true: not NAME:=VALUE, := is missing; did you mean rviz:=true.$"),
        ("rvz:=1", "rvz:=1: not an argument of launch_bag.launch, .*; did you mean rviz:=.$"),
    ],
)
def test_a_wrong_argument_is_named(argument, line):
    with pytest.raises(ValueError, match=f"^{line}"):
        launch_arguments(LAUNCH_FILE, [argument])


@pytest.mark.parametrize(
    ("publishers", "subscribers", "services", "names"),
    [
        ([["/joy", ["/pad"]], ["/robot_1/joy", ["/other"]]], [], [], ["/pad"]),
        ([], [["/joy", ["/echo"]], ["/odom", ["/my_rviz", "/rosbag"]]], [], ["/rosbag"]),
        ([["/odom", ["/other", "/fake_turtlebot"]]], [], [], ["/fake_turtlebot", "/other"]),
    ],
)
def test_only_nodes_that_drive_or_have_a_name_of_ours_are_in_the_way(
    publishers, subscribers, services, names
):
    assert in_the_way([publishers, subscribers, services], NODES, TOPICS) == names


def test_the_line_of_a_refusal():
    uri, own = "http://localhost:11311", "export ROS_MASTER_URI=http://localhost:11312"
    todo = f"or take a master of your own: {own}"
    assert f"/a runs already on {uri}; end it, {todo}" in refusal(uri, ["/a"])
    assert f"/a, /b and /c run already on {uri}; end them" in refusal(uri, ["/a", "/b", "/c"])


def test_messages_way_and_final_pose():
    report = DriveReport(("/joy", "/odom"))
    assert report.line(1.5) == "1.5 s: 0 /joy, 0 /odom; no pose"
    for x_m, y_m, yaw_deg in ((0, 0, 0), (0, 0, 0), (3, 4, 5), (3, 3, 270)):
        half = math.radians(yaw_deg) / 2
        report.add_pose(x_m, y_m, math.sin(half), math.cos(half))
    report.counts["/joy"] += 2
    assert report.moved
    counted = "20.0 s: 2 /joy, 0 /odom; driven 6.00 m"
    assert report.line(20) == f"{counted}; final pose x 3.00 m, y 3.00 m, yaw -90.0 deg"
