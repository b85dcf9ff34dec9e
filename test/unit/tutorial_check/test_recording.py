"""C11: which of the recordings in a workspace counts."""

from types import SimpleNamespace

import pytest
import rosbag
from sensor_msgs.msg import Joy
from std_msgs.msg import String

from tutorial_check.exercises.robot import recording
from tutorial_check.model import Note, Wrong

JOY, CHATTER, BROKEN = ("/joy", Joy(axes=[0.0] * 6)), ("/chatter", String()), None
TALK = "beginner_tutorials/chatter.bag"


@pytest.mark.parametrize(
    ("bags", "kind", "where"),
    [
        ({}, Note, ""),
        ({TALK: CHATTER}, Note, TALK),
        ({"joy2twist/joy.bag": CHATTER}, Note, "joy2twist/joy.bag"),
        ({TALK: BROKEN}, Note, None),  # it is of another exercise
        ({TALK: CHATTER, "joy.bag": BROKEN}, Wrong, "joy.bag"),
        ({TALK: CHATTER, "joy2twist/figure.bag": BROKEN}, Wrong, "joy2twist/figure.bag"),
        ({TALK: CHATTER, "joy2twist/a.bag": CHATTER, "joy.bag": JOY}, str, "joy.bag"),
        ({TALK: BROKEN, "joy2twist/a.bag": BROKEN, "joy2twist/b.bag": JOY}, str, "joy2twist/b.bag"),
    ],
)
def test_the_recording_of_joy_counts(tmp_path, bags, kind, where):
    names = ("beginner_tutorials", "joy2twist")
    packages = {name: SimpleNamespace(folder=tmp_path / name) for name in names}
    for each in packages.values():
        each.folder.mkdir()
    for path, message in bags.items():
        (tmp_path / path).write_text("no recording")
        if message:
            with rosbag.Bag(str(tmp_path / path), "w") as bag:
                bag.write(*message)
    try:
        found = recording(SimpleNamespace(source=tmp_path, package=packages.get))
    except Wrong as wrong:
        found = wrong
    assert isinstance(found, kind)
    assert found == f"{where}: /joy" if kind is str else where in (None, found.where)
    if bags and kind is Note and where:
        assert found.seen == "no recording of /joy; topics: /chatter"
