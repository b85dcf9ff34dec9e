"""Sending over a real TCP connection without blocking."""

import select
import socket

import pytest

from node_kit.io import newest_only
from node_kit.io.newest_only import NewestOnly
from tutorial_testing.claims import claim

pytestmark = claim(
    "A side that does not read gets the newest message; one that was cut is driven only after a "
    "release"
)
SIZE = 52  # [bytes] a Twist on the wire
DEADLINE_S = 20.0
STOP = bytes(SIZE)


@pytest.fixture
def connection():
    """Two ends of a TCP connection; the second has a small receive buffer."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        server.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        near = socket.create_connection(server.getsockname())
        far, _ = server.accept()
    far.settimeout(DEADLINE_S)
    with near, far:
        yield near, far


def message(number):
    return number.to_bytes(4, "little") * (SIZE // 4)


def numbers_until(far, last):
    """Read whole messages up to the number last; return their numbers."""
    data, numbers = b"", []
    while not numbers or numbers[-1] != last:
        data += far.recv(65536)
        while len(data) >= SIZE:
            numbers.append(int.from_bytes(data[:4], "little"))
            assert data[:SIZE] == message(numbers[-1])  # never parts of two messages
            data = data[SIZE:]
    return numbers


def test_a_side_that_does_not_read_gets_whole_messages_and_the_newest_one(connection):
    near, far = connection
    sender = NewestOnly(near, STOP, buffer_bytes=8192)
    for number in range(20_000):  # more than both buffers hold; no write blocks
        sender.write(message(number))
    numbers = numbers_until(far, 19_999)
    assert numbers == sorted(set(numbers))
    assert len(numbers) < 10_000  # the messages between are dropped
    for number in range(100):  # from here on each arrives at once
        sender.write(message(number))
        assert far.recv(SIZE, socket.MSG_WAITALL) == message(number)
    assert near.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY)
    assert near.getsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF) == 2 * 8192  # doubled by Linux


# (number of resends, number of the message or None for free(), numbers of what then arrives)
CUT = [
    (0, 1, [1]),
    (1, 2, [2]),  # one lost packet
    (2, 3, [0]),  # cut: a last stop
    (5, 4, []),
    (6, None, []),  # released, but still cut
    (7, 6, []),
    (0, 7, []),  # restored, and still driving
    (0, None, []),  # released
    (0, 8, [8]),
]
HELD = [(0, 1, []), (0, 2, []), (0, None, []), (0, 3, [3]), (0, None, [])]


@pytest.mark.parametrize(("steps", "stop", "held", "reports"), [
    (CUT, STOP, False, [True, False]),
    (HELD, STOP, True, [False]),
    ([(100, 7, [7])], None, False, []),  # without a stop message no connection counts as cut
])  # fmt: skip
def test_a_cut_or_held_connection_is_driven_only_after_the_release(
    connection, monkeypatch, steps, stop, held, reports
):
    near, far = connection
    reported = []
    sender = NewestOnly(near, stop, reported.append, held=held)
    for resends, number, arriving in steps:
        monkeypatch.setattr(newest_only, "resends", lambda _, count=resends: count)
        if number is None:
            sender.free()
        else:
            sender.write(message(number))
        for expected in arriving:
            data = far.recv(SIZE, socket.MSG_WAITALL)
            assert int.from_bytes(data[:4], "little") == expected
        assert not select.select([far], [], [], 0)[0], number
    assert reported == reports


class Answering:
    """A socket that answers TCP_INFO with the bytes given."""

    def __init__(self, info):
        self._info = info

    def getsockopt(self, level, option, length):
        # An emulated processor supports only options of 4 bytes.
        assert (level, option, length) == (socket.IPPROTO_TCP, socket.TCP_INFO, 4)
        return self._info[:length]


# struct tcp_info: state (1 is established), congestion state (4 is loss), resends, probes.
@pytest.mark.parametrize(("resends", "infos"), [
    (3, [[1, 4, 3, 0, 9, 9]]),
    (2, [[12, 4, 2, 0], [8, 4, 2, 0]]),  # the last state; one in which the other side has closed
    (0, [[1, 0, 0, 0], [], [1], [1, 4], [1, 4, 9]]),  # short: the last byte may be anything
    (0, [[0, 4, 9, 0], [13, 4, 9, 0]]),  # states that do not exist
    (0, [[1, 0, 9, 0], [1, 5, 9, 0], [0x5A] * 4]),  # a resend without a loss is impossible
])  # fmt: skip
def test_an_answer_that_is_short_or_cannot_be_right_is_no_cut(resends, infos):
    for info in infos:
        assert newest_only.resends(Answering(bytes(info))) == resends, info


def test_a_connection_that_is_cut_while_it_is_behind_gets_the_stop_last(connection, monkeypatch):
    near, far = connection
    sender = NewestOnly(near, STOP, buffer_bytes=8192)
    for number in range(1, 20_000):
        sender.write(message(number))
    monkeypatch.setattr(newest_only, "resends", lambda _: 2)
    for number in (20_000, 20_001):
        sender.write(message(number))
    assert 19_999 not in numbers_until(far, 0)
    assert not select.select([far], [], [], 0)[0]


def test_a_connection_that_was_closed_while_it_was_behind_is_an_error_in_the_end(connection):
    near, far = connection
    sender = NewestOnly(near, STOP, buffer_bytes=8192)
    for number in range(20_000):
        sender.write(message(number))
    far.close()
    with pytest.raises(OSError, match=r"."):
        for number in range(1_000_000):
            sender.write(message(number))
            select.select([], [near], [], DEADLINE_S)
