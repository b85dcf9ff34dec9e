"""Questions to the master and to the doctor, and bad answers."""

import pytest

from cockpit_server import graph_watch
from cockpit_server.graph import ODOMETRY
from cockpit_server.sources import doctor
from node_kit.questions import Answer
from tutorial_testing.seat_room import page
from tutorial_testing.waiting import wait_for

WELL = {
    "getSystemState": (Answer.WELL, [[["/odom", ["/sim"]]], [], []]), "getPid": (Answer.WELL, 7),
    "getTopicTypes": (Answer.WELL, [["/odom", ODOMETRY]]),
    "lookupNode": (Answer.WELL, "http://here:1/"),
}  # fmt: skip


@pytest.fixture
def master(monkeypatch):
    """Answers by the name of the question; a test may change them."""
    answers = dict(WELL)
    monkeypatch.setattr(graph_watch, "call", lambda _uri, name, *_, **__: answers[name])
    return answers


@pytest.mark.parametrize("question", ["getSystemState", "getPid", "getTopicTypes"])
def test_a_master_that_is_silent_is_asked_again(master, question):
    master[question] = silent = (Answer.SILENT, None)
    watch = graph_watch.GraphWatch("/cockpit")
    for answer in (WELL[question], silent, WELL[question]):
        master[question] = answer
        watch.look()
        assert watch.graph.robots() == {""} and not watch._is_lost


@pytest.mark.parametrize(
    ("question", "answer"),
    [
        *[(question, (Answer.REFUSED, None)) for question in ("getSystemState", "getPid")],
        *[(question, (Answer.STRANGE, None)) for question in ("getSystemState", "getPid")],
        ("getPid", (Answer.WELL, 8)),  # another master
    ],
)
def test_a_master_that_has_gone_is_noticed(master, question, answer):
    watch = graph_watch.GraphWatch("/cockpit")
    master[question] = answer
    watch.look()
    assert watch._is_lost


def test_a_doctor_that_cannot_run_is_reported_and_may_run_again(monkeypatch):
    one, (client, sent) = doctor.Doctor(), page()

    def has_ended():
        one.give(client, 0.0)
        return sent and not sent[-1]["running"]

    monkeypatch.setattr(doctor.rospkg, "RosPack", [].pop)
    for _ in range(2):
        one.on_doctor(client, 0.0)
        wait_for(has_ended, "end of the doctor")
        lines = sent[-1]["lines"]
        assert [(line["level"], line["subject"]) for line in lines] == [("wrong", "doctor")]
        sent.clear()
    viewer, sent = page(role="viewer")
    client, found = viewer, one._version
    one.on_doctor(viewer, one._ended_at + 1.0)  # it gets what is known
    assert one._version == found and has_ended()
    one.on_doctor(viewer, one._ended_at + doctor.FRESH_S + 1.0)
    assert one._version > found
    wait_for(has_ended, "end of the doctor")
