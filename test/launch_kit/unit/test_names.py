"""Names that a launch needs free."""

import pytest

from launch_kit.names import in_the_way, refusal

NODES = ["/fake_turtlebot", "/myjoystick2twist", "/rosbag"]
TOPICS = ("/joy", "/cmd_vel", "/odom")


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
    one = refusal(uri, {"/a": "at http://here:5, process 7"})
    assert one.startswith(f"/a runs already on {uri}, at http://here:5, process 7: end it first (")
    several = refusal(uri, dict.fromkeys(("/a", "/b", "/c"), "at http://here:5"))
    assert several.startswith(f"/a, /b and /c run already on {uri}: end them first, or ")
    assert all(line.endswith(f"have a master of your own ({own})") for line in (one, several))
