"""Diagnoses of talker and listener from recorded facts that no program produces reliably."""

from dataclasses import replace

import pytest

from courses.handout.talker_listener import checks as judge
from courses.handout.talker_listener.record import STRINGS, Talk
from courses.handout.task import BEGINNER
from tutorial_check.checking.results import Wrong
from tutorial_check.processes.started_program import Ran
from tutorial_testing.claims import claim

pytestmark = claim("What no program ...", because="talker and listener")
LISTENER = """from std_msgs.msg import String
def callback(data):
    loginfo(data)
rospy.Subscriber('chatter', String, callback)
"""
TALKER = "#!/usr/bin/env python3\nfrom std_msgs.msg import String\nrospy.init_node('talker')\n"
TORRENT = {"received": tuple((k / 1e4, "", "") for k in range(9))}
ENDED = {"talker": Ran("x.py", "", 0, False, False), "talker_ended": True, **TORRENT}
RIGHT = Talk(
    Ran("x.py", "", None, False, False), Ran("x.py", "", None, False, False),
    talker_ended=False, listener_ended=False, published={}, publishers={},
    subscribers={"/chatter": ("/listener",)}, types={}, warnings=(), received=(), master_alive=True,
)  # fmt: skip


@pytest.fixture
def asked(make_submission):
    """asked(check, text, **recorded): run a check on a program with this text; it may raise."""
    submission = make_submission(BEGINNER, "3")

    def ask(check, text, **recorded):
        for name in ("talker.py", "listener.py"):
            (submission.package(BEGINNER).folder / name).write_text(text)
        submission.recording = lambda recorder, *arguments: replace(RIGHT, **recorded)
        return check(submission)

    return ask


def printed(output):
    return Ran("x.py", output, None, False, False)


@pytest.mark.parametrize(("check", "text", "recorded", "seen"), [
    (judge.talker, TALKER, {"master_alive": False}, "has ended it"),
    (judge.talker, TALKER + "while True: pass", TORRENT, "thousands of messages"),
    (judge.listener, LISTENER, {"listener": printed(STRINGS[0])}, "1 of 5 displayed"),
    (judge.graph, "", {}, "no such connection in the graph"),
    # C9 and C10 run the programs again, which then do not get as far as before.
    (judge.anonymous, TALKER, {}, "not one message"),
    (judge.ctrl_c, TALKER, ENDED, "it ended, exit code"),
])  # fmt: skip
def test_recorded_facts_have_a_diagnosis(asked, check, text, recorded, seen):
    with pytest.raises(Wrong) as caught:
        asked(check, text, **recorded)
    assert seen in caught.value.seen


def test_a_text_that_is_displayed_twice_is_right(asked):
    output = "\n".join([*STRINGS, STRINGS[0]])
    assert asked(judge.listener, LISTENER, listener=printed(output)) is None
