"""C11: which of the recordings in a workspace counts."""

from types import SimpleNamespace

import pytest
import rosbag
from sensor_msgs.msg import Joy
from std_msgs.msg import String

from tutorial_check.exercises.robot import recording
from tutorial_check.model import Note, Wrong

JOY, CHATTER = ("/joy", Joy(axes=[0.0] * 6)), ("/chatter", String())


@pytest.fixture
def session(tmp_path):
    """A workspace of both packages, without a recording."""
    names = ("beginner_tutorials", "joy2twist")
    packages = {name: SimpleNamespace(folder=tmp_path / name) for name in names}
    for each in packages.values():
        each.folder.mkdir()
    return SimpleNamespace(source=tmp_path, package=packages.get)


def record(session, path, said=None):
    """Make a recording; without a message it is none."""
    file = session.source / path
    file.write_text("none")
    if said:
        with rosbag.Bag(str(file), "w") as bag:
            bag.write(*said)


def test_none_is_no_mistake(session):
    assert isinstance(recording(session), Note)


@pytest.mark.parametrize("name", ["joy2twist/joy.bag", "joy.bag"])
@pytest.mark.parametrize("said", [None, CHATTER])
def test_the_one_of_joy_counts(session, name, said):
    record(session, "beginner_tutorials/chatter.bag", said)
    record(session, "joy2twist/a.bag", said)
    record(session, name, JOY)
    assert recording(session) == f"{name}: /joy"


@pytest.mark.parametrize("name", ["beginner_tutorials/chatter.bag", "joy2twist/joy.bag"])
def test_one_of_something_else_is_no_mistake(session, name):
    record(session, name, CHATTER)
    note = recording(session)
    assert note.seen == "no recording of /joy; topics: /chatter"
    assert note.where == name


@pytest.mark.parametrize("name", ["joy2twist/figure.bag", "joy.bag"])
def test_one_that_cannot_be_read(session, name):
    record(session, "beginner_tutorials/chatter.bag", CHATTER)
    record(session, name)
    with pytest.raises(Wrong) as raised:
        recording(session)
    assert raised.value.where == name


def test_one_of_another_exercise_that_cannot_be_read(session):
    record(session, "beginner_tutorials/chatter.bag")
    assert isinstance(recording(session), Note)
