"""The tools of own courses: a Client and its node, with an imitated rospy; launch files."""

import os
import re
import socket
import threading
from pathlib import Path
from types import SimpleNamespace

import pytest
from roslaunch.loader import Loader

from tutorial_check.checking.launch_file import launch_file
from tutorial_check.checking.results import Wrong
from tutorial_check.errors import CannotCheck, CutShort
from tutorial_check.recording import client_node
from tutorial_check.recording.client import Client, FrameTransform, Seen, ServiceAnswer
from tutorial_check.recording.launch_file_reader import facts_of
from tutorial_check.recording.launch_files import Launch
from tutorial_testing.claims import claim
from tutorial_testing.waiting import wait_for

ENDS = {}


class Rospy:
    """A publisher, subscriber or service; messages go to the first one of that name."""

    def __init__(self, name, kind, callback=None, argument=None, queue_size=0):
        self.name, self.data_class, self._callback = name, kind, callback
        self._more = [] if argument is None else [argument]
        ENDS.setdefault(name, self)

    def publish(self, message):
        message._connection_header = {"callerid": "/me"}
        ENDS[self.name]._callback(message, *ENDS[self.name]._more)

    def __call__(self, request):
        request._connection_header = {}
        return ENDS[self.name]._callback(request)

    def get_num_connections(self):
        return 1


@pytest.fixture
def ros(monkeypatch):
    """A RosSession whose Client has a thread as its node; `own`: a student's package."""
    ENDS.clear()
    for name in ("Publisher", "Subscriber", "Service", "ServiceProxy"):
        monkeypatch.setattr(client_node.rospy, name, Rospy)
    for name, value in (("wait_for_service", print), ("get_param", lambda *both: both)):
        monkeypatch.setattr(client_node.rospy, name, value)
    monkeypatch.setattr(client_node.rospy.Time, "now", lambda: client_node.rospy.Time(7, 0))
    monkeypatch.setattr(client_node.ClientNode, "services", lambda _: ["/there"])
    program = SimpleNamespace(ended=False, output="", rests=lambda: True)

    def start(command, environment, stdin):
        line = socket.socket(fileno=os.dup(stdin))

        def serve():
            for text in line.makefile():
                node.answer(text)

        node = client_node.ClientNode(line)

        threading.Thread(target=serve, daemon=True).start()
        return program

    def wait(condition, seconds=1.0, or_idle=False):
        return wait_for(condition, "an answer") if seconds else condition()

    own = SimpleNamespace(packages=[SimpleNamespace(name="own")])
    about = {"runner": SimpleNamespace(start=start), "environment": {}, "workspace": own}
    about["peer"], about["meet"] = SimpleNamespace(types=lambda: {"/t": "T"}), lambda _: True
    return SimpleNamespace(**about, wait=wait, wait_for_start=wait)


def test_messages_of_any_type_go_and_come(ros):
    client, values = Client(ros), {"header": {"stamp": "now", "frame_id": "f"}, "ranges": [1.5]}
    client.listen("/a", "sensor_msgs/LaserScan")
    client.advertise("/a", "sensor_msgs/LaserScan")
    assert client.meet(SimpleNamespace(ended=False, rests=lambda: True), "/a")
    at_s = client.send("/a", values)
    (came_s, node, got), *_ = client.heard("/a")
    assert (client.count("/a"), node, came_s <= at_s) == (1, "/me", True)
    assert (got["header"]["stamp"], got["ranges"]) == ({"secs": 7, "nsecs": 0}, [1.5])


def test_services_parameters_and_types(ros):
    client = Client(ros)
    client.serve("/there", "std_srvs/SetBool", {"success": True, "message": "m"})
    answer = client.ask("/there", "std_srvs/SetBool", {"data": True})
    assert answer == ServiceAnswer({"success": True, "message": "m"})
    seen = client.seen(SimpleNamespace(ran="p"), "/there", answers=[7])
    assert seen == Seen("p", {"/there": ({"data": True},)}, (7,), {"/t": "T"})
    assert client.parameter("/p") == ["/p", None]
    assert client.fields("std_srvs/Trigger") == ("---", "bool success", "string message")


@pytest.mark.parametrize("answers", [ServiceAnswer({}), [ServiceAnswer({})], {"first": 1}], ids=str)
def test_what_is_no_list_of_plain_values_is_refused(ros, answers):
    with pytest.raises(CannotCheck, match=r"test_recording.py:\d+: answers= takes a list"):
        Client(ros).seen(SimpleNamespace(ran="p"), answers=answers)


@claim("A student of a course ...", because="whose mistake a type is")
@pytest.mark.parametrize(("kind", "values", "why"), [
    ("own/None", {}, "there is no type own/None"),
    ("no_msgs/None", {}, r"test_recording.py:\d+: there is no type no_msgs/None"),
    ("std_srvs/SetBool", {"date": 1}, r"does not fit: No field name \[date\] \(fields: data\)"),
    ("std_srvs/SetBool", [1, 2], "Too many arguments"),
    ("std_srvs/SetBool", {"data": "text"}, "field data is not a bool"),
    ("std_srvs/SetBool", {"data": {1}}, r"test_recording.py:\d+: .* not JSON"),
])  # fmt: skip
def test_it_is_said_whose_mistake_a_type_is(ros, kind, values, why):
    whose = CutShort if kind.startswith("own") else CannotCheck
    with pytest.raises(whose) as error:
        Client(ros).ask("/there", kind, values)
    assert re.search(why, str(vars(error.value) or error.value)), error.value


@pytest.mark.parametrize(
    ("name", "why"),
    [("/x", "there is no service /x; there are: /there"), ("/there", "/there does not respond")],
)
def test_a_service_without_a_response(ros, monkeypatch, name, why):
    hangs = threading.Event()
    monkeypatch.setattr(client_node.ClientNode, "ask", lambda *_: hangs.wait())
    client = Client(ros)
    threading.Timer(0.2, hangs.set).start()
    assert client.ask(name, "std_srvs/Empty", seconds=0.0) == ServiceAnswer(None, why)


def test_a_transform(ros, monkeypatch):
    found = iter([None, [[1, 2, 0], [0, 0, 0, 1]]])
    monkeypatch.setattr(client_node.ClientNode, "lookup", lambda *_: next(found))
    assert Client(ros).lookup("a", "b") == FrameTransform((1, 2, 0), (0, 0, 0, 1))


LAUNCH = '<launch>\n  <node pkg="turtlesim" type="mimic" name="m"/>\n</launch>\n'


@pytest.mark.parametrize(("name", "text", "seen", "where"), [
    ("a.launch", LAUNCH, "", "launch/a.launch:2"),
    ("b.launch", LAUNCH, "a file p/launch/b.launch", "p/launch/b.launch"),
    ("a.launch", LAUNCH.replace("/>", ">"), "mismatched tag", "launch/a.launch:2"),
    ("a.launch", LAUNCH.replace("mimic", "mimick"), "Cannot locate", "launch/a.launch:2"),
    ("a.launch", LAUNCH.replace("turtlesim", "turtle"), "Cannot locate", "launch/a.launch:2"),
])  # fmt: skip
def test_a_launch_file_is_read(make_submission, monkeypatch, name, text, seen, where):
    # facts_of() changes it, normally in a separate process.
    monkeypatch.setattr("roslaunch.loader.Loader.param_value", Loader.param_value)
    submission = make_submission("p", "1")
    folder = submission.package("p").folder / "launch"
    folder.mkdir()
    (folder / name).write_text(text)
    source, submission.must_be_launchable = submission.source, list
    submission.recording = lambda _, path: SimpleNamespace(files=[facts_of(str(source / path))])
    try:
        file = launch_file(submission, "p", "a.launch")
        assert (file.nodes[0]["name"], file.at("mimic"), seen) == ("m", where, "")
    except Wrong as wrong:
        assert seen and wrong.seen.startswith(seen) and wrong.where == where, wrong


def test_what_a_launch_file_has_started():
    program = SimpleNamespace(output="[n/m-2] process has died [pid 1]\n", ended=False)
    peer = SimpleNamespace(state=lambda: ({"/rosout": ("/b", "/a")},))
    about = {"launch": lambda words: program, "peer": peer}
    about["workspace"] = SimpleNamespace(source=Path("src"))
    launch = Launch(SimpleNamespace(**about), "a.launch")
    assert launch.is_over and launch.died == ("n/m",) and launch.nodes == ("/a", "/b")


def test_a_launch_file_that_is_there_twice_is_wrong(make_submission):
    submission = make_submission("p", "1")
    for name in ("a", "b"):
        (submission.package("p").folder / name).mkdir()
        (submission.package("p").folder / name / "a.launch").write_text(LAUNCH)
    with pytest.raises(Wrong) as wrong:
        launch_file(submission, "p", "a.launch")
    assert wrong.value.seen == "several: a/a.launch, b/a.launch"
