"""Who is told to end because another node has its name: does it have its name still?"""

from types import SimpleNamespace

import pytest
import rospy

from node_kit import ending
from node_kit.questions import Answer

REASON = "[{}] Reason: new node registered with same name"
OWN, ANOTHER = "http://here:1", "http://here:2"
STATE = [["/cmd_vel", ["/robot"]], ["/rosout", ["/mux", "/robot"]]], [["/joy", ["/robot"]]], []


@pytest.fixture
def answers(monkeypatch):
    """What the master answers; the node /robot has the topics of STATE."""
    given = {"lookupNode": (Answer.WELL, OWN), "getSystemState": (Answer.WELL, STATE)}
    topics = SimpleNamespace(
        get_publications=lambda: [["/cmd_vel", "Twist"], ["/rosout", "Log"]],
        get_subscriptions=lambda: [["/joy", "Joy"]],
    )
    monkeypatch.setattr(ending, "call", lambda _uri, method, *_: given[method])
    monkeypatch.setattr(ending, "_end", lambda _handler, *_: "ended")
    monkeypatch.setattr(rospy, "get_name", lambda: "/robot")
    monkeypatch.setattr(rospy, "get_node_uri", lambda: OWN)
    monkeypatch.setattr(rospy, "logwarn", lambda _line: None)
    monkeypatch.setattr(rospy.topics, "get_topic_manager", lambda: topics)
    return given


def told(name="/robot", reason=REASON):
    return ending._end_if_meant(None, "/master", reason.format(name)) == "ended"


def test_whoever_is_not_replaced_stays(answers):
    assert not told()


def test_whoever_is_replaced_ends(answers):
    answers["lookupNode"] = (Answer.WELL, ANOTHER)
    assert told()


def test_who_lost_a_topic_to_one_of_its_name_ends_though_the_name_came_back(answers):
    answers["getSystemState"] = (Answer.WELL, (STATE[0], [["/joy", ["/other"]]], []))
    assert told()


@pytest.mark.parametrize("method", ["lookupNode", "getSystemState"])
def test_whose_master_does_not_answer_ends(answers, method):
    answers[method] = (Answer.SILENT, None)
    assert told()


def test_whoever_is_taken_for_another_stays_without_asking(answers):
    answers["lookupNode"] = answers["getSystemState"] = (Answer.SILENT, None)
    assert not told("/died")


@pytest.mark.parametrize("reason", ["user request", ""])
def test_any_other_reason_is_obeyed(answers, reason):
    assert told(reason=reason)
