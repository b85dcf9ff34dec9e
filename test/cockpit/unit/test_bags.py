"""Recordings on pages: opened, shown and played."""

import os
import queue
from math import inf, nan
from types import SimpleNamespace

import pytest
import rosbag
import rospy
from sensor_msgs.msg import Joy

from cockpit_server.driving.player import Player
from cockpit_server.errors import RefusedError
from cockpit_server.ros.tabs import bag_files, bags
from cockpit_server.ros.tabs.bag_files import read
from cockpit_server.tabs import recordings
from cockpit_server.tabs.recordings import corners
from gamepad.errors import BagError
from tutorial_testing.claims import claim
from tutorial_testing.session_room import page as new_page

pytestmark = claim(
    "Recordings are read once, bounded, and named without a folder; viewers get only the suite's "
    "own"
)


class Page:
    """A page, its recordings, and a robot to which it may play them."""

    def __init__(self):
        self.done, self.player = queue.Queue(), None
        driving = SimpleNamespace(
            play=lambda _client, _robot, player, _now: setattr(self, "player", player),
            plays=lambda player: bool(player) and player is self.player,
            leave=lambda _client: setattr(self, "player", None),
        )
        self.bags = bags.Bags(driving, self.done.put)
        self.client, self.sent = new_page(bag=True)

    def say(self, kind, now=0.0, **fields):
        getattr(self.bags, f"on_{kind}")(self.client, now, **fields)

    def play(self):
        self.say("bag_play", topic="/joy", rate=1.0, loop=False, robot="")
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


@pytest.fixture
def page(monkeypatch, tmp_path):
    """A page that offers two recordings: good.bag and odd.bag."""
    for name, axes in (("good.bag", [0.5, 1.0]), ("odd.bag", [nan, inf])):
        with rosbag.Bag(str(tmp_path / name), "w") as bag:
            for second in range(1, 4):
                values = axes if second == 2 else [0.25, 0.5]
                bag.write("/joy", Joy(axes=values, buttons=[1]), rospy.Time(second))
    monkeypatch.setattr(bags, "bag_files", lambda _: {bag.name: bag for bag in tmp_path.glob("*")})
    return Page()


def test_curves_have_finite_values_and_their_corners_alone(page):
    first, last = page.open("odd.bag")["curves"]["/joy/axes[0]"]
    assert (first, last) == ([0.0, 0.25], [2.0, 0.25])
    assert corners([[0, 1], [1, 1], [2, 1], [3, 2], [4, 1]]) == [[0, 1], [2, 1], [3, 2], [4, 1]]


@claim("A recording takes ...", because="where it plays from")
def test_recording_plays_from_where_the_page_has_put_it_until_its_end(page):
    page.open("good.bag")
    page.say("bag_seek", position=1.0)
    assert page.play()
    assert [axes[0] for axes, _ in page.player.due(0.5)] == [0.5]
    assert page.seen(0.25) == (1.25, True)
    page.say("bag_pause", now=0.5)
    assert page.player is None
    assert page.seen(0.5) == (1.5, False)
    assert page.play()
    page.player = None  # as at its end
    assert page.seen(10.0) == (0.0, False)


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


def test_messages_of_all_open_recordings_are_bounded(page, monkeypatch):
    monkeypatch.setattr(
        recordings, "MOST_MESSAGES", 5
    )  # room for one recording: each has 3 messages
    page.open("good.bag")
    page.bags.collect([page.client], 0.0)
    why = "other pages have long recordings open: close one of them"
    assert page.open("odd.bag")["why"] == why
    page.bags.collect([], 0.0)  # the page is gone
    assert page.open("odd.bag")["path"] == "odd.bag"


def test_refused_file_is_named_without_its_folder(tmp_path):
    os.mkfifo(tmp_path / "pipe.bag")
    (tmp_path / "text.bag").write_text("no bag")
    for name in ("pipe.bag", "text.bag", "none.bag"):
        with pytest.raises(BagError) as error:
            read(tmp_path / name)
        assert str(error.value).startswith(f"{name}: ") and str(tmp_path) not in str(error.value)


def test_viewers_are_offered_nothing_of_the_folder(tmp_path, monkeypatch):
    (tmp_path / "own.bag").write_text("no bag")
    monkeypatch.chdir(tmp_path)
    assert set(bag_files.bag_files(may_drive=True)) == {"joy.bag", "own.bag"}
    assert set(bag_files.bag_files(may_drive=False)) == {"joy.bag"}


MESSAGES = [(0.0, "a", 0), (0.5, "b", 0), (1.0, "c", 0)]


# After seek(position, 10.0): the messages that are due at each of these times.
@pytest.mark.parametrize(
    ("position", "rate", "loop", "due"),
    [
        (0.0, 1.0, False, {10.01: "a", 10.49: "", 10.51: "b", 11.3: "c"}),
        (0.0, 2.0, False, {10.3: "ab"}),
        (0.5, 1.0, False, {10.1: "b"}),
        (5.0, 1.0, False, {10.1: "a"}),  # beyond the end: from the beginning
        (0.0, 1.0, True, {11.19: "abc", 11.21: "", 11.22: "a"}),
    ],
)
def test_each_message_is_due_once_at_its_time(position, rate, loop, due):
    player = Player(MESSAGES, 1.2, rate, loop)
    player.seek(position, 10.0)
    for now, names in due.items():
        assert "".join(axes for axes, _ in player.due(now)) == names
