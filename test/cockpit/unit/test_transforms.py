"""tf for the page: what is kept, and what is refused before tf2 prints a line about it."""

from math import inf, pi, sin

import genpy
import pytest
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage

from cockpit_server.graph import Graph
from cockpit_server.ros.transforms import Transforms
from tutorial_testing.claims import claim
from tutorial_testing.session_room import Graphs, Topics


def stamped(parent, child, at, x=0.0, turn=(0.0, 0.0, 0.0, 1.0)):
    message = TransformStamped(child_frame_id=child)
    message.header.frame_id, message.header.stamp = parent, genpy.Time.from_sec(at)
    message.transform.translation.x = x
    rotation = message.transform.rotation
    rotation.x, rotation.y, rotation.z, rotation.w = turn
    return message


class Tf(Topics):
    """Transforms that an owner needs, the time, and what a listener was passed."""

    def __init__(self, monkeypatch):
        super().__init__()
        self.now, self.children, self.refusals = 100.0, [], []
        monkeypatch.setattr("rospy.get_time", lambda: self.now)
        topics = {topic: {"/sim"} for topic in ("/tf", "/tf_static")}
        self.transforms = Transforms(self, Graphs(Graph(publishers=topics)))
        self.transforms.listeners = (self,)
        self.transforms.set_needed("a test", True)

    def on_transform(self, new, _, refusal, now):
        assert now == self.now
        (self.refusals if refusal else self.children).append(refusal or new.child_frame_id)

    def on_clear(self):
        self.children.clear()

    def publish(self, *transforms, topic="/tf"):
        self.hear(topic, TFMessage(list(transforms)))

    def x(self, target, source, at=None):
        stamp = None if at is None else genpy.Time.from_sec(at)
        transform, why = self.transforms.lookup(target, source, stamp)
        return why if transform is None else transform.translation.x


@pytest.fixture
def tf(monkeypatch):
    return Tf(monkeypatch)


@claim("The page looks transforms up as tf2 does, at a time or the newest")
def test_transform_between_two_frames_over_several_edges(tf):
    tf.publish(stamped("base", "camera", 0.0, x=0.5), topic="/tf_static")
    tf.publish(stamped("odom", "base", 99.0, x=1.0), stamped("/odom", "/base", 100.0, x=2.0))
    assert tf.x("odom", "camera") == pytest.approx(2.5)
    assert tf.x("odom", "camera", at=99.5) == pytest.approx(2.0)
    assert tf.x("odom", "camera", at=50.0) == pytest.approx(2.5), "out of reach: the newest"
    assert "does not exist" in tf.x("odom", "wheel")


@claim("A transform that tf2 refuses has its reason on the page, and none in the log")
@pytest.mark.parametrize(
    ("wrong", "why"),
    [(stamped("", "a", 1.0), "header.frame_id is empty"),
     (stamped("a", "", 1.0), "child_frame_id is empty"), (stamped("a", "a", 1.0), "own parent"),
     (stamped("odom", "a", 1.0, x=inf), "infinite or NaN"),
     (stamped("odom", "a", 1.0, turn=(0.0, 0.0, 0.0, 0.5)), "length of its quaternion is 0.5"),
     (stamped("odom", "a" * 300, 1.0), "more than 200 characters")],
)  # fmt: skip
def test_transform_that_tf2_refuses_is_reported_in_place_of_tf2(tf, wrong, why, capfd):
    tf.publish(wrong, stamped("odom", "base", 1.0))
    tf.publish(stamped("odom", "base", 1.0), stamped("odom", "base", 0.5))
    assert [why in refusal for refusal in tf.refusals] == [True]
    assert set(tf.children) == {"base"}
    assert capfd.readouterr() == ("", "")


def test_nothing_is_kept_while_nobody_needs_it_and_when_time_goes_back(tf):
    half = sin(pi / 4)
    tf.publish(stamped("odom", "base", 100.0, x=1.0, turn=(0.0, 0.0, half, half)))
    tf.now = 3.0  # a recording starts again
    tf.publish(stamped("odom", "wheel", 3.0))
    assert isinstance(tf.x("odom", "base"), str)
    assert tf.x("odom", "wheel") == 0.0
    assert tf.children == ["wheel"]
    tf.transforms.set_needed("a test", False)
    assert tf.children == []
    assert isinstance(tf.x("odom", "wheel"), str)


@claim("Without python3-tf2 the page has the frames, and names what to install for the rest")
def test_without_tf2_listeners_get_transforms_and_a_lookup_says_what_to_install(monkeypatch):
    monkeypatch.setattr("cockpit_server.ros.transforms.tf2_py", None)
    tf = Tf(monkeypatch)
    tf.publish(stamped("odom", "base", 100.0))
    assert tf.children == ["base"]
    assert "Install python3-tf2" in tf.x("odom", "base")
    tf.transforms.set_needed("a test", False)
