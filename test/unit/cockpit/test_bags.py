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
from cockpit_server.sources.recording import curves, read
from gamepad.bags import BagError
from tutorial_testing.seat_room import page as new_page


class Page:
    """A page and its recordings; the hub is this, too."""

    def __init__(self):
        self.done = queue.Queue()
        self.soon, self.seat = self.done.put, SimpleNamespace(driver=None, how="")
        self.bags = bags.Bags(self)
        self.client, self.sent = new_page()

    def sit_down(self, client, _robot, how, _now):
        self.seat = SimpleNamespace(driver=client.number, how=how)

    def stand_up(self, _client):
        self.seat = SimpleNamespace(driver=None, how="")

    def say(self, kind, **fields):
        getattr(self.bags, f"on_{kind}")(self.client, 0.0, **fields)

    def show(self):
        self.done.get(timeout=60)()
        self.bags.give(self.client, 0.0)

    def open(self, name):
        self.say("bag_open", name=name)
        self.show()


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
    page.open("odd.bag")
    assert page.sent[-1]["path"] == "odd.bag"
    assert page.sent[-1]["curves"] == {
        "/joy/axes[0]": [[0.0, 0.25], [2.0, 0.25]],
        "/joy/axes[1]": [[0.0, 0.5], [2.0, 0.5]],
        "/joy/buttons[0]": [[0.0, 1.0], [2.0, 1.0]],
    }
    assert curves({"/joy": [(0.0, (nan,), ())]}) == {"/joy/axes[0]": []}


@pytest.mark.parametrize("broken", ["read", "encoded"])
def test_a_recording_that_cannot_be_shown_is_refused(page, monkeypatch, broken):
    page.open("good.bag")
    monkeypatch.setattr(recording, broken, lambda *_, **__: [].pop())
    page.open("odd.bag")
    assert page.sent[-1]["kind"] == "refused"
    assert page.sent[-1]["why"].startswith("odd.bag: IndexError")
    assert page.bags._opened[7].name == "good.bag"


def test_opening_a_recording_ends_the_one_that_plays(page):
    page.open("good.bag")
    page.say("bag_open", name="odd.bag")
    page.say("bag_play", topic="/joy", rate=1.0, loop=False, robot="")
    assert page.seat.how == BAG
    page.show()
    assert page.seat.driver is None
    assert page.sent[-1]["path"] == "odd.bag"


def test_a_page_opens_one_recording_at_a_time(page):
    page.say("bag_open", name="good.bag")
    with pytest.raises(RefusedError, match="is being opened"):
        page.say("bag_open", name="odd.bag")
    page.show()
    page.open("odd.bag")
    assert page.sent[-1]["path"] == "odd.bag"


def test_a_recording_is_read_once_for_all_pages(page, monkeypatch):
    read_so_far = []
    monkeypatch.setattr(recording, "read", lambda path: read_so_far.append(path.name) or read(path))
    for _ in range(3):
        for name in ("good.bag", "odd.bag"):
            page.open(name)
    assert read_so_far == ["good.bag", "odd.bag"]


def test_the_messages_of_all_open_recordings_are_bounded(page, monkeypatch):
    monkeypatch.setattr(recording, "MOST_MESSAGES", 5)  # of 3 messages each there is room for one
    page.open("good.bag")
    page.bags.prepare([page.client], 0.0)
    page.open("odd.bag")
    assert page.sent[-1]["why"] == "other pages have long recordings open: close one of them"
    assert page.bags._opened[7].name == "good.bag"
    page.bags.prepare([], 0.0)  # the page is gone
    page.open("odd.bag")
    assert page.bags._opened[7].name == "odd.bag"


def test_a_refused_file_is_named_without_its_folder(tmp_path, monkeypatch):
    os.mkfifo(tmp_path / "pipe.bag")
    (tmp_path / "text.bag").write_text("no bag")
    for name in ("pipe.bag", "text.bag", "none.bag"):
        with pytest.raises(BagError) as error:
            read(tmp_path / name)
        assert str(error.value).startswith(f"{name}: ") and str(tmp_path) not in str(error.value)
    monkeypatch.chdir(tmp_path)
    assert set(recording.recordings(may_drive=True)) == {"joy.bag", "text.bag"}
    assert set(recording.recordings(may_drive=False)) == {"joy.bag"}  # nothing of this folder
