"""The connection between the two sides of the bridge."""

import socket
import time
from itertools import islice

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ros2_bridge.io.connection import Frame, Sender, frames, is_late
from tutorial_testing.claims import claim
from tutorial_testing.waiting import DEADLINE_S

pytestmark = claim(
    "Frames arrive as sent; a side that exits, or an incomplete frame, harms nothing"
)
NAMES = st.text(st.characters(blacklist_characters="\0", blacklist_categories=["Cs"]), min_size=1)
FRAME = Frame("/a", "b/msg/C", b"12345678", 1.0)


@pytest.fixture
def ends():
    one, other = socket.socketpair()
    with one, other:
        yield one, other


@given(st.builds(Frame, NAMES, NAMES, st.binary(), st.floats(0, 1e9), st.booleans(), st.booleans()))
def test_a_frame_arrives_as_it_was_sent(frame):
    one, other = socket.socketpair()
    with one, other:
        one.sendall(frame.packed() * 2)
        one.shutdown(socket.SHUT_WR)
        assert list(frames(other)) == [frame, frame]


def test_a_side_that_exits_before_it_has_read_all_ends_the_frames(ends):
    one, other = ends
    one.sendall(FRAME.packed())
    other.sendall(b"never read")
    one.close()
    assert list(frames(other)) in ([FRAME], [])


@pytest.mark.parametrize("cut", [1, 12, 13, 20])
def test_an_incomplete_frame_is_dropped(ends, cut):
    one, other = ends
    one.sendall(FRAME.packed()[:cut])
    one.shutdown(socket.SHUT_WR)
    assert not list(frames(other))


@claim("The newest velocity never waits behind old ones")
def test_the_newest_velocity_does_not_wait_behind_old_ones(ends):
    """While nothing reads, one topic keeps the newest and another all; they take turns."""
    sender = Sender(ends[0], {"/map": 1, "/cmd_vel": 1, "/odom": 1000}.get)
    sender.put(Frame("/map", "t", bytes(1_000_000), 0.0))  # more than the kernel takes
    put = [Frame(topic, "t", b"%d" % i, 0.0) for i in range(100) for topic in ("/odom", "/cmd_vel")]
    for frame in put:
        sender.put(frame)
    ends[1].settimeout(DEADLINE_S)
    _, *came = islice(frames(ends[1]), 1 + 101)
    assert put[-1] in came[:3]
    came.remove(put[-1])
    assert came == put[::2]
    sender.end()


@pytest.mark.parametrize(("age_s", "longest_s", "late"), [(0.6, 0.5, 1), (0.6, 0, 0), (0, 0.5, 0)])
def test_a_frame_is_late_beyond_the_limit_of_its_topic(age_s, longest_s, late):
    assert is_late(Frame("/a", "t", b"", time.monotonic() - age_s), longest_s) == bool(late)
