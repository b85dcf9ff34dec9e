"""C18: ten starts are made only where the text leaves the question open."""

import pytest

from tutorial_check.exercises import joy2twist

SUBSCRIBER = "rospy.Subscriber('/joy', Joy, callback)"
PUBLISHER = "pub = rospy.Publisher('/cmd_vel', Twist)"


@pytest.mark.parametrize(
    ("lines", "fails", "where", "is_started"),
    [
        (("import rospy", SUBSCRIBER, PUBLISHER), False, "joy2twist.py:2", False),
        ((PUBLISHER, SUBSCRIBER), False, None, True),
        ((PUBLISHER, SUBSCRIBER), True, "joy2twist.py:2", True),
        ((), False, None, True),
    ],
)
def test_under_load(make_session, monkeypatch, lines, fails, where, is_started):
    session, started = make_session(joy2twist.PACKAGE, "4.3"), []
    (session.package(joy2twist.PACKAGE).folder / "joy2twist.py").write_text("\n".join(lines))
    monkeypatch.setattr(joy2twist, "_finds_no_pub", lambda *_: started.append(1) or fails)
    note = joy2twist.under_load(session)
    assert (note and note.where, bool(started)) == (where, is_started)
