"""A node that another one is said to replace exits only if it has lost its name."""

from types import SimpleNamespace

import pytest
import rospy

from node_kit.ros.rospy_patches import shutdown
from node_kit.rules.answer import Answer

REASON = "[{}] Reason: new node registered with same name"
OWN, ANOTHER = "http://here:1", "http://here:2"
STATE = [["/cmd_vel", ["/robot"]], ["/rosout", ["/mux", "/robot"]]], [["/joy", ["/robot"]]], []


@pytest.fixture
def answers(monkeypatch):
    """The master's answers, to be changed; the node /robot has the topics of STATE."""
    given = {"lookupNode": (Answer.WELL, OWN), "getSystemState": (Answer.WELL, STATE)}
    topics = SimpleNamespace(
        get_publications=lambda: [["/cmd_vel", "Twist"], ["/rosout", "Log"]],
        get_subscriptions=lambda: [["/joy", "Joy"]],
    )
    monkeypatch.setattr(shutdown, "call", lambda _uri, method, *_: given[method])
    monkeypatch.setattr(shutdown, "_end", lambda _handler, *_: "ended")
    monkeypatch.setattr(rospy, "get_name", lambda: "/robot")
    monkeypatch.setattr(rospy, "get_node_uri", lambda: OWN)
    monkeypatch.setattr(rospy, "logwarn", lambda _line: None)
    monkeypatch.setattr(rospy.topics, "get_topic_manager", lambda: topics)
    return given


TOPIC_LOST = (Answer.WELL, (STATE[0], [["/joy", ["/other"]]], []))
SILENT = (Answer.SILENT, None)


@pytest.mark.parametrize(("about", "changed", "name", "reason", "ends"), [
    ("the master knows it as before", {}, "/robot", REASON, False),
    ("it is replaced", {"lookupNode": (Answer.WELL, ANOTHER)}, "/robot", REASON, True),
    ("the name came back, a topic did not", {"getSystemState": TOPIC_LOST}, "/robot", REASON, True),
    ("no answer", {"lookupNode": SILENT}, "/robot", REASON, True),
    ("taken for another: nothing is asked", {"lookupNode": SILENT, "getSystemState": SILENT},
     "/died", REASON, False),
    ("another reason", {}, "", "user request", True),
])  # fmt: skip
def test_a_node_ends_only_if_it_is_meant(answers, about, changed, name, reason, ends):
    answers.update(changed)
    ended = shutdown._end_if_meant(None, "/master", reason.format(name)) == "ended"
    assert ended is ends, about
