"""Which processes on this machine are nodes, and which of these a master does not know."""

import os

import pytest

from node_kit.rules.answer import Answer
from tutorial_testing.claims import claim
from tutorial_tools.doctor.facts import Stray
from tutorial_tools.ros.doctor import processes
from tutorial_tools.ros.doctor.processes import Running

NODES = {  # {port: {method: answer}}
    5001: {"getPublications": [["/chatter", "std_msgs/String"]], "getName": "/talker",
           "getMasterUri": "http://localhost:11311/", "getPid": 71},
    5002: {"getPublications": [["/x", "a/B"], ["/rosout", "rosgraph_msgs/Log"]], "getPid": 72},
    5003: {"getPid": 73},  # a master
}  # fmt: skip
MASTER, OTHER = "http://localhost:11311", "http://localhost:11399"


def ask(uri, method, *arguments):
    if uri == MASTER:
        known = method == "lookupNode" and arguments == ("/known",)
        return (Answer.WELL, "http://host:5009/") if known else (Answer.STRANGE, None)
    answers = NODES.get(int(uri.strip("/").rsplit(":", 1)[1]), {})
    return (Answer.WELL, answers[method]) if method in answers else (Answer.STRANGE, None)


@pytest.fixture
def proc(tmp_path, monkeypatch):
    """proc(pid, ports, ...): add a process to a folder like /proc."""
    logs = tmp_path / "log"
    monkeypatch.setattr(processes, "PROC", tmp_path)
    monkeypatch.setattr(processes, "call", ask)
    monkeypatch.setattr(processes, "header", lambda uri, topic: {"callerid": f"/of{topic}"})
    monkeypatch.setattr(processes.rospkg, "get_log_dir", lambda: str(logs))
    lines = ["  sl  local_address rem_address   st"]
    (tmp_path / "net").mkdir()

    def process(pid, ports, log="", maps="", environ=""):
        folder = tmp_path / str(pid)
        (folder / "fd").mkdir(parents=True)
        for number, port in enumerate(ports, 3):
            lines.append(f"0: 0100007F:{port:04X} 0:0 0A 0:0 0:0 0 0 0 {pid}{number} 1")
            os.symlink(f"socket:[{pid}{number}]", folder / "fd" / str(number))
        if log:
            os.symlink(logs / log, folder / "fd" / "20")
        (folder / "maps").write_text(maps)
        (folder / "environ").write_text(environ)
        (folder / "cmdline").write_text("program\0")
        (tmp_path / "net/tcp").write_text("\n".join(lines))

    return process


@claim("Only nodes are asked whether they are nodes")
def test_nodes_are_found_by_the_log_of_rospy_or_by_roscpp_and_no_other_program_is_asked(proc):
    proc(71, [5000, 5001], log="talker-1.log")
    proc(72, [5002], maps="/usr/lib/libroscpp.so.4", environ=f"A=b\0ROS_MASTER_URI={OTHER}\0")
    proc(73, [5003], log="master.log")
    proc(74, [5001])  # neither a log nor roscpp, so it is not asked
    proc(75, [], log="roslaunch.log")
    assert processes.running() == [
        Running("http://127.0.0.1:5001/", "/talker", 71, f"{MASTER}/"),
        Running("http://127.0.0.1:5002/", "/of/rosout", 72, OTHER),
    ]


def test_a_node_that_the_master_knows_or_that_has_ended_is_no_stray(proc):
    nodes = [
        Running("http://127.0.0.1:5001/", "/talker", 71, "http://127.0.0.1:11311/"),
        Running("http://127.0.0.1:5002/", "/cpp", 72, f"{OTHER}/"),
        Running("http://127.0.0.1:5002/", "/rosout", 72, MASTER),
        Running("http://127.0.0.1:5007/", "/ended", 77, MASTER),
        Running("http://127.0.0.1:5009/", "/known", 79, MASTER),
    ]
    assert processes.strays(nodes, MASTER, set()) == [
        Stray("/talker", 71),
        Stray("/cpp", 72, OTHER),
    ]
    assert processes.strays(nodes, MASTER, {"http://a:5001/", "http://a:5002/"}) == []
