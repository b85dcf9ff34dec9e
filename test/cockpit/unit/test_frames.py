"""The tab Frames: rates, ages and what is wrong with the edges of tf."""

from math import radians, sin

import genpy
import pytest
from geometry_msgs.msg import Quaternion, Transform, TransformStamped, Vector3

from cockpit_server.graph import TF, TF_STATIC, Graph
from cockpit_server.messages import ReceivedMessage
from cockpit_server.tabs.frames import MOST_EDGES, Frames, fixed, text_of, tree
from tutorial_testing.claims import claim
from tutorial_testing.session_room import Graphs, look, page

START_S = 100.0  # of ROS's clock
SIM, OTHER = "/sim", "/other"


class Tree:
    """A page that watches the frames, and nodes that publish them. now: ROS's clock [s]."""

    def __init__(self):
        self.now, self._looks = START_S, 0.0
        self.needed, self.pairs = [], []
        self.graphs = Graphs(Graph(publishers={topic: {SIM, OTHER} for topic in (TF, TF_STATIC)}))
        self.frames = Frames(self, self.graphs, lambda: self.now)
        self.client, self.sent = page(frames=())

    def set_needed(self, owner, is_needed):
        self.needed.append(is_needed)

    def lookup(self, target, source):
        self.pairs.append((target, source))
        return (None, "why") if target == "nowhere" else (Transform(rotation=Quaternion(w=1)), "")

    def publish(self, parent, child, node=SIM, late_s=0.0, topic=TF, refusal="", stamp=None):
        new = TransformStamped(child_frame_id=child)
        new.header.frame_id = parent
        new.header.stamp = genpy.Time.from_sec(self.now - late_s if stamp is None else stamp)
        self.frames.on_transform(new, ReceivedMessage(topic, b"", node, 0.0), refusal, self.now)

    def publish_for(self, seconds, *edges, hz=20, **how):
        for _ in range(round(seconds * hz)):
            self.now += 1 / hz
            for parent, child in edges:
                self.publish(parent, child, **how)

    def look(self, seconds=1.0):
        """Return what the page is sent, some seconds of a person's clock after the last look."""
        self._looks += seconds
        [messages] = look(self.frames, (self.client, self.sent), now=self._looks)
        return {message.pop("kind"): message for message in messages}

    @property
    def rows(self):
        return {row["frame"]: row for row in self.look()["frames"]["rows"]}

    def problems(self, frame):
        return self.rows[frame]["problems"]


@pytest.fixture
def tf():
    return Tree()


@claim("The tab Frames has the tree of tf with rate, age and nodes of each edge")
def test_tree_has_rates_ages_and_nodes_and_marks_what_is_static(tf):
    tf.publish("base", "laser", topic=TF_STATIC)
    tf.publish_for(3.0, ("odom", "base"), ("base", "arm"), late_s=0.1)
    rows = tf.rows
    assert [(row["frame"], row["depth"]) for row in rows.values()] == [
        ("odom", 0), ("base", 1), ("arm", 2), ("laser", 2),
    ]  # fmt: skip
    assert "rate" not in rows["odom"], "nothing publishes a root"
    base, laser = rows["base"], rows["laser"]
    assert (base["rate"], base["age"], base["nodes"]) == (20.0, 0.1, [SIM])
    assert (base["static"], laser["static"], laser["age"]) == (False, True, 3.0)
    assert all(row.get("problems", []) == [] for row in rows.values())


@claim("Frames: two publishers, two parents, gaps and wrong stamps are named as problems")
def test_second_node_and_second_parent_are_problems_until_they_end(tf):
    tf.publish_for(2.0, ("odom", "base"))
    tf.publish_for(0.5, ("odom", "base"), node=OTHER)
    assert tf.problems("base") == ["2 nodes publish it: /other, /sim"]
    tf.publish_for(0.5, ("map", "base"), node=OTHER)
    assert tf.problems("base")[1] == "2 parents: map, odom"
    tf.graphs.graph = Graph(publishers={TF: {SIM}})  # the other one exits
    tf.publish_for(0.5, ("odom", "base"))
    assert tf.problems("base") == []
    tf.publish_for(0.5, ("map", "base"))
    assert tf.problems("base") == ["2 parents: map, odom"], "of the same node"
    tf.publish_for(6.0, ("map", "base"))
    assert tf.problems("base") == []


@pytest.mark.parametrize(("hz", "quiet_s", "silent_s"), [(20, 1.9, 2.1), (0.5, 5.9, 6.1)])
def test_edge_that_was_regular_has_a_gap_after_three_periods_but_not_in_a_paused_time(
    tf, hz, quiet_s, silent_s
):
    tf.publish_for(8.0, ("odom", "base"), hz=hz)
    tf.publish("base", "laser", topic=TF_STATIC)
    tf.look(60.0)
    assert tf.rows["base"]["rate"] == hz, "the time of ROS was paused for a minute"
    begin = tf.now
    tf.now = begin + quiet_s
    assert tf.problems("base") == []
    tf.now = begin + silent_s
    assert tf.problems("base") == [f"nothing for {silent_s:.1f} s"]
    assert (tf.rows["base"]["rate"], tf.problems("laser")) == (0, [])
    tf.graphs.graph = Graph()
    assert tf.problems("base")[1] == tf.problems("laser")[0] == "its node has exited"
    tf.graphs.graph = Graph(publishers={TF: {SIM}})
    tf.publish_for(1.0, ("odom", "base"))
    assert tf.problems("base") == []


def test_rate_is_that_of_the_last_seconds_and_a_single_transform_has_none(tf):
    tf.publish_for(5.0, ("odom", "base"), hz=20)
    tf.publish("odom", "arm")
    tf.publish_for(5.5, ("odom", "base"), hz=4)
    assert (tf.rows["base"]["rate"], tf.rows["arm"]["rate"]) == (4.0, 0)
    assert tf.problems("arm") == [], "it may be slow"
    tf.now += 10.0
    assert tf.problems("arm") == ["nothing for 15.5 s"]


def test_node_that_the_master_does_not_know_yet_has_not_exited(tf):
    tf.graphs.graph = Graph()
    tf.publish("odom", "base")
    assert tf.problems("base") == []


@pytest.mark.parametrize(
    ("how", "why"),
    [({"late_s": 0.9}, []), ({"late_s": -0.9}, []),
     ({"late_s": 3.0}, ["its stamp is 3.0 s in the past"]),
     ({"late_s": -3.0}, ["its stamp is 3.0 s in the future"]),
     ({"stamp": 0.0}, ["its stamp is 0: set header.stamp"]),
     ({"stamp": 0.0, "topic": TF_STATIC}, []),
     ({"refusal": "it is odd"}, ["tf2 refuses it: it is odd"])],
)  # fmt: skip
def test_wrong_stamps_and_refused_transforms_are_problems(tf, how, why):
    tf.publish("odom", "base", **how)
    assert tf.problems("base") == why
    assert (tf.rows["base"]["age"] is None) == ("stamp" in how)
    tf.publish_for(5.5, ("odom", "base"), topic=how.get("topic", TF))
    assert tf.problems("base") == []


def test_static_frame_that_its_node_moves_has_only_the_new_parent(tf):
    tf.publish("base", "laser", topic=TF_STATIC)
    tf.publish("arm", "laser", topic=TF_STATIC)
    assert (tf.problems("laser"), tf.rows["laser"]["parent"]) == ([], "arm")
    tf.now += 3600.0
    assert tf.problems("laser") == []
    tf.publish("arm", "laser", node=OTHER, topic=TF_STATIC)
    assert tf.problems("laser") == ["2 nodes publish it: /other, /sim"]


def test_frames_in_a_loop_are_shown_and_unconnected_trees_begin_with_their_roots(tf):
    for parent, child in (("map", "odom"), ("a", "b"), ("b", "a"), ("b", "c"), ("self", "self")):
        tf.publish(parent, child)
    assert {row["frame"]: row["depth"] for row in tf.rows.values()} == {
        "map": 0, "odom": 1, "a": 0, "b": 1, "c": 2, "self": 0,
    }  # fmt: skip
    assert tf.problems("a") == tf.problems("self") == ["its parents form a loop"]
    robots = {name: "map" for name in ("robot_10", "robot_2", "robot")}
    assert list(tree(robots)) == ["map", "robot", "robot_2", "robot_10"]
    chain = {f"f{n}": f"f{n + 1}" for n in range(5000)}
    assert tree(chain)["f0"] == 5000


@claim("What a hostile node publishes on /tf stays bounded, and costs nothing unless it is watched")
def test_frames_are_bounded_and_needed_only_while_a_page_watches_them(tf):
    for number in range(2 * MOST_EDGES):
        tf.publish("", f"{number} {'x' * 300}", refusal="a name is empty")
        tf.publish(f"parent {number}", "many", node=f"/{number}")
    frames = tf.look()["frames"]
    assert frames["full"] and len(frames["rows"]) <= 2 * MOST_EDGES
    assert all(len(row["frame"]) <= 200 for row in frames["rows"])
    assert "(no name)" in tf.rows
    assert tf.problems("many")[1].startswith("4 parents: ")
    assert tf.needed[-1] is True
    tf.frames.on_clear()
    assert tf.look()["frames"] == {"rows": [], "published": True, "full": False}
    assert [list(tf.look(0.1)) for _ in range(10)].count(["frames"]) in (1, 2, 3)
    tf.publish("odom", "base")
    tf.client.watch.frames, tf.now = None, None  # Without a page the time is not needed.
    assert (tf.look(), tf.needed[-1]) == ({}, False)


@claim("Frames shows the transform between two frames as tf_echo does, or tf2's reason")
def test_page_receives_the_transform_of_its_pair_at_once_and_twice_a_second(tf):
    tf.look()
    assert tf.pairs == []
    tf.client.watch.frames = ("odom", "base")
    assert tf.look(0.01)["transform"]["text"].startswith("x, y, z: 0.000, 0.000, 0.000 m\n")
    assert "transform" not in tf.look(0.01)
    assert "transform" in tf.look(1.0)
    tf.client.watch.frames = ("nowhere", "base")
    assert tf.look(0.01)["transform"] == {"text": "why"}
    assert tf.pairs == [("odom", "base")] * 2 + [("nowhere", "base")]


@pytest.mark.parametrize(
    ("axis", "angles"), [("x", "90.0, 0.0, 0.0"), ("y", "0.0, 90.0, 0.0"), ("z", "0.0, 0.0, 90.0")]
)
def test_transform_as_text_has_metres_degrees_and_the_quaternion(axis, angles):
    half = sin(radians(45))
    turn = Quaternion(**{"x": 0.0, "y": 0.0, "z": 0.0, "w": half, axis: half})
    lines = text_of(Transform(Vector3(1.5, -0.0001, -2), turn)).splitlines()
    assert lines[0] == "x, y, z: 1.500, 0.000, -2.000 m"
    assert lines[1] == f"roll, pitch, yaw: {angles} degrees"
    assert lines[2] == f"quaternion x, y, z, w: {fixed(3, turn.x, turn.y, turn.z, turn.w)}"
