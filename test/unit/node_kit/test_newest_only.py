"""Sending without waiting, over a real TCP connection whose other side does not read."""

import select
import socket
import threading

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


def fill(sender, near):
    """Write until the kernel takes no more; how many messages that were."""
    for number in range(1_000_000):
        sender.write(message(number))
        if not select.select([], [near], [], 0)[1]:
            return number + 1
    raise AssertionError("the connection never became full")


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
    count = fill(sender, near)
    for number in range(count, count + 10_000):  # none of these waits
        sender.write(message(number))
    last = count + 10_000 - 1
    numbers = numbers_until(far, last)
    assert numbers == sorted(set(numbers))
    # What lay between is not sent any more, but for what both sides' buffers held.
    assert len(numbers) < count + 1000
    for number in range(100):  # from here on each arrives at once again
        sender.write(message(number))
        assert far.recv(SIZE, socket.MSG_WAITALL) == message(number)


def test_a_side_that_has_gone_is_an_error_in_the_end(connection):
    near, far = connection
    sender = NewestOnly(near, STOP, buffer_bytes=8192)
    fill(sender, near)
    far.close()
    with pytest.raises(OSError, match=r"."):
        for number in range(1_000_000):
            sender.write(message(number))
            select.select([], [near], [], DEADLINE_S)


# At which number of resends what is done, and what then arrives. None: free() is called.
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
    (2, 10, [0]),  # cut once more
    (0, None, []),
    (0, 11, [11]),
]


def play_cut(near, far, steps, monkeypatch, **options):
    """Do the steps; return what was reported meanwhile."""
    reported = []
    sender = NewestOnly(near, STOP, reported.append, **options)
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
    return reported


def test_after_a_cut_nothing_is_driven_before_the_release(connection, monkeypatch):
    assert play_cut(*connection, CUT, monkeypatch) == [True, False, True, False]


def test_a_connection_that_is_held_from_the_start_is_free_after_the_release(
    connection, monkeypatch
):
    steps = [(0, 1, []), (0, 2, []), (0, None, []), (0, 3, [3]), (0, None, [])]
    assert play_cut(*connection, steps, monkeypatch, held=True) == [False]


def test_without_a_stop_no_connection_is_taken_for_cut(connection, monkeypatch):
    near, far = connection
    monkeypatch.setattr(newest_only, "resends", lambda _: 100)
    sender = NewestOnly(near)
    sender.write(message(7))
    assert far.recv(SIZE, socket.MSG_WAITALL) == message(7)


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
        (1, [[1, 4, 1, 7]]),
        (2, [[12, 4, 2, 0], [8, 4, 2, 0]]),  # the last state; the other side closed its half
        (0, [[1, 0, 0, 0], [], [1], [1, 4], [1, 4, 9]]),  # short: the last byte may be anything
        (0, [[0, 4, 9, 0], [13, 4, 9, 0]]),  # there are no such states
        (0, [[1, 0, 9, 0], [1, 5, 9, 0], [0x5A] * 4]),  # resent without a loss cannot be
    ],
)
def test_an_answer_that_is_short_or_cannot_be_right_is_no_cut(resends, infos):
    for info in infos:
        assert newest_only.resends(Answering(bytes(info))) == resends, info


def test_a_connection_that_works_has_no_resends(connection):
    near, far = connection
    near.sendall(STOP)
    far.recv(SIZE, socket.MSG_WAITALL)
    assert newest_only.resends(near) == 0


FIRST, SECOND, THIRD, LAST = b"11111111", b"22222222", b"33333333", b"00000000"


class Near:
    """A socket that takes what the test says: so many bytes, or an error; after that, all."""

    def __init__(self, real, *answers):
        self._real, self._answers = real, list(answers)
        self.options, self.sent = [], b""

    def setsockopt(self, *option):
        self.options.append(option)

    def fileno(self):
        return self._real.fileno()

    def send(self, data, flags):
        answer = self._answers.pop(0) if self._answers else len(data)
        if isinstance(answer, Exception):
            raise answer
        self.sent += data[:answer]
        return min(answer, len(data))


@pytest.fixture
def real():
    """One end of a connection, which takes more."""
    near, far = socket.socketpair()
    with near, far:
        yield near


@pytest.fixture
def threads(monkeypatch):
    """The threads that were started: not yet run, as (target, whether it is a daemon)."""
    started = []

    class Thread:
        def __init__(self, target, daemon=False):
            self._about = (target, daemon)

        def start(self):
            started.append(self._about)

    monkeypatch.setattr(threading, "Thread", Thread)
    return started


def test_a_message_waits_for_no_answer_and_the_buffer_is_as_asked_for(real):
    near = Near(real)
    NewestOnly(near, buffer_bytes=8192)
    assert near.options == [
        (socket.IPPROTO_TCP, socket.TCP_NODELAY, 1),
        (socket.SOL_SOCKET, socket.SO_SNDBUF, 8192),
    ]


def test_one_thread_which_keeps_no_program_alive_sends_the_rest(real, threads):
    near = Near(real, 3)
    sender = NewestOnly(near)
    for one in (FIRST, SECOND, THIRD):
        sender.write(one)
    ((catch_up, is_daemon),) = threads
    assert is_daemon
    assert near.sent == FIRST[:3]
    catch_up()
    assert near.sent == FIRST + THIRD


@pytest.mark.parametrize("answers", [(), (BlockingIOError(), 1, BlockingIOError(), 1, 6)])
def test_a_message_is_never_torn(real, threads, answers):
    near = Near(real, *answers)
    sender = NewestOnly(near)
    sender.write(FIRST)
    assert len(threads) == (answers != ())  # what the kernel takes needs no thread
    for catch_up, _ in threads:
        catch_up()
    sender.write(SECOND)
    assert near.sent == FIRST + SECOND


def test_a_message_of_which_nothing_was_taken_gives_way_to_a_newer_one(real, threads):
    near = Near(real, BlockingIOError(), BlockingIOError(), 3)
    sender = NewestOnly(near)
    sender.write(FIRST)
    sender.write(SECOND)
    threads[0][0]()
    assert near.sent == SECOND


def test_a_connection_that_is_behind_again_gets_a_thread_again(real, threads):
    near = Near(real, 3, 5, 0)
    sender = NewestOnly(near)
    sender.write(FIRST)
    threads[0][0]()
    sender.write(SECOND)
    assert len(threads) == 2
    threads[1][0]()
    assert near.sent == FIRST + SECOND


def test_a_connection_that_is_cut_while_it_is_behind_gets_the_stop_alone(
    real, threads, monkeypatch
):
    monkeypatch.setattr(newest_only, "resends", lambda _: 0)
    near = Near(real, 3)
    sender = NewestOnly(near, LAST)
    sender.write(FIRST)
    sender.write(SECOND)
    monkeypatch.setattr(newest_only, "resends", lambda _: 2)
    sender.write(THIRD)
    sender.write(THIRD)
    threads[0][0]()
    assert near.sent == FIRST + LAST


def test_a_connection_that_is_closed_while_it_is_behind_ends_the_thread(real, threads):
    near = Near(real, 3, OSError("closed"))
    sender = NewestOnly(near)
    sender.write(FIRST)
    real.close()
    threads[0][0]()
    with pytest.raises(OSError, match="closed"):
        sender.write(SECOND)
