"""C29: which file has the class, and what its form tells without running it."""

import pytest

from tutorial_check.exercises import classes
from tutorial_check.exercises.driving import PACKAGE

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
ROBOT = """class Robot:
    def __init__(self):
        rospy.on_shutdown(self.stop)

    def stop(self):
        pass


"""


def write(folder, path, text, mode=0o755):
    file = folder / path
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text)
    file.chmod(mode)


@pytest.fixture
def session(make_session):
    return make_session(PACKAGE, "6.2")


@pytest.fixture
def folder(session):
    """That of the student's package."""
    return session.package(PACKAGE).folder


@pytest.mark.parametrize(
    ("other", "text", "mode"),
    [
        ("scripts/joy2twist.py", NO_SHUTDOWN, 0o755),
        ("old/new_joy2twist.py", CLASS, 0o644),
        ("scripts/class_joy2twist.py", CLASS, 0o644),
        (".history/scripts/joy2twist_2.py", CLASS, 0o755),
    ],
)
def test_the_class_of_several_that_is_the_last_step(folder, session, other, text, mode):
    write(folder, other, text, mode)
    write(folder, "scripts/new_joy2twist.py", CLASS)
    assert classes.program(session)[0] == "scripts/new_joy2twist.py"


@pytest.fixture
def form(folder, session, monkeypatch):
    """What C29 says of the form of a text."""
    monkeypatch.setattr(classes, "check_file", lambda *_: None)
    monkeypatch.setattr(classes, "check_manifest", lambda *_: None)

    def check(text):
        write(folder, "scripts/new_joy2twist.py", text)
        return classes.is_class(session)

    return check


BASE = CLASS.replace("NewJoy2Twist", "Node").split("\n\nif __name__")[0]
BELOW = """class NewJoy2Twist(Node):
    def callback(self, data):
        self.publish(data)


if __name__ == "__main__":
    NewJoy2Twist()
"""


@pytest.mark.parametrize(("before", "where"), [("on_shutdown", ""), ("Subscriber", ":8")])
def test_an_early_ctrl_c_finds_no_publisher(form, before, where):
    line = f"        rospy.{before}"
    publisher = "        self.cmd_vel = rospy.Publisher('/cmd_vel', Twist)\n"
    said = form(CLASS.replace(line, publisher + line))
    assert getattr(said, "where", "") == (where and f"scripts/new_joy2twist.py{where}")


@pytest.mark.parametrize(
    "text",
    [
        CLASS.replace("self.shutdown)", "self.robot.stop)"),
        CLASS.replace("self.shutdown)", "self.ended)\n        self.ended = print"),
        CLASS.replace("self.callback)", "partial(self.callback, 1))"),
        CLASS.replace("NewJoy2Twist:", "NewJoy2Twist(Base):").replace("def shutdown", "def other"),
        CLASS.replace("class", f"{ROBOT}class", 1),
        f"{BASE}\n\n{BELOW}",
    ],
)
def test_what_may_be_right(form, text):
    assert form(text) == "NewJoy2Twist in scripts/new_joy2twist.py"


def test_a_base_class_in_a_file_of_its_own(folder, form):
    write(folder, "scripts/node.py", BASE)
    said = form(f"#!/usr/bin/python3\nfrom node import Node\n\n\n{BELOW}")
    assert said.startswith("NewJoy2Twist in")
