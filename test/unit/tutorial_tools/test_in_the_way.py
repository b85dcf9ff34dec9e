"""Which nodes keep a demonstration from a master, and the line that says so."""

import pytest

from tutorial_tools.demo.in_the_way import in_the_way, refusal

NODES = ["/fake_turtlebot", "/myjoystick2twist", "/rosbag"]
TOPICS = ("/joy", "/cmd_vel", "/odom")
ROSOUT = ["/rosout", ["/rosout", "/talker", "/robot_1/rosbag"]]


@pytest.mark.parametrize(
    ("publishers", "subscribers", "services", "names"),
    [
        ([ROSOUT], [], [["/rosout/get_loggers", ["/rosout"]]], []),
        ([["/joy", ["/pad"]]], [], [], ["/pad"]),
        ([["/robot_1/joy", ["/pad"]]], [], [], []),
        ([], [["/joy", ["/echo"]], ["/odom", ["/my_rviz"]]], [], []),
        # By name alone, whatever they do.
        ([["/rosout", ["/rosbag"]]], [], [], ["/rosbag"]),
        ([], [["/clock", ["/rosbag"]]], [], ["/rosbag"]),
        ([], [], [["/fake_turtlebot/reset", ["/fake_turtlebot"]]], ["/fake_turtlebot"]),
        ([["/odom", ["/other", "/fake_turtlebot"]]], [], [], ["/fake_turtlebot", "/other"]),
    ],
)
def test_in_the_way(publishers, subscribers, services, names):
    assert in_the_way([publishers, subscribers, services], NODES, TOPICS) == names


def test_the_line():
    uri, own = "http://localhost:11311", "http://localhost:11312"
    todo = f"or take a master of your own: export ROS_MASTER_URI={own}"
    assert refusal(uri, ["/a"], own) == f"/a runs already on {uri}; end it, {todo}"
    assert refusal(uri, ["/a", "/b"], own) == f"/a and /b run already on {uri}; end them, {todo}"
    assert refusal(uri, ["/a", "/b", "/c"], own).startswith("/a, /b and /c run already on ")
