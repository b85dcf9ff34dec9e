"""C18: ten starts are made only where the text leaves the question open."""

import pytest

from tutorial_check.exercises import joy2twist
from tutorial_check.model import Note

SUBSCRIBER = "rospy.Subscriber('/joy', Joy, callback)"
PUBLISHER = "pub = rospy.Publisher('/cmd_vel', Twist)"


@pytest.fixture
def under_load(make_session, monkeypatch):
    """under_load(*lines): (what C18 says of this program, whether it was started)."""
    session, started = make_session(joy2twist.PACKAGE, "4.3"), []

    def judged(*lines, fails=False):
        (session.package(joy2twist.PACKAGE).folder / "joy2twist.py").write_text("\n".join(lines))
        monkeypatch.setattr(joy2twist, "_finds_no_pub", lambda *_: started.append(1) or fails)
        return joy2twist.under_load(session), bool(started)

    return judged


def test_the_subscriber_comes_first(under_load):
    note, was_started = under_load("import rospy", SUBSCRIBER, PUBLISHER)
    assert isinstance(note, Note) and note.where == "joy2twist.py:2"
    assert not was_started


@pytest.mark.parametrize("lines", [(PUBLISHER, SUBSCRIBER), (SUBSCRIBER,), (PUBLISHER,), ()])
def test_the_text_leaves_it_open(under_load, lines):
    assert under_load(*lines) == (None, True)


def test_it_is_seen_to_happen(under_load):
    note, _ = under_load(PUBLISHER, SUBSCRIBER, fails=True)
    assert isinstance(note, Note) and note.where == "joy2twist.py:2"
