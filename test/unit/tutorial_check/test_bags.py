"""C11: which of the recordings in a workspace counts."""

from types import SimpleNamespace

import pytest
import rosbag
from sensor_msgs.msg import Joy
from std_msgs.msg import String

from tutorial_check.handout.s4.judge import recording
from tutorial_check.model import Wrong

JOY, CHATTER, BROKEN = ("/joy", Joy(axes=[0.0] * 6)), ("/chatter", String()), None
TALK = "beginner_tutorials/chatter.bag"
OTHER_TOPICS = "no recording of /joy; topics: /chatter"


@pytest.fixture
def workspace(tmp_path):
    folders = {name: tmp_path / name for name in ("beginner_tutorials", "joy2twist")}
    for folder in folders.values():
        folder.mkdir()
    package = lambda name: SimpleNamespace(folder=folders[name])  # noqa: E731
    one = SimpleNamespace(source=tmp_path, package=package, has=folders.__contains__)
    one.recording = lambda recorder, path: recorder(one, path)
    return one


def record(path, message):
    path.write_text("no recording")
    if message:
        with rosbag.Bag(str(path), "w") as bag:
            bag.write(*message)


@pytest.mark.parametrize(
    ("bags", "found"),
    [
        ({TALK: CHATTER}, (TALK, OTHER_TOPICS)),
        ({TALK: CHATTER, "joy2twist/a.bag": CHATTER, "joy.bag": JOY}, "joy.bag: /joy"),
        ({TALK: BROKEN, "joy2twist/b.bag": JOY}, "joy2twist/b.bag: /joy"),
    ],
)
def test_the_recording_of_joy_counts(workspace, bags, found):
    for path, message in bags.items():
        record(workspace.source / path, message)
    result = recording(workspace)
    assert (result if isinstance(result, str) else (result.where, result.seen)) == found


def test_a_broken_recording_beside_others_is_wrong(workspace):
    record(workspace.source / TALK, CHATTER)
    record(workspace.source / "joy.bag", BROKEN)
    with pytest.raises(Wrong) as wrong:
        recording(workspace)
    assert wrong.value.where == "joy.bag"
