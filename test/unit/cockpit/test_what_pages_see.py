"""Fields, curves, the graph, clients and words: what goes to pages."""

import json
import struct
from math import inf, nan, pi

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from geometry_msgs.msg import Quaternion
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Joy

from cockpit_server.clients import LONGEST_FLOOD, encoded
from cockpit_server.doctor import shown
from cockpit_server.fields import numeric_fields, parts_of, split, value_at
from cockpit_server.graph import Graph, without
from cockpit_server.logs import without_folders
from cockpit_server.motion import Motion, covered, motion
from cockpit_server.plots import class_of, fields_of
from cockpit_server.recording import corners, curves
from cockpit_server.resets import reset_service
from cockpit_server.robots import shown as robot_shown
from cockpit_server.seat import RefusedError
from cockpit_server.teleop import said
from tutorial_testing.seat_room import page, serialised


def test_numbers_in_messages():
    fields = fields_of("nav_msgs/Odometry")
    assert "pose/pose/position/x" in fields and "header/stamp" in fields
    assert "pose/covariance[0]" in fields and "pose/covariance[12]" not in fields
    assert "header/frame_id" not in fields
    assert "axes[0]" in fields_of("sensor_msgs/Joy")
    assert "transforms[0]/transform/rotation/w" in fields_of("tf2_msgs/TFMessage")
    assert fields_of("no_such/Type") == ()
    assert list(numeric_fields(class_of("std_msgs/String"), class_of)) == []
    assert fields[0] == "pose/pose/position/x"  # what is seldom drawn comes last


def test_a_number_by_its_name():
    odometry = Odometry()
    odometry.pose.pose.position.x = 1.5
    odometry.header.stamp.secs = 3
    assert value_at(odometry, parts_of("pose/pose/position/x")) == 1.5
    assert value_at(odometry, parts_of("header/stamp")) == 3.0
    assert value_at(Joy(axes=[0.5, 0.25]), parts_of("axes[1]")) == 0.25
    for nothing in ("axes[2]", "axes", "nothing", "serialize", "header/frame_id"):
        assert value_at(Joy(axes=[0.5, 0.25]), parts_of(nothing)) is None


@pytest.mark.parametrize(
    "field", ["", "a b", "a//b", "a[-1]", "a[1", "a.b", "/".join("a" * 9), "__class__"]
)
def test_what_is_no_field(field):
    with pytest.raises(ValueError, match="is no field"):
        parts_of(field)


def test_the_topic_of_a_field():
    topics = ["/a", "/a/b", "/c"]
    assert split("/a/b/x", topics) == ("/a/b", "x")
    assert split("/a/x", topics) == ("/a", "x")
    with pytest.raises(ValueError, match="no topic"):
        split("/d/x", topics)


def test_the_motion_of_an_odometry():
    odometry = Odometry()
    odometry.header.frame_id, odometry.child_frame_id = "robot_1/odom", "robot_1/base_footprint"
    odometry.pose.pose.position.x, odometry.pose.pose.position.y = 1.0, -2.0
    odometry.pose.pose.orientation = Quaternion(0.0, 0.0, 1.0, 0.0)
    odometry.twist.twist.linear.x, odometry.twist.twist.angular.z = 0.5, -0.25
    assert motion(serialised(odometry)) == (1.0, -2.0, pi, 0.5, -0.25)
    with pytest.raises(struct.error):
        motion(serialised(odometry)[:200])


@pytest.mark.parametrize(
    ("x", "yaw", "way"),
    [(1.1, 0.5, 7.1), (1.1, 0.0, 7.1), (1.6, 0.5, 7.0), (0.0, 0.0, 0.0), (nan, 0.5, 7.0)],
    ids=["drives", "drives straight", "was carried", "was reset", "is nowhere"],
)
def test_the_way_covered(x, yaw, way):
    last = Motion(1.0 if x else 0.2, 0.0, yaw, 0.5, 0.0)
    assert covered(last, Motion(x, 0.0, yaw, 0.5, 0.0), 7.0) == pytest.approx(way)


def test_a_place_that_is_none_is_left_out():
    here = Motion(1.0, -1e6, 0.5, 0.25, -0.5)
    everything = {"x", "y", "yaw", "v", "w", "covered", "age"}
    assert set(robot_shown(here, 1.0, 2.0, 3.0)) == everything
    for wrong in ({"x": nan}, {"y": inf}, {"yaw": nan}, {"x": 1e6 + 1}, {"y": -1e300}):
        there = here._replace(**wrong)
        assert set(robot_shown(there, 1.0, 2.0, 3.0)) == everything - {"x", "y", "yaw"}
    assert set(robot_shown(here._replace(w=nan), 1.0, 2.0, 3.0)) == everything - {"w"}


GRAPH = Graph(
    publishers={"/odom": {"/sim"}, "/robot_1/odom": {"/room"}, "/robot_2/odom": {"/room"}},
    subscribers={"/odom": {"/rviz"}, "/real/joy": {"/joy2twist"}},
    services={"/sim/reset": {"/sim"}, "/room/reset": {"/room"}, "/robot_2/reset": {"/room"}},
    types={
        "/odom": "nav_msgs/Odometry", "/robot_1/odom": "nav_msgs/Odometry",
        "/robot_2/odom": "std_msgs/String", "/real/joy": "sensor_msgs/Joy",
    },
)  # fmt: skip


def test_robots_have_an_odometry_or_hear_a_joystick():
    assert GRAPH.robots_with_odometry() == {"", "robot_1"}
    assert GRAPH.robots() == {"", "robot_1", "real"}


def test_a_node_and_whom_it_speaks_to():
    about = GRAPH.about_node("/sim")
    assert about["speaks_to"] == ["/rviz"]
    assert (about["publishes"], about["services"]) == (["/odom"], ["/sim/reset"])
    assert {"from": "topic /odom", "to": "node /rviz"} in GRAPH.parts()["edges"]


def test_the_cockpit_is_a_part_of_the_graph_where_it_drives():
    column = [["/rosout", ["/cockpit", "/joy_node"]], ["/robot/joy", ["/cockpit"]]]
    assert without("/cockpit", column) == {"/rosout": {"/joy_node"}}
    shown = without("/cockpit", column, shown_in={"/robot/joy"})
    assert shown == {"/rosout": {"/joy_node"}, "/robot/joy": {"/cockpit"}}


def test_a_reset_is_of_one_robot():
    assert reset_service(GRAPH, "") == "/sim/reset"
    assert reset_service(GRAPH, "robot_2") == "/robot_2/reset"
    with pytest.raises(RefusedError, match="robot_1 has no service"):
        reset_service(GRAPH, "robot_1")  # the node's own would reset both


def test_what_joy2twist_says():
    array = DiagnosticArray()
    for name, words in (
        ("myjoystick2twist: joystick", "driving"),
        ("robot_1/myjoystick2twist: joystick", "stopped: not armed, release the sticks"),
        ("fake_turtlebot: simulation", "running"),
    ):
        array.status.append(DiagnosticStatus(name=name, message=words, level=1))
    told = dict(said(serialised(array)))
    assert set(told) == {"", "robot_1"}
    assert told[""]["state"] == "driving"
    assert told["robot_1"]["state"] == "stopped" and told["robot_1"]["why"].endswith("sticks")
    assert told[""]["deadman"] is None
    for button in ("4", "none"):
        array.status[0].values = [KeyValue("Dead-man button", button)]
        assert dict(said(serialised(array)))[""]["deadman"] == button
    assert said(b"bytes that are none: joystick") == []


def test_lines_of_the_doctor():
    well = {"level": "ok", "subject": "master", "text": "it answers"}
    assert shown("ok       master    it answers\n") == well
    assert shown("wrong    topics    nobody")["level"] == "wrong"
    unknown = {"level": "note", "subject": "joystick", "text": "none"}
    assert shown("unknown  joystick  none") == unknown
    summary = shown("doctor: 1 ok, 0 wrong, 0 unknown\n")
    assert summary == {"level": "note", "subject": "", "text": "doctor: 1 ok, 0 wrong, 0 unknown"}


def test_curves_keep_their_corners():
    assert corners([[0, 1], [1, 1], [2, 1], [3, 2], [4, 1]]) == [[0, 1], [2, 1], [3, 2], [4, 1]]
    assert corners([[0, 1]]) == [[0, 1]] and corners([]) == []
    joys = {"/joy": [(0.0, (0.0, 1.0), (0,)), (0.5, (0.5, 1.0), (1,))]}
    assert curves(joys)["/joy/axes[0]"] == [[0.0, 0.0], [0.5, 0.5]]
    assert set(curves(joys)) == {"/joy/axes[0]", "/joy/axes[1]", "/joy/buttons[0]"}


@pytest.mark.parametrize(
    ("text", "shown_text"),
    [("in /home/ada/ws/x.bag", "in ./x.bag"), ("/home/ada/.ros/log", "~/.ros/log"),
     ("/home/ada", "~"), ("/home/ada2/x /home/ada/ws-2", "/home/ada2/x ~/ws-2")],
)  # fmt: skip
def test_folders_of_the_server_are_not_shown(text, shown_text):
    assert without_folders(text, "/home/ada", "/home/ada/ws") == shown_text


def test_a_message_is_json_without_infinity():
    assert json.loads(encoded("x", y=1)) == {"kind": "x", "y": 1}
    with pytest.raises(ValueError):
        encoded("x", y=float("inf"))


def test_a_flood_is_dropped_and_then_closed():
    one, sent = page()
    taken = sum(one.allows(100.0) for _ in range(LONGEST_FLOOD))
    assert taken < 300 and sent == []
    while not sent:
        one.allows(100.0)
    assert sent == ["closed"]


def test_refusals_are_told_but_not_without_end():
    one, sent = page()
    for _ in range(1000):
        one.refuse("drive", "no", 100.0)
    assert 0 < len(sent) <= 10
