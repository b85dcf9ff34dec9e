"""The way between the two sides of the bridge."""

import collections
import socket
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ros2_bridge.link import BUFFER_BYTES, Frame, Sender, frames, is_late
from tutorial_testing.waiting import wait_for

NAMES = st.text(st.characters(blacklist_characters="\0", blacklist_categories=["Cs"]), min_size=1)


@pytest.fixture
def ends():
    pair = socket.socketpair()
    yield pair
    for each in pair:
        each.close()


@given(NAMES, NAMES, st.binary(max_size=1000), st.floats(0, 1e9), st.booleans())
def test_a_frame_arrives_as_it_was_sent(topic, kind, data, stamp_s, is_latched):
    one, other = socket.socketpair()
    with one, other:
        frame = Frame(topic, kind, data, stamp_s, is_latched)
        one.sendall(frame.packed() * 2)
        one.shutdown(socket.SHUT_WR)
        assert list(frames(other)) == [frame, frame]


def test_a_side_that_exits_before_it_has_read_all_ends_the_frames(ends):
    one, other = ends
    frame = Frame("/a", "b/msg/C", b"1", 1.0)
    one.sendall(frame.packed())
    other.sendall(b"never read")
    one.close()
    assert list(frames(other)) in ([frame], [])


@pytest.mark.parametrize("cut", [1, 12, 13, 20])
def test_an_incomplete_frame_is_dropped(ends, cut):
    one, other = ends
    one.sendall(Frame("/a", "b/msg/C", b"12345678", 1.0).packed()[:cut])
    one.shutdown(socket.SHUT_WR)
    assert not list(frames(other))


def test_the_newest_velocity_does_not_wait_behind_old_ones(ends):
    """While nothing reads, one topic keeps the newest and another all; they take turns."""
    one, other = ends
    depths = {"/cmd_vel": 1, "/odom": 1000}
    sender = Sender(one, depths.__getitem__)
    filling = Frame("/odom", "t", bytes(4 * BUFFER_BYTES), 0.0)
    sender.put(filling)
    wait_for(lambda: not sender._waiting["/odom"], "a sender that waits for the kernel")
    for number in range(100):
        sender.put(Frame("/odom", "t", b"%d" % number, 0.0))
        sender.put(Frame("/cmd_vel", "t", b"%d" % number, 0.0))
    came = []
    for frame in frames(other):
        came.append((frame.topic, frame.data))
        if len(came) == 102:
            break
    assert came[0][0] == "/odom" and ("/cmd_vel", b"99") in came[:3]
    assert collections.Counter(topic for topic, _ in came) == {"/odom": 101, "/cmd_vel": 1}
    sender.end()


def test_a_closed_connection_ends_the_frames(ends):
    one, other = ends
    other.close()
    sender = Sender(one, lambda topic: 1)
    sender.put(Frame("/a", "t", b"", 0.0))
    assert not list(frames(one))
    sender.end()


def test_what_is_late():
    now_s = time.monotonic()
    assert is_late(Frame("/a", "t", b"", now_s - 0.6), 0.5)
    assert not is_late(Frame("/a", "t", b"", now_s - 0.6), 0.0)
    assert not is_late(Frame("/a", "t", b"", now_s), 0.5)
