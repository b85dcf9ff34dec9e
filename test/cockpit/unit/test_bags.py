"""Recordings on pages: opened, shown and played."""

import queue
from io import BytesIO
from math import inf, nan
from types import SimpleNamespace

import pytest
import rosbag
import rospy
from geometry_msgs.msg import Twist, Vector3
from nav_msgs.msg import OccupancyGrid, Odometry
from sensor_msgs.msg import Joy

from cockpit_server.errors import RefusedError
from cockpit_server.graph import Graph
from cockpit_server.ros.tabs import bag_files, bags, playback
from cockpit_server.ros.tabs.bag_files import read
from tutorial_testing.claims import claim
from tutorial_testing.nodes import serialised
from tutorial_testing.session_room import Graphs
from tutorial_testing.session_room import page as new_page

pytestmark = claim(
    "Recordings are read once, bounded, and named without a folder; viewers get only the suite's "
    "own"
)
NOW = SimpleNamespace(monotonic=lambda: 0.0, sleep=None)
ODD = "/odom/pose/pose/position/x"


class Page:
    """A page, its recordings, and a robot to which it may play them."""

    def __init__(self):
        self.done, self.player, self.about, self.joysticks = queue.Queue(), None, None, []
        self.refusal = ""
        session = SimpleNamespace(play=lambda axes, _buttons: self.joysticks.append(axes))
        driving = SimpleNamespace(
            play=self.take, session=session, why_not_free=lambda _: self.refusal,
            plays=lambda player: bool(player) and player is self.player, leave=self.leave,
        )  # fmt: skip
        self.graphs = Graphs(Graph(publishers={"/odom": {"/cockpit", "/sim"}}, own_name="/cockpit"))
        self.bags = bags.Bags(driving, self.done.put, self.graphs)
        self.client, self.sent = new_page(bag=True)

    def take(self, _client, player, _now, **about):
        self.player, self.about = player, about

    def leave(self, _client):
        self.player.end()
        self.player = None

    def say(self, kind, now=0.0, **fields):
        getattr(self.bags, f"on_{kind}")(self.client, now, **fields)

    def play(self, *topics):
        """Play, and finish loading; return whether it plays."""
        self.say("bag_play", topics=topics or ("/joy",), rate=1.0, loop=False, robot="")
        self.done.get(timeout=60)()
        return self.player is not None

    def seen(self, now):
        self.bags.send_to(self.client, now)
        return self.sent[-1]["position"], self.sent[-1]["playing"]

    def show(self):
        """Finish opening; return the page's newest message of the kind "bag" or "refused"."""
        self.done.get(timeout=60)()
        self.bags.send_to(self.client, 0.0)
        return [message for message in self.sent if message["kind"] in ("bag", "refused")][-1]

    def open(self, name):
        self.say("bag_open", name=name)
        return self.show()

    def busy(self):
        """Return (nodes, refusal) of each "bag_busy" since the last call."""
        self.bags.send_to(self.client, 0.0)
        messages = [message for message in self.sent if message["kind"] == "bag_busy"]
        self.sent.clear()
        return [(message["nodes"], message["refusal"]) for message in messages]

    def draw(self, *fields):
        """Choose fields; return the messages that the page is sent for it."""
        self.client.watch.bag_fields = fields
        self.sent.clear()
        self.bags.collect([self.client], 0.0)
        self.bags._reader.submit(lambda: None).result(60)
        for _ in range(2):
            self.bags.send_to(self.client, 0.0)
        kinds = ("bag_curve", "refused")
        return [message for message in self.sent if message["kind"] in kinds]


@pytest.fixture
def page(monkeypatch, tmp_path):
    """A page that offers three recordings: good.bag, odd.bag and all.bag."""
    for name, axes in (("good.bag", [0.5, 1.0]), ("odd.bag", [nan, inf])):
        with rosbag.Bag(str(tmp_path / name), "w") as bag:
            for second in range(1, 4):
                values = axes if second == 2 else [0.25, 0.5]
                bag.write("/joy", Joy(axes=values, buttons=[1]), rospy.Time(second))
    write_all(str(tmp_path / "all.bag"))
    offered = lambda _: {bag.name: bag for bag in tmp_path.glob("*")}  # noqa: E731
    monkeypatch.setattr(bags, "bag_files", offered)
    monkeypatch.setattr(bags, "time", NOW)
    return Page()


def header_of(topic, kind, **more):
    return {"topic": topic, "type": kind._type, "md5sum": kind._md5sum,
            "message_definition": kind._full_text, **more}  # fmt: skip


def write_all(path):
    """Write a recording of 2 s with a latched map, velocities, odometry and a joystick."""
    with rosbag.Bag(path, "w") as bag:
        latched = header_of("/map", OccupancyGrid, latching="1")
        bag.write("/map", OccupancyGrid(), rospy.Time(1), connection_header=latched)
        for i in range(3):
            odometry = Odometry()
            odometry.pose.pose.position.x = 10.0 * i
            bag.write("/odom", odometry, rospy.Time(1 + i))
            bag.write("/cmd_vel", Twist(linear=Vector3(x=i)), rospy.Time(1 + i))
            bag.write("/joy", Joy(axes=[i]), rospy.Time(1 + i))


class Output:
    """Replaces the publisher of a topic."""

    listeners, all = 0, {}

    def __init__(self, about):
        self.about, self.sent, self.is_closed = about, [], False
        self.all[about.topic] = self

    def publish(self, message):
        buffer = BytesIO()
        message.serialize(buffer)
        self.sent.append(buffer.getvalue())

    def end(self):
        self.is_closed = True


@pytest.fixture
def outputs(monkeypatch):
    monkeypatch.setattr(playback, "output_of", Output)
    monkeypatch.setattr(Output, "all", {})
    return Output.all


def test_a_chosen_field_is_read_once_and_sent_once_with_finite_values(page, monkeypatch):
    about = page.open("odd.bag")
    assert about["fields"] == [
        ["/joy/axes", 2], ["/joy/buttons", 1], ["/joy/header/seq", 0], ["/joy/header/stamp", 0],
    ]  # fmt: skip
    [curve] = page.draw("/joy/axes[0]")
    assert curve["points"] == [[0.0, 0.25], [2.0, 0.25]]
    monkeypatch.setattr(bags, "read_curves", lambda *_: [].pop())
    assert page.draw("/joy/axes[0]") == []
    [curve] = page.draw("/joy/axes[0]", "/joy/axes[1]")
    assert (curve["kind"], curve["why"][:19]) == ("refused", "odd.bag: IndexError")
    assert page.draw("/joy/axes[1]") == []  # which is not read again


def test_fields_that_a_recording_lacks_have_no_points(page):
    page.open("all.bag")
    curves = page.draw(ODD, "/joy/axes[7]", "/none/x", "/odom/child_frame_id", "/joy/axes")
    assert [len(curve["points"]) for curve in curves] == [3, 0, 0, 0, 0]
    assert curves[0]["points"] == [[0.0, 0.0], [1.0, 10.0], [2.0, 20.0]]


@claim("Before a recording plays, the page names other nodes that publish its topics")
def test_page_is_told_which_topics_others_publish_and_why_it_may_not_play(page):
    page.open("all.bag")
    assert page.busy() == [({"/odom": ["/sim"]}, "")]
    publishers = {"/ada/joy": {"/pad"}, "/joy": {"/cockpit", "/other"}}
    page.graphs.graph = Graph(publishers=publishers, own_name="/cockpit")
    page.refusal = "another page drives"
    assert page.busy() == [({"/joy": ["/other"]}, "Another page drives.")]
    page.client.watch.look = "ada"
    assert page.busy() == [({"/joy": ["/pad"]}, "Another page drives.")]
    assert page.busy() == []


@claim("A recording takes ...", because="where it plays from")
def test_recording_plays_from_where_the_page_has_put_it_until_its_end(page):
    page.open("good.bag")
    page.say("bag_seek", position=1.0)
    assert page.play()
    assert page.about == {"robot": ""}
    for send, data in page.player.due(0.5):
        send(data)
    assert [axes[0] for axes in page.joysticks] == [0.5]
    assert page.seen(0.25) == (1.25, True)
    page.say("bag_pause", now=0.5)
    assert page.player is None
    assert page.seen(0.5) == (1.5, False)
    assert page.play()
    page.player = None  # as at its end
    assert page.seen(10.0) == (0.0, False)


@claim("Recorded messages are published equal to the bit, latched ones latched, a velocity never")
def test_chosen_topics_are_published_as_they_were_recorded_and_a_velocity_ends_with_zero(
    page, outputs
):
    page.open("all.bag")
    assert page.play("/odom", "/map", "/cmd_vel")
    assert page.about == {"topic": "/cmd_vel"}  # which moves a robot
    assert {topic: output.about.is_latched for topic, output in outputs.items()} == {
        "/odom": False, "/map": True, "/cmd_vel": False,
    }  # fmt: skip
    for send, data in page.player.due(1.5):
        send(data)
    velocity = outputs["/cmd_vel"].sent
    assert velocity == [serialised(Twist(linear=Vector3(x=i))) for i in (0, 1)]
    assert [len(outputs[topic].sent) for topic in ("/odom", "/map")] == [2, 1]
    page.say("bag_pause", now=1.5)
    assert velocity[2:] == [serialised(Twist())]
    assert page.play("/odom")
    assert [outputs[topic].is_closed for topic in ("/odom", "/cmd_vel")] == [False, True]
    page.say("bag_pause", now=1.5)
    for now in (0.0, bags.UNUSED_S + 0.1):
        page.bags.collect([page.client], now)
        page.bags._reader.submit(lambda: None).result(60)
        assert outputs["/odom"].is_closed == (now > 0)


def test_recording_that_is_stopped_while_it_is_read_never_plays(page, outputs):
    page.open("all.bag")
    page.say("bag_play", topics=("/cmd_vel",), rate=1.0, loop=False, robot="")
    stopped = page.player
    with pytest.raises(RefusedError, match="is being opened"):
        page.say("bag_play", topics=("/odom",), rate=1.0, loop=False, robot="")
    page.say("bag_pause")
    page.done.get(timeout=60)()
    assert list(stopped.due(99.0)) == [] and outputs["/cmd_vel"].sent == []


def test_messages_of_a_second_type_on_a_topic_are_left_out(page, outputs, tmp_path):
    with rosbag.Bag(str(tmp_path / "two.bag"), "w") as bag:
        for second, message in enumerate((Twist(), Joy(), Twist()), 1):
            header = header_of("/cmd_vel", type(message))
            bag.write("/cmd_vel", message, rospy.Time(second), connection_header=header)
            bag._topic_connections.clear()  # so that the next one is another node's
    [topic] = page.open("two.bag")["topics"]
    assert topic["type"] == "geometry_msgs/Twist"
    assert page.play("/cmd_vel")
    assert len(page.player.due(9.0)) == 2
    assert list(outputs) == ["/cmd_vel"]


def test_too_much_to_play_is_refused_and_ends_the_session(page, monkeypatch):
    page.open("all.bag")
    monkeypatch.setattr(bag_files, "LARGEST", 100)
    assert not page.play("/odom")
    assert "choose fewer topics" in page.sent[-1]["why"]


@pytest.mark.parametrize(("bound", "most"), [("MOST_MESSAGES", 9), ("MOST_TOPICS", 3)])
def test_too_many_topics_or_messages_are_refused(page, monkeypatch, bound, most):
    monkeypatch.setattr(bag_files, bound, most)
    why = page.open("all.bag")["why"]
    assert why.startswith("all.bag: more than") and why.endswith(": use rosbag play")


def test_recording_that_cannot_be_shown_is_refused_and_the_last_one_stays(page, monkeypatch):
    page.open("good.bag")
    monkeypatch.setattr(bag_files, "encoded", lambda *_, **__: [].pop())
    page.say("bag_open", name="odd.bag")
    with pytest.raises(RefusedError, match="is being opened"):
        page.say("bag_open", name="odd.bag")
    assert page.show()["why"].startswith("odd.bag: IndexError")
    assert page.play()


def test_recording_is_read_once_for_all_pages(page, monkeypatch):
    read_so_far = []
    monkeypatch.setattr(bags, "read", lambda path: read_so_far.append(path.name) or read(path))
    for _ in range(3):
        for name in ("good.bag", "odd.bag"):
            page.open(name)
    assert read_so_far == ["good.bag", "odd.bag"]
