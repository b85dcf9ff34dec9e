"""What the doctor reads from bytes and answers, without a running ROS."""

import os

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

from node_kit.rules.answer import Answer
from tutorial_testing.claims import claim
from tutorial_testing.nodes import serialised
from tutorial_testing.processes import REPOSITORY
from tutorial_tools.doctor.facts import Joystick, Mux, Offset, Transform
from tutorial_tools.hidden_stand_ins import hidden_stand_ins
from tutorial_tools.ros.doctor import collect
from tutorial_tools.ros.doctor.messages import nearest, offset, statuses, transforms_in

ARRIVED_S = 1_700_000_000.0


def wire(message):
    return ARRIVED_S, serialised(message)


def stamped(late_s):
    """Return a message as it arrives, with a stamp this many seconds old."""
    joints = JointState(name=["wheel"])
    nanoseconds = round((ARRIVED_S - late_s) * 1e9)
    joints.header.stamp.secs, joints.header.stamp.nsecs = divmod(nanoseconds, 10**9)
    return wire(joints)


@claim("Clocks are compared by the fastest message")
def test_the_fastest_message_shows_the_offset_of_a_clock():
    seconds, topic = offset("/joint_states", [stamped(late) for late in (0.3, 0.01, 0.2)])
    assert (seconds, topic) == (pytest.approx(-0.01, abs=1e-6), "/joint_states")
    assert offset("/a", [(ARRIVED_S, b"short")]) is None
    near, old = Offset(-0.01, "/odom"), Offset(-1e8, "/joy")  # the latter from a recording
    assert nearest([old, None, near]) == near


def test_a_fifo_is_not_opened_in_vain(tmp_path, monkeypatch):
    fifo = tmp_path / "js1"
    os.mkfifo(fifo)  # opening it would block
    monkeypatch.setattr(os, "open", lambda *_: pytest.fail("it was opened"))
    assert collect.joystick(str(fifo)) == Joystick(str(fifo))


def test_what_is_malformed_is_left_out(monkeypatch):
    assert statuses([wire(DiagnosticArray()), (ARRIVED_S, b"nonsense")]) == []
    monkeypatch.setattr(collect, "parameter", lambda *_: [7])  # a mux of another kind
    assert collect.mux("", "/mux", [(ARRIVED_S, b"\x09")]) == Mux(None, [])


@pytest.mark.parametrize("uri", ["moon", "https://localhost:1"])
def test_a_malformed_uri_of_a_master(monkeypatch, uri):
    monkeypatch.setenv("ROS_MASTER_URI", uri)
    assert collect.collect().master is Answer.MALFORMED


def test_of_each_frame_the_fastest_message_counts():
    sent = []
    for child, stamp_s in (("/base", -3), ("/base", -1), ("wheel", -7)):
        link = TransformStamped(child_frame_id=child)
        link.header.frame_id, link.header.stamp.secs = "odom", int(ARRIVED_S) + stamp_s
        sent.append(wire(TFMessage([link])))
    sent.append((ARRIVED_S, b"nonsense"))
    base, wheel = ("/n", "odom", "base"), ("/n", "odom", "wheel")
    moving = transforms_in({("/n", "/tf"): sent, ("/n", "/odom"): sent})
    assert moving == [Transform(*base, 1.0), Transform(*wheel, 7.0)]
    assert transforms_in({("/n", "/tf_static"): sent}) == [Transform(*base), Transform(*wheel)]


SUITE = REPOSITORY


def package(folder, launch=""):
    """Make a package with a launch file, like rbx1_bringup."""
    (folder / "launch").mkdir(parents=True)
    (folder / "package.xml").write_text("<package><name>any</name></package>")
    (folder / "launch" / "fake_turtlebot.launch").write_text(f"<launch>{launch}</launch>")


@claim("A package that hides a stand-in and lacks another one is named")
def test_only_what_lacks_a_package_is_reported(tmp_path):
    src, share = tmp_path / "src", tmp_path / "share"
    package(share / "rviz")
    package(src / "clone" / "description")
    package(src / "kobuki_msgs")  # whole
    package(src / "joy2twist", '<node pkg="nowhere"/>')  # no stand-in
    assert hidden_stand_ins(tmp_path, SUITE, share) == []
    needs = """<!-- $(find commented_out) --> <param command="$(find xacro)/x $(find description)"/>
        <node pkg="arbotix_python"/><node pkg='rviz'/><node pkg="fake_turtlebot_sim"/>"""
    folder = src / "clone" / "rbx1_bringup"
    package(folder, needs)
    ((seen, todo),) = hidden_stand_ins(tmp_path, SUITE, share)
    assert seen.startswith(f"{folder} hides the suite's own rbx1_bringup")
    assert seen.endswith("needs arbotix_python, xacro, which is not installed")
    assert todo == f"touch {folder}/CATKIN_IGNORE"
    (folder / "CATKIN_IGNORE").touch()
    assert hidden_stand_ins(tmp_path, SUITE, share) == []
