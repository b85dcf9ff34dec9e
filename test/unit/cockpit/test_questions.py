"""Questions to the master and to the doctor that are not answered well."""

from types import SimpleNamespace

import pytest

from cockpit_server import doctor, graph_watch
from cockpit_server.graph import ODOMETRY
from node_kit.questions import Answer
from tutorial_testing.waiting import wait_for

STATE = [[["/odom", ["/sim"]]], [], []]
WELL = {
    "getSystemState": (Answer.WELL, STATE), "getPid": (Answer.WELL, 7),
    "getTopicTypes": (Answer.WELL, [["/odom", ODOMETRY]]),
    "lookupNode": (Answer.WELL, "http://here:1/"),
}  # fmt: skip
SILENT = (Answer.SILENT, None)


@pytest.fixture
def master(monkeypatch):
    """Answers by the name of the question; a test may change them."""
    answers = dict(WELL)
    monkeypatch.setattr(graph_watch, "call", lambda _uri, name, *_, **__: answers[name])
    return answers


@pytest.mark.parametrize("question", ["getSystemState", "getPid", "getTopicTypes"])
def test_a_master_that_is_silent_is_asked_again(master, question):
    watch = graph_watch.GraphWatch("/cockpit")
    master[question] = SILENT
    watch.look()
    assert watch.graph.robots() == {""} and not watch._is_lost
    master.update(WELL)
    watch.look()
    assert not watch._is_lost


@pytest.mark.parametrize("question", ["getSystemState", "getPid"])
def test_a_master_that_is_silent_at_first_is_known_later(master, question):
    master[question] = SILENT
    watch = graph_watch.GraphWatch("/cockpit")
    master.update(WELL)
    watch.look()
    assert watch.graph.robots() == {""} and not watch._is_lost
    master["getPid"] = (Answer.WELL, 8)
    watch.look()
    assert watch._is_lost


@pytest.mark.parametrize("wrong", [(Answer.REFUSED, None), (Answer.STRANGE, None)])
@pytest.mark.parametrize("question", ["getSystemState", "getPid"])
def test_a_master_that_is_gone_is_lost(master, question, wrong):
    watch = graph_watch.GraphWatch("/cockpit")
    master[question] = wrong
    watch.look()
    assert watch._is_lost


def test_a_doctor_that_cannot_run_says_so_and_may_be_called_again(monkeypatch):
    said = {}
    one = doctor.Doctor()
    client = SimpleNamespace(
        drives=True,
        seen={},
        lacks=lambda about, version: True,
        send=lambda kind, **fields: said.update(fields),
    )

    def has_ended():
        one.give(client, 0.0)
        return said and not said["running"]

    monkeypatch.setattr(doctor.rospkg, "RosPack", [].pop)
    for _ in range(2):
        one.on_doctor(client, 0.0)
        wait_for(has_ended, "end of the doctor")
        assert [(line["level"], line["subject"]) for line in said["lines"]] == [("wrong", "doctor")]
        said.clear()
    client.drives, found = False, one._version
    one.on_doctor(client, one._ended_at + 1.0)  # who only looks gets what is known
    assert one._version == found and has_ended()
    one.on_doctor(client, one._ended_at + doctor.FRESH_S + 1.0)
    assert one._version > found
    wait_for(has_ended, "end of the doctor")
