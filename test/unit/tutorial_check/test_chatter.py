"""What is said of talker and listener from recorded facts, where no program shows it reliably."""

from types import SimpleNamespace

import pytest

from tutorial_check.exercises import chatter
from tutorial_check.exercises.talking import PACKAGE
from tutorial_check.model import Wrong

LISTENER = """from std_msgs.msg import String
def callback(data):
    loginfo(data)
rospy.Subscriber('chatter', String, callback)
"""
TALKER = "#!/usr/bin/env python3\nfrom std_msgs.msg import String\nrospy.init_node('talker')\n"
TORRENT = {"heard": [(k / 1e4, "", "") for k in range(9)]}


@pytest.fixture
def asked(make_session):
    """asked(check, text, **recorded): what a check says of a program of that text, or raises."""
    session = make_session(PACKAGE, "3")

    def ask(check, text, output="", ended=False, **recorded):
        for name in ("talker.py", "listener.py"):
            (session.package(PACKAGE).folder / name).write_text(text)
        program = SimpleNamespace(
            name="x.py", output=output, process=SimpleNamespace(returncode=0), spins=False,
            was_stopped=False, ended=ended,
        )  # fmt: skip
        about = {
            "talkers": [program], "listener": program, "talker_ended": ended, "heard": [],
            "listener_ended": ended, "master_alive": True, "publishers": {}, "published": {},
            "types": {}, "subscribers": {"/chatter": 1}, "warnings": [], "strings": ["A", "B"],
            "taken": {},
        }  # fmt: skip
        session.run = lambda key, make: SimpleNamespace(**{**about, **recorded})
        return check(session)

    return ask


@pytest.mark.parametrize(("check", "text", "recorded", "seen"), [
    (chatter.talker, TALKER, {"master_alive": False}, "has ended it"),
    (chatter.talker, TALKER + "while True: pass", TORRENT, "thousands of messages"),
    (chatter.listener, LISTENER, {"output": "A"}, "1 of 2 displayed"),
    (chatter.graph, "", {}, "no such way in the graph"),
    # C9 and C10 look again, and talker and listener do not come as far as they did before.
    (chatter.anonymous, TALKER, {}, "not one message"),
    (chatter.ctrl_c, TALKER, {"ended": True}, "it ended, exit code"),
])  # fmt: skip
def test_recorded_facts_have_a_diagnosis(asked, check, text, recorded, seen):
    with pytest.raises(Wrong) as caught:
        asked(check, text, **recorded)
    assert seen in caught.value.seen


def test_a_text_that_is_displayed_twice_is_right(asked):
    assert asked(chatter.listener, LISTENER, output="I heard A\nI heard B\nI heard A\n") is None
