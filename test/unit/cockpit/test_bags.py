"""Recordings on pages: what is opened is what is shown and played."""

import os
import queue
from math import inf, nan
from types import SimpleNamespace

import pytest
import rosbag
import rospy
from sensor_msgs.msg import Joy

from cockpit_server.seat import BAG, RefusedError
from cockpit_server.sources import bags, recording
from cockpit_server.sources.recording import corners, curves, read
from gamepad.bags import BagError
from tutorial_testing.seat_room import page as new_page


class Page:
    """A page and its recordings; the hub is this, too."""

    def __init__(self):
        self.done, self.played = queue.Queue(), []
        self.soon = self.done.put
        self.bags = bags.Bags(self)
        self.client, self.sent = new_page(bag=True)
        self.clients = {self.client.number: self.client}
        self.stand_up()

    def sit_down(self, client, _robot, how, _now):
        self.seat = SimpleNamespace(driver=client.number, how=how, play=self.hear)

    def hear(self, axes, _buttons):
        self.played.append(axes[0])

    def stand_up(self, _client=None):
        self.seat = SimpleNamespace(driver=None, how="")

    def say(self, kind, now=0.0, **fields):
        getattr(self.bags, f"on_{kind}")(self.client, now, **fields)

    def play(self, rate=1.0, loop=False):
        self.say("bag_play", topic="/joy", rate=rate, loop=loop, robot="")
        return self.seat.how == BAG

    def show(self):
        """Let what was opened come; return what the page is sent of it: "bag" or "refused"."""
        self.done.get(timeout=60)()
        self.bags.give(self.client, 0.0)
        return [one for one in self.sent if one["kind"] in ("bag", "refused")][-1]

    def open(self, name):
        self.say("bag_open", name=name)
        return self.show()


@pytest.fixture
def page(monkeypatch, tmp_path):
    """A page, to which two recordings are offered: good.bag and odd.bag."""
    for name, axes in (("good.bag", [0.5, 1.0]), ("odd.bag", [nan, inf])):
        with rosbag.Bag(str(tmp_path / name), "w") as bag:
            for second in range(1, 4):
                values = axes if second == 2 else [0.25, 0.5]
                bag.write("/joy", Joy(axes=values, buttons=[1]), rospy.Time(second))
    monkeypatch.setattr(bags, "recordings", lambda _: {one.name: one for one in tmp_path.glob("*")})
    return Page()


def test_curves_leave_out_values_that_are_not_finite(page):
    shown = page.open("odd.bag")
    assert shown["path"] == "odd.bag"
    assert shown["curves"] == {
        "/joy/axes[0]": [[0.0, 0.25], [2.0, 0.25]],
        "/joy/axes[1]": [[0.0, 0.5], [2.0, 0.5]],
        "/joy/buttons[0]": [[0.0, 1.0], [2.0, 1.0]],
    }
    assert curves({"/joy": [(0.0, (nan,), ())]}) == {"/joy/axes[0]": []}


def test_curves_keep_their_corners():
    assert corners([[0, 1], [1, 1], [2, 1], [3, 2], [4, 1]]) == [[0, 1], [2, 1], [3, 2], [4, 1]]
    assert corners([[0, 1]]) == [[0, 1]] and corners([]) == []


def test_recording_plays_from_where_the_page_has_put_it_until_its_end(page):
    page.open("good.bag")
    page.say("bag_seek", position=1.0)
    assert page.play()
    page.bags.play(0.5)
    page.say("bag_pause", now=0.5)
    assert page.seat.driver is None
    page.bags.give(page.client, 0.5)
    assert (page.sent[-1]["position"], page.sent[-1]["playing"]) == (1.5, False)
    assert page.play()
    page.bags.play(10.0)
    assert page.played == [0.5, 0.25] and page.seat.driver is None


@pytest.mark.parametrize("broken", ["read", "encoded"])
def test_recording_that_cannot_be_shown_is_refused_and_the_last_one_stays(
    page, monkeypatch, broken
):
    page.open("good.bag")
    monkeypatch.setattr(recording, broken, lambda *_, **__: [].pop())
    refused = page.open("odd.bag")
    assert refused["kind"] == "refused" and refused["why"].startswith("odd.bag: IndexError")
    assert page.play()


def test_opening_a_recording_ends_the_one_that_plays(page):
    page.open("good.bag")
    page.say("bag_open", name="odd.bag")
    assert page.play()
    assert page.show()["path"] == "odd.bag"
    assert page.seat.driver is None


def test_page_opens_one_recording_at_a_time(page):
    page.say("bag_open", name="good.bag")
    with pytest.raises(RefusedError, match="is being opened"):
        page.say("bag_open", name="odd.bag")
    page.show()
    assert page.open("odd.bag")["path"] == "odd.bag"


def test_recording_is_read_once_for_all_pages(page, monkeypatch):
    read_so_far = []
    monkeypatch.setattr(recording, "read", lambda path: read_so_far.append(path.name) or read(path))
    for _ in range(3):
        for name in ("good.bag", "odd.bag"):
            page.open(name)
    assert read_so_far == ["good.bag", "odd.bag"]


def test_messages_of_all_open_recordings_are_bounded(page, monkeypatch):
    monkeypatch.setattr(recording, "MOST_MESSAGES", 5)  # of 3 messages each there is room for one
    page.open("good.bag")
    page.bags.prepare([page.client], 0.0)
    why = "other pages have long recordings open: close one of them"
    assert page.open("odd.bag")["why"] == why
    page.bags.prepare([], 0.0)  # the page is gone
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
    assert set(recording.recordings(may_drive=True)) == {"joy.bag", "own.bag"}
    assert set(recording.recordings(may_drive=False)) == {"joy.bag"}
