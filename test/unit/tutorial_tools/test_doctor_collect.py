"""What the doctor reads from bytes and answers; no ROS runs here."""

import errno
import io
import os

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

from gamepad.driver.report import SILENT_FOR
from tutorial_tools.doctor import collect
from tutorial_tools.doctor.facts import Answer, Joystick, MuxInput, Offset

ARRIVED_S = 1_700_000_000.0


def wire(message):
    data = io.BytesIO()
    message.serialize(data)
    return data.getvalue()


def stamped(message, header, seconds):
    """The message as it comes, its stamp so many seconds before its arrival."""
    nanoseconds = round((ARRIVED_S - seconds) * 1e9)
    header.stamp.secs, header.stamp.nsecs = divmod(nanoseconds, 10**9)
    return ARRIVED_S, wire(message)


def test_the_message_that_was_fastest_tells_the_offset_of_a_clock():
    joints = JointState(name=["wheel"])
    messages = [stamped(joints, joints.header, late) for late in (0.3, 0.01, 0.2)]
    assert collect.offsets(joints._type, messages) == [pytest.approx(-0.01, abs=1e-6)]
    assert collect.offsets(joints._type, [stamped(joints, joints.header, -3.5)]) == [3.5]


def test_a_transform_has_its_stamp_elsewhere():
    transforms = TFMessage([TransformStamped()])
    message = stamped(transforms, transforms.transforms[0].header, 2.0)
    assert collect.offsets(transforms._type, [message]) == [pytest.approx(-2.0)]
    assert collect.offsets(transforms._type, [(ARRIVED_S, wire(TFMessage()))]) == []


def test_a_recording_with_old_stamps_does_not_hide_a_good_clock():
    near, far = Offset(-0.01, "/odom"), Offset(-1e8, "/joy")
    assert collect.nearest([far, near]) == near
    assert collect.nearest([]) is None


def test_a_mux_and_its_inputs(monkeypatch):
    given = [{"name": "teleop", "topic": "input/teleop", "priority": 7, "timeout": 1.0}]
    monkeypatch.setattr(collect, "parameter", lambda *_: given)
    mux = collect.mux("", "/mux", [(ARRIVED_S, wire(String("teleop")))])
    assert (mux.active, mux.inputs) == ("teleop", [MuxInput("teleop", "/mux/input/teleop", 7)])


@pytest.mark.parametrize("given", [None, 7, [7], [{}], "text"])
def test_a_mux_of_another_kind(monkeypatch, given):
    monkeypatch.setattr(collect, "parameter", lambda *_: given)
    mux = collect.mux("", "/mux", [(ARRIVED_S, b"\x09")])
    assert (mux.active, mux.inputs) == (None, [])
    assert collect.mux("", "/mux", []).active is None


def test_the_state_is_that_of_the_node():
    array = DiagnosticArray(
        status=[
            DiagnosticStatus(name="ada/joy2twist: joystick", level=0, message="driving"),
            DiagnosticStatus(name="bob/joy2twist: joystick", level=1, message="waiting"),
        ]
    )
    messages = [(ARRIVED_S, wire(array))]
    assert list(collect.states("/ada/joy2twist", messages)) == [
        ("/ada/joy2twist", (True, "driving"))
    ]
    assert list(collect.states("/bob/joy2twist", messages)) == [
        ("/bob/joy2twist", (False, "waiting"))
    ]
    assert list(collect.states("/ada/joy2twist", [(ARRIVED_S, b"nonsense")])) == []


@pytest.mark.parametrize(("said", "silent"), [("12.3", [12.3]), ("not open", [])])
def test_how_long_a_gamepad_has_been_silent(said, silent):
    status = DiagnosticStatus(values=[KeyValue(SILENT_FOR, said), KeyValue("topic", "/joy")])
    assert list(collect.silences([(ARRIVED_S, wire(DiagnosticArray(status=[status])))])) == silent


def test_devices(tmp_path):
    path = tmp_path / "js0"
    assert collect.joystick(str(path)) == Joystick(str(path), errno.ENOENT)
    path.touch()
    assert collect.joystick(str(path)) == Joystick(str(path))


def test_a_fifo_keeps_its_reader(tmp_path, monkeypatch):
    path = tmp_path / "js0"
    os.mkfifo(path)
    monkeypatch.setattr(os, "open", lambda *_: pytest.fail("it was opened"))
    assert collect.joystick(str(path)) == Joystick(str(path))


@pytest.mark.parametrize(
    "uri", ["", "moon", "localhost:11311", "https://localhost:11311", "http://:1", "http://a:b"]
)
def test_a_malformed_uri(monkeypatch, uri):
    monkeypatch.setenv("ROS_MASTER_URI", uri)
    assert collect.collect().master is Answer.MALFORMED


@pytest.mark.filterwarnings("ignore::DeprecationWarning")  # of rosgraph's, which comments on it
def test_an_empty_variable_counts_as_none(monkeypatch, capsys):
    monkeypatch.delenv("ROS_HOSTNAME", raising=False)
    monkeypatch.setenv("ROS_IP", "")
    assert collect.this_machine()["own_variable"] == ""
    assert capsys.readouterr().err == ""


def test_both_variables(monkeypatch):
    monkeypatch.setenv("ROS_HOSTNAME", "127.0.0.1")
    monkeypatch.setenv("ROS_IP", "192.0.2.7")
    seen = collect.this_machine()
    assert (seen["own_variable"], seen["own_name"]) == ("ROS_HOSTNAME", "127.0.0.1")
    assert seen["own_is_here"]
