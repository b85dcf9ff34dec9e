"""C29: which file has the class, and what of its form is right."""

import pytest

from tutorial_check.handout.s4_3.record import PACKAGE
from tutorial_check.handout.s6_2 import judge

CLASS = """#!/usr/bin/python3
import rospy


class NewJoy2Twist:
    def __init__(self):
        rospy.init_node('x')
        rospy.on_shutdown(self.shutdown)
        rospy.Subscriber('/joy', Joy, self.callback)

    def callback(self, data):
        pass

    def shutdown(self):
        pass


if __name__ == '__main__':
    NewJoy2Twist()
"""
NO_SHUTDOWN = CLASS.replace("        rospy.on_shutdown(self.shutdown)\n", "")


@pytest.fixture
def session(make_session):
    return make_session(PACKAGE, "6.2")


@pytest.fixture
def write(session):

    def made(path, text, mode=0o755):
        file = session.package(PACKAGE).folder / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        file.chmod(mode)

    return made


@pytest.mark.parametrize(
    ("other", "text", "mode"),
    [
        ("scripts/joy2twist.py", NO_SHUTDOWN, 0o755),
        ("old/new_joy2twist.py", CLASS, 0o644),
    ],
)
def test_of_several_classes_the_last_step_counts(session, write, other, text, mode):
    write(other, text, mode)
    write("scripts/new_joy2twist.py", CLASS)
    assert judge.program(session)[0] == "scripts/new_joy2twist.py"


@pytest.mark.parametrize(
    "text",
    [
        CLASS.replace("self.shutdown)", "self.robot.stop)"),
        CLASS.replace("self.shutdown)", "self.ended)\n        self.ended = print"),
        CLASS.replace("self.callback)", "partial(self.callback, 1))"),
        CLASS.replace("NewJoy2Twist:", "NewJoy2Twist(Base):").replace("def shutdown", "def other"),
    ],
)
def test_a_class_of_another_form_is_right(session, write, text):
    write("scripts/new_joy2twist.py", text)
    assert judge.is_class(session).startswith("NewJoy2Twist in")
