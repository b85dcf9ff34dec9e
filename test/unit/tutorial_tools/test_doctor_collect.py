"""What the doctor reads from bytes and answers; no ROS runs here."""

import errno
import io
import os
import sys
from pathlib import Path

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

from node_kit.questions import Answer
from tutorial_tools.doctor import collect, environment
from tutorial_tools.doctor.facts import Joystick, MuxInput, Offset, Transform
from tutorial_tools.doctor.transforms import of_messages
from tutorial_tools.hidden import hidden_stand_ins

ARRIVED_S = 1_700_000_000.0


def wire(message):
    data = io.BytesIO()
    message.serialize(data)
    return ARRIVED_S, data.getvalue()


def stamped(late_s):
    """A message as it arrives, its stamp so many seconds before."""
    joints = JointState(name=["wheel"])
    nanoseconds = round((ARRIVED_S - late_s) * 1e9)
    joints.header.stamp.secs, joints.header.stamp.nsecs = divmod(nanoseconds, 10**9)
    return wire(joints)


def test_the_fastest_message_shows_the_offset_of_a_clock():
    seconds, topic = collect.offset("/joint_states", [stamped(late) for late in (0.3, 0.01, 0.2)])
    assert (seconds, topic) == (pytest.approx(-0.01, abs=1e-6), "/joint_states")
    assert collect.offset("/a", [(ARRIVED_S, b"short")]) is None
    near, old = Offset(-0.01, "/odom"), Offset(-1e8, "/joy")  # the latter of a recording
    assert collect.nearest([old, None, near]) == near


TELEOP = {"name": "teleop", "topic": "input/teleop", "priority": 7, "timeout": 1.0}


@pytest.mark.parametrize(
    ("given", "inputs"),
    [
        ([TELEOP], [MuxInput("teleop", "/mux/input/teleop", 7)]),
        *((given, []) for given in (None, [7], [{}])),  # a mux of another kind
    ],
)
def test_a_mux_and_its_inputs(monkeypatch, given, inputs):
    monkeypatch.setattr(collect, "parameter", lambda *_: given)
    assert collect.mux("", "/mux", [wire(String("teleop"))]) == ("teleop", inputs)
    assert collect.mux("", "/mux", [(ARRIVED_S, b"\x09")]).active is None


def test_the_statuses_of_a_node_as_far_as_they_are_whole():
    whole = DiagnosticArray(status=[DiagnosticStatus(name="a")])
    (status,) = collect.statuses([wire(whole), (ARRIVED_S, b"nonsense")])
    assert status.name == "a"


def test_devices_are_not_opened_in_vain(tmp_path, monkeypatch):
    path, fifo = tmp_path / "js0", tmp_path / "js1"
    assert collect.joystick(str(path)) == Joystick(str(path), errno.ENOENT)
    path.touch()
    assert collect.joystick(str(path)) == Joystick(str(path))
    os.mkfifo(fifo)  # which keeps its reader
    monkeypatch.setattr(os, "open", lambda *_: pytest.fail("it was opened"))
    assert collect.joystick(str(fifo)) == Joystick(str(fifo))


@pytest.mark.parametrize("uri", ["", "moon", "localhost:1", "https://localhost:1", "http://a:b"])
def test_a_malformed_uri_of_a_master(monkeypatch, uri):
    monkeypatch.setenv("ROS_MASTER_URI", uri)
    assert collect.collect().master is Answer.MALFORMED


def test_of_each_frame_the_fastest_message_counts():
    sent = []
    for child, stamp_s in (("/base", -3), ("/base", -1), ("wheel", -7)):
        one = TransformStamped(child_frame_id=child)
        one.header.frame_id, one.header.stamp.secs = "odom", int(ARRIVED_S) + stamp_s
        sent.append(wire(TFMessage([one])))
    sent.append((ARRIVED_S, b"nonsense"))
    base, wheel = ("/n", "odom", "base"), ("/n", "odom", "wheel")
    moving = of_messages({("/n", "/tf"): sent, ("/n", "/odom"): sent})
    assert moving == [Transform(*base, 1.0), Transform(*wheel, 7.0)]
    assert of_messages({("/n", "/tf_static"): sent}) == [Transform(*base), Transform(*wheel)]


@pytest.fixture
def conda(tmp_path, monkeypatch):
    """A Python before the system's, which finds nothing of Debian's (-S)."""
    for name in ("AMENT_PREFIX_PATH", environment.PATH):
        monkeypatch.delenv(name, raising=False)
    path = tmp_path / "conda/bin/python3"
    path.parent.mkdir(parents=True)
    path.write_text('#!/bin/sh\nexec /usr/bin/python3 -S -I "$@"')
    path.chmod(0o755)
    return path


def complaints(workspace=""):
    return [": ".join(one) for one in environment.environment(str(workspace))]


def test_the_pythons_of_a_terminal(conda, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", f"{environment.SYSTEMS[:-8]}:{conda.parent}")
    assert complaints() == []
    monkeypatch.setenv(environment.PATH, f"{conda.parent}:/usr/bin")
    (line,) = complaints()
    assert f"{conda}, which has no rospkg, catkin_pkg, em: conda deactivate; ROS 1" in line
    conda.write_text("#!/bin/sh\nexit 1")  # a shim without a Python behind it
    (tmp_path / "em.py").touch()
    monkeypatch.setenv("PYTHONPATH", str(tmp_path), prepend=":")
    (line,) = complaints()
    assert f"takes em from {tmp_path}/em.py, which is not empy 3" in line


def test_ros2_in_the_same_terminal(conda, monkeypatch):
    monkeypatch.setenv("AMENT_PREFIX_PATH", "/opt/ros/jazzy")
    assert conda and "AMENT_PREFIX_PATH=/opt/ros/jazzy): open a terminal" in complaints()[-1]
    monkeypatch.setattr(sys, "path", ["/opt/ros/jazzy/lib/python3.12/site-packages", "/usr/lib"])
    environment.leave_ros2()
    assert sys.path == ["/usr/lib"]


@pytest.mark.usefixtures("conda")
def test_how_a_workspace_was_built(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", "/usr/bin")
    script, build = tmp_path / "src/mine/scripts/a.py", tmp_path / "build"
    for folder in (script.parent, build):
        folder.mkdir(parents=True)
    cache, by = build / "CMakeCache.txt", build / ".built_by"
    by.write_text("catkin_make")
    cache.write_text(f"A:B=c\nCMAKE_HOME_DIRECTORY:INTERNAL={tmp_path}/src\n")
    (tmp_path / "src/mine/package.xml").write_text("<package/>")
    script.write_bytes(b"#!/usr/bin/env python3\n")
    assert complaints(tmp_path) == []
    rebuild = f": cd {tmp_path}; rm -r build devel; catkin_make"
    cache.write_text("CMAKE_HOME_DIRECTORY:INTERNAL=/old/src\n")
    assert complaints(tmp_path) == [f"{build} was made for /old/src{rebuild}"]
    by.write_text("catkin build\n")
    script.write_bytes(b"#!/usr/bin/env python3\r\n")
    first, second = complaints(tmp_path)
    assert first == f"{build} was made by catkin build, not by catkin_make{rebuild}"
    assert second == rf"{script} has the line ends of Windows: sed -i 's/\r$//' {script}"


SUITE = Path(__file__).resolve().parents[3]


def package(folder, launch=""):
    """Make a package with a launch file as rbx1_bringup has it."""
    (folder / "launch").mkdir(parents=True)
    (folder / "package.xml").write_text("<package><name>any</name></package>")
    (folder / "launch" / "fake_turtlebot.launch").write_text(f"<launch>{launch}</launch>")


def test_only_what_lacks_a_package_is_reported(tmp_path):
    src, share = tmp_path / "src", tmp_path / "share"
    package(share / "rviz")
    package(src / "clone" / "description")
    package(src / "kobuki_msgs")  # whole
    package(src / "joy2twist", '<node pkg="nowhere"/>')  # no stand-in
    assert hidden_stand_ins(tmp_path, SUITE, share) == []
    package(
        src / "clone" / "rbx1_bringup",
        """<!-- $(find commented_out) --> <param command="$(find xacro)/x $(find description)"/>
        <node pkg="arbotix_python"/><node pkg='rviz'/><node pkg="fake_turtlebot_sim"/>""",
    )
    folder = src / "clone" / "rbx1_bringup"
    assert hidden_stand_ins(tmp_path, SUITE, share) == [
        (
            f"{folder} hides the suite's own rbx1_bringup, and needs arbotix_python, xacro, "
            "which is not installed",
            f"touch {folder}/CATKIN_IGNORE",
        )
    ]
    (folder / "CATKIN_IGNORE").touch()
    assert hidden_stand_ins(tmp_path, SUITE, share) == []
