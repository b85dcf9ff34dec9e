"""C9 and C10 look again, and talker and listener do not come as far as they did before."""

import contextlib
from types import SimpleNamespace

import pytest

from tutorial_check.exercises import chatter
from tutorial_check.exercises.talking import PACKAGE
from tutorial_check.model import Wrong
from tutorial_check.python_facts import read_python

TALKER = """#!/usr/bin/env python3
rospy.init_node('talker', anonymous={})
"""


class Stage:
    """One on which programs are as said, and nobody has ended the master."""

    master_lives = True

    def __init__(self, heard, ended):
        self._heard, self._ended = heard, ended

    def start(self, _, script):
        """A program that has ended, or does nothing."""
        process = SimpleNamespace(returncode=0)
        state = {"ended": script in self._ended, "was_stopped": False, "spins": False}
        return SimpleNamespace(name=script, output="", process=process, **state)

    def call(self, method, *_):
        """Of the driver."""
        said = {"state": ({}, {}), "types": {}, "warnings": [], "heard": self._heard}
        return said.get(method, 0)

    def wait(self, condition, *_):
        """See Box.wait."""
        return condition()

    wait_for_start = wait


@pytest.fixture
def session(make_session):
    """A session with a talker and a listener."""
    session = make_session(PACKAGE, "3")
    for name in ("talker.py", "listener.py"):
        (session.package(PACKAGE).folder / name).write_text(TALKER.format(True))
    return session


@pytest.mark.parametrize("check", [chatter.anonymous, chatter.ctrl_c])
@pytest.mark.parametrize(
    ("heard", "ended", "seen"),
    [
        ([], ["talker.py"], "ended at once"),
        ([], [], "not one message"),
        ([(0.0, "/talker", "hello")], ["listener.py"], "ended at once"),
    ],
)
def test_why_no_second_talker_was_seen(session, check, heard, ended, seen):
    session.stage = lambda: contextlib.nullcontext(Stage(heard, ended))
    with pytest.raises(Wrong, match=seen):
        check(session)


def test_a_changed_talker_that_is_not_heard(session):
    session.stage = lambda: contextlib.nullcontext(Stage([], []))
    session.run = lambda key, make: SimpleNamespace(taken={"": 0}, both=True, first_ended=False)
    with pytest.raises(Wrong, match="the other way round"):
        chatter.anonymous(session)


@pytest.mark.parametrize("check", [chatter.talker, chatter.listener])
def test_a_line_of_main_within_the_function(session, check):
    name = check.__name__
    text = f"def {name}():\n    rospy.spin()\n    if __name__ == '__main__':\n        {name}()\n"
    (session.package(PACKAGE).folder / f"{name}.py").write_text(text)
    session.stage = lambda: contextlib.nullcontext(Stage([], [f"{name}.py"]))
    with pytest.raises(Wrong) as caught:
        check(session)
    assert caught.value.where == f"{name}.py:3"
    assert f"within {name}()" in caught.value.hint


SUBSCRIBER = 'Subscriber("chatter", String, callback)\n'
CALLBACK = "def callback(data):\n    loginfo(data)\n"


@pytest.mark.parametrize(
    ("text", "shown", "seen"),
    [
        (CALLBACK + SUBSCRIBER, 1, None),
        (CALLBACK + "    print(data)\n" + SUBSCRIBER, 2, ("displayed 2 times", "listener.py:3")),
        (CALLBACK + 2 * SUBSCRIBER, 2, ("displayed 2 times", "listener.py:4")),
    ],
)
def test_a_text_that_is_displayed_twice(text, shown, seen):
    output = shown * "I heard A\nI heard B\n" + "I heard A\n"
    talk = SimpleNamespace(strings=["A", "B"], listener=SimpleNamespace(output=output))
    note = chatter._repeated(talk, read_python(text), "listener.py")
    assert (note and (note.seen[-17:], note.where)) == seen


@pytest.mark.parametrize(("text", "sure"), [("'chater', String", True), ("topic, String", False)])
def test_what_text_and_graph_agree_on_is_sure(session, text, sure):
    """Whatever comes late on a busy machine, it would not come on another topic."""
    line = f"\npub = rospy.Publisher({text})\n"
    (session.package(PACKAGE).folder / "talker.py").write_text(TALKER.format(True) + line)
    program = SimpleNamespace(output="", spins=False)
    seen = {"publishers": {"/chater": ["/talker"]}, "types": {}, "warnings": [], "heard": []}
    talk = SimpleNamespace(
        talkers=[program], talker_ended=False, master_alive=True, both=False, **seen
    )
    session.run = lambda key, make: talk
    with pytest.raises(Wrong, match="it publishes on /chater") as caught:
        chatter.talker(session)
    assert caught.value.sure == sure
