"""Sending without waiting, over a real TCP connection whose other side does not read."""

import select
import socket
from types import SimpleNamespace

import pytest

from node_kit import newest_only
from node_kit.newest_only import NewestOnly

SIZE = 52  # of a Twist on the wire
DEADLINE_S = 20.0
STOP = bytes(SIZE)


@pytest.fixture
def connection():
    """Two ends of a TCP connection; the second one is slow to accept data."""
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
    """Read whole messages up to the one with the number last; their numbers."""
    data, numbers = b"", []
    while not numbers or numbers[-1] != last:
        data += far.recv(65536)
        while len(data) >= SIZE:
            numbers.append(int.from_bytes(data[:4], "little"))
            assert data[:SIZE] == message(numbers[-1])  # never a part of one, then another
            data = data[SIZE:]
    return numbers


def test_a_side_that_does_not_read_gets_whole_messages_and_the_newest_one(connection):
    near, far = connection
    sender = NewestOnly(near, STOP, buffer_bytes=8192)
    for number in range(20_000):  # more than both sides' buffers hold; none of these waits
        sender.write(message(number))
    numbers = numbers_until(far, 19_999)
    assert numbers == sorted(set(numbers))
    assert len(numbers) < 10_000  # what lay between is not sent any more
    for number in range(100):  # from here on each arrives at once again
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
    (0, 7, []),  # whole again, and still driving
    (0, None, []),  # released
    (0, 8, [8]),
]
HELD = [(0, 1, []), (0, 2, []), (0, None, []), (0, 3, [3]), (0, None, [])]


@pytest.mark.parametrize(
    ("steps", "stop", "held", "reports"),
    [
        (CUT, STOP, False, [True, False]),
        (HELD, STOP, True, [False]),
        ([(100, 7, [7])], None, False, []),  # without a stop no connection counts as cut
    ],
)
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
    """A socket that answers the question for TCP_INFO with bytes of the test's choice."""

    def __init__(self, info):
        self._info = info

    def getsockopt(self, level, option, length):
        # An emulated processor knows options of 4 bytes only.
        assert (level, option, length) == (socket.IPPROTO_TCP, socket.TCP_INFO, 4)
        return self._info[:length]


# struct tcp_info: state (1 is established), congestion state (4 is loss), resends, probes.
@pytest.mark.parametrize(
    ("resends", "infos"),
    [
        (3, [[1, 4, 3, 0, 9, 9]]),
        (2, [[12, 4, 2, 0], [8, 4, 2, 0]]),  # the last state; the other side closed its half
        (0, [[1, 0, 0, 0], [], [1], [1, 4], [1, 4, 9]]),  # short: the last byte may be anything
        (0, [[0, 4, 9, 0], [13, 4, 9, 0]]),  # there are no such states
        (0, [[1, 0, 9, 0], [1, 5, 9, 0], [0x5A] * 4]),  # resent without a loss cannot be
    ],
)
def test_an_answer_that_is_short_or_cannot_be_right_is_no_cut(resends, infos):
    for info in infos:
        assert newest_only.resends(Answering(bytes(info))) == resends, info


FIRST, SECOND, THIRD, LAST = b"11111111", b"22222222", b"33333333", b"00000000"
FULL = BlockingIOError()


class Near:
    """A socket that takes what the test says: so many bytes, or an error; after that, all."""

    def __init__(self, real, *answers):
        self.fileno, self.setsockopt = real.fileno, real.setsockopt
        self._answers, self.sent = list(answers), b""

    def send(self, data, flags):
        answer = self._answers.pop(0) if self._answers else len(data)
        if isinstance(answer, Exception):
            raise answer
        self.sent += data[:answer]
        return min(answer, len(data))


@pytest.fixture
def threads(monkeypatch):
    """The threads that were started, as functions that the test runs."""
    started = []

    def thread(target, daemon):
        assert daemon  # it keeps no program alive
        return SimpleNamespace(start=lambda: started.append(target))

    monkeypatch.setattr(newest_only.threading, "Thread", thread)
    return started


@pytest.mark.parametrize(
    ("answers", "before", "after", "sent", "count"),
    [
        ([3], [FIRST, SECOND, THIRD], [], FIRST + THIRD, 1),  # of those that wait the newest
        ([], [FIRST], [SECOND], FIRST + SECOND, 0),  # what the kernel takes needs no thread
        ([FULL, 1, FULL, 1, 6], [FIRST], [SECOND], FIRST + SECOND, 1),  # never torn
        ([3, 5, 0], [FIRST], [SECOND], FIRST + SECOND, 2),  # behind again: a thread again
    ],
)
def test_a_thread_sends_what_the_kernel_does_not_take(
    connection, threads, answers, before, after, sent, count
):
    near = Near(connection[0], *answers)
    sender = NewestOnly(near)
    for one in before:
        sender.write(one)
    done = len(threads)
    assert done <= 1
    for catch_up in threads:
        catch_up()
    for one in after:
        sender.write(one)
    for catch_up in threads[done:]:
        catch_up()
    assert (near.sent, len(threads)) == (sent, count)


def test_a_connection_that_is_cut_while_it_is_behind_gets_the_stop_alone(
    connection, threads, monkeypatch
):
    monkeypatch.setattr(newest_only, "resends", lambda _: 0)
    near = Near(connection[0], 3)
    sender = NewestOnly(near, LAST)
    sender.write(FIRST)
    sender.write(SECOND)
    monkeypatch.setattr(newest_only, "resends", lambda _: 2)
    sender.write(THIRD)
    sender.write(THIRD)
    threads[0]()
    assert near.sent == FIRST + LAST


def test_a_connection_that_is_closed_while_it_is_behind_ends_the_thread(connection, threads):
    near = Near(connection[0], 3, OSError("closed"))
    sender = NewestOnly(near)
    sender.write(FIRST)
    connection[0].close()
    threads[0]()
    with pytest.raises(OSError, match="closed"):
        sender.write(SECOND)
