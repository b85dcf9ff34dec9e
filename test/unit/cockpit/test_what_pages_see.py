"""Fields, curves, the graph, clients and words: what goes to pages."""

import json
from math import nan, pi
from types import SimpleNamespace

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from geometry_msgs.msg import Quaternion
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Joy

from cockpit_server.clients import LONGEST_FLOOD, encoded
from cockpit_server.feeds import read
from cockpit_server.fields import parts_of, split, value_at
from cockpit_server.graph import Graph, without
from cockpit_server.motion import Motion, covered, motion
from cockpit_server.seat import RefusedError
from cockpit_server.sources.doctor import shown
from cockpit_server.sources.graph_view import GraphView
from cockpit_server.sources.logs import without_folders
from cockpit_server.sources.plots import fields_of
from cockpit_server.sources.recording import corners, curves
from cockpit_server.sources.resets import reset_service
from cockpit_server.sources.teleop import said
from tutorial_testing.seat_room import page, serialised


def test_numbers_in_messages():
    fields = fields_of("nav_msgs/Odometry")
    assert fields[0] == "pose/pose/position/x"  # what is seldom drawn comes last
    assert {"header/stamp", "pose/covariance[0]"} < set(fields)
    assert not {"pose/covariance[12]", "header/frame_id"} & set(fields)
    assert "axes[0]" in fields_of("sensor_msgs/Joy")
    assert "transforms[0]/transform/rotation/w" in fields_of("tf2_msgs/TFMessage")
    assert fields_of("no_such/Type") == fields_of("std_msgs/String") == ()


@pytest.mark.parametrize(
    ("field", "value"),
    [("axes[1]", 0.25), ("header/stamp", 3.0), ("header/seq", 7.0), ("axes[2]", None),
     ("axes", None), ("nothing", None), ("serialize", None), ("header/frame_id", None)],
)  # fmt: skip
def test_a_number_by_its_name(field, value):
    joy = Joy(axes=[0.5, 0.25])
    joy.header.stamp.secs, joy.header.seq = 3, 7
    assert value_at(joy, parts_of(field)) == value


@pytest.mark.parametrize(
    "field", ["", "a b", "a//b", "a[-1]", "a[1", "a.b", "/".join("a" * 9), "__class__"]
)
def test_a_malformed_field_is_refused(field):
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
    assert motion(read(Odometry, serialised(odometry))) == (1.0, -2.0, pi, 0.5, -0.25)
    assert read(Odometry, serialised(odometry)[:200]) is None


@pytest.mark.parametrize(
    ("x", "yaw", "way"),
    [(1.1, 0.5, 7.1), (1.1, 0.0, 7.1), (1.6, 0.5, 7.0), (0.0, 0.0, 0.0), (nan, 0.5, 7.0)],
    ids=["drives", "drives straight", "was carried", "was reset", "is nowhere"],
)
def test_the_way_covered(x, yaw, way):
    last = Motion(1.0 if x else 0.2, 0.0, yaw, 0.5, 0.0)
    assert covered(last, Motion(x, 0.0, yaw, 0.5, 0.0), 7.0) == pytest.approx(way)


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


def test_a_page_that_looks_back_at_a_node_is_sent_it_again():
    view = GraphView(SimpleNamespace(graph=GRAPH, version=1))
    client, sent = page(graph=False)
    for client.watch.node in ("/sim", "/sim", None, "/sim"):
        view.give(client, 0.0)
    assert [message["name"] for message in sent] == ["/sim", "/sim"]


def test_a_node_and_its_neighbours():
    about = GRAPH.about_node("/sim")
    assert about["speaks_to"] == ["/rviz"]
    assert (about["publishes"], about["services"]) == (["/odom"], ["/sim/reset"])
    assert {"from": "topic /odom", "to": "node /rviz"} in GRAPH.parts()["edges"]


def test_the_cockpit_is_a_part_of_the_graph_where_it_drives():
    column = [["/rosout", ["/cockpit", "/joy_node"]], ["/robot/joy", ["/cockpit"]]]
    assert without("/cockpit", column) == {"/rosout": {"/joy_node"}}
    assert without("/cockpit", column, shown_in={"/robot/joy"})["/robot/joy"] == {"/cockpit"}


def test_a_reset_is_of_one_robot():
    assert reset_service(GRAPH, "") == "/sim/reset"
    assert reset_service(GRAPH, "robot_2") == "/robot_2/reset"
    with pytest.raises(RefusedError, match="robot_1 has no service"):
        reset_service(GRAPH, "robot_1")  # the node's own would reset both


def test_reports_of_joy2twist():
    stopped = "stopped: not armed, release the sticks"
    statuses = [
        DiagnosticStatus(name=name, message=words, level=1, values=values)
        for name, words, values in (
            ("myjoystick2twist: joystick", "driving", []),
            ("robot_1/joy2twist: joystick", stopped, [KeyValue("Dead-man button", "4")]),
            ("robot_2/joy2twist: joystick", "armed", [KeyValue("Dead-man button", "none")]),
            ("fake_turtlebot: simulation", "running", []),
        )
    ]
    told = dict(said(serialised(DiagnosticArray(status=statuses))))
    assert told == {
        "": {"state": "driving", "why": "driving", "level": 1, "deadman": None},
        "robot_1": {"state": "stopped", "why": stopped, "level": 1, "deadman": "4"},
        "robot_2": {"state": "armed", "why": "armed", "level": 1, "deadman": "none"},
    }
    assert said(b"bytes that are none: joystick") == []


@pytest.mark.parametrize(
    ("line", "level", "subject", "text"),
    [
        ("ok       master    it answers\n", "ok", "master", "it answers"),
        ("wrong    topics    nobody", "wrong", "topics", "nobody"),
        ("unknown  joystick  none", "note", "joystick", "none"),
        ("doctor: 1 ok, 0 wrong\n", "note", "", "doctor: 1 ok, 0 wrong"),
    ],
)
def test_lines_of_the_doctor(line, level, subject, text):
    assert shown(line) == {"level": level, "subject": subject, "text": text}


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


def test_a_flood_is_dropped_and_then_closed_and_refusals_are_bounded():
    one, sent = page()
    taken = sum(one.allows(100.0) for _ in range(LONGEST_FLOOD))
    assert taken < 300 and sent == []
    for _ in range(taken + 1):
        one.allows(100.0)
    assert sent == ["closed"]
    for _ in range(1000):
        one.refuse("drive", "no", 100.0)
    assert 1 < len(sent) <= 11
