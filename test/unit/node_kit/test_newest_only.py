"""Sending without waiting, over a real TCP connection whose other side does not read."""

import select
import socket
import threading

import pytest

from node_kit import newest_only
from node_kit.newest_only import CUT_AFTER_RESENDS, NewestOnly
from tutorial_testing.waiting import wait_for

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


def test_what_is_written_arrives_at_once(connection):
    near, far = connection
    sender = NewestOnly(near, STOP, buffer_bytes=8192)
    for number in range(100):
        sender.write(message(number))
        assert far.recv(SIZE, socket.MSG_WAITALL) == message(number)


def test_a_side_that_does_not_read_gets_whole_messages_and_the_newest_one(connection):
    near, far = connection
    sender = NewestOnly(near, STOP, buffer_bytes=8192)
    count = fill(sender, near)
    for number in range(count, count + 10_000):  # none of these waits
        sender.write(message(number))
    last = count + 10_000 - 1
    numbers = numbers_until(far, last)
    assert numbers == sorted(set(numbers))
    # What lay between is not sent any more, but for what had room in the buffers of both sides.
    assert len(numbers) < count + 1000


def test_afterwards_messages_arrive_at_once_again(connection):
    near, far = connection
    sender = NewestOnly(near, STOP, buffer_bytes=8192)
    count = fill(sender, near)
    sender.write(message(count))
    numbers_until(far, count)
    before = threading.active_count()
    for number in range(100):
        sender.write(message(number))
        assert far.recv(SIZE, socket.MSG_WAITALL) == message(number)
    assert threading.active_count() <= before


def test_a_side_that_has_gone_is_an_error_in_the_end(connection):
    near, far = connection
    sender = NewestOnly(near, STOP, buffer_bytes=8192)
    fill(sender, near)
    far.close()
    with pytest.raises(OSError, match=r"."):
        for number in range(1_000_000):
            sender.write(message(number))
            select.select([], [near], [], DEADLINE_S)


def test_a_connection_closed_here_is_an_error(connection):
    near, _ = connection
    sender = NewestOnly(near, STOP, buffer_bytes=8192)
    near.close()
    with pytest.raises(OSError, match=r"."):
        sender.write(message(0))


# At which number of resends what is done, and what then arrives. None: free() is called.
CUT = [
    (0, 1, [1]),
    (1, 2, [2]),  # one lost packet
    (CUT_AFTER_RESENDS, 3, [0]),  # cut: a last stop
    (5, 4, []),
    (6, None, []),  # released, but still cut
    (7, 6, []),
    (0, 7, []),  # whole again, and still driving
    (0, None, []),  # released
    (0, 8, [8]),
    (CUT_AFTER_RESENDS, 10, [0]),  # cut once more
    (0, None, []),
    (0, 11, [11]),
]


def play_cut(near, far, steps, monkeypatch, **options):
    """Do the steps; what was told meanwhile."""
    told = []
    sender = NewestOnly(near, STOP, told.append, **options)
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
    return told


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
        assert (level, option) == (socket.IPPROTO_TCP, socket.TCP_INFO)
        return self._info[:length]


# struct tcp_info: state (1 is established), congestion state (4 is loss), resends, probes.
@pytest.mark.parametrize(
    ("info", "resends"),
    [
        ([1, 4, 3, 0, 9, 9], 3),
        ([1, 4, 1, 7], 1),
        ([1, 0, 0, 0], 0),
        ([12, 4, 2, 0], 2),  # the last state that there is
        ([8, 4, 2, 0], 2),  # the other side has closed its half
        ([], 0),
        ([1], 0),
        ([1, 4], 0),
        ([1, 4, 9], 0),  # short: the last byte may be anything
        ([0, 4, 9, 0], 0),  # there is no state 0
        ([13, 4, 9, 0], 0),
        ([1, 0, 9, 0], 0),  # resent without a loss: that cannot be
        ([1, 5, 9, 0], 0),  # there is no such state of congestion
        ([0x5A, 0x5A, 0x5A, 0x5A], 0),
    ],
)
def test_an_answer_that_is_short_or_cannot_be_right_is_no_cut(info, resends):
    assert newest_only.resends(Answering(bytes(info))) == resends


def test_the_question_has_the_length_that_an_emulated_processor_knows():
    lengths = []

    class Asked(Answering):
        def getsockopt(self, level, option, length):
            lengths.append(length)
            return super().getsockopt(level, option, length)

    newest_only.resends(Asked(bytes(4)))
    assert lengths == [4]


def test_a_connection_that_works_has_no_resends(connection):
    near, far = connection
    near.sendall(STOP)
    far.recv(SIZE, socket.MSG_WAITALL)
    assert newest_only.resends(near) == 0


def test_a_connection_is_cut_after_the_second_resend_as_the_first_may_be_one_lost_packet():
    assert CUT_AFTER_RESENDS == 2


class Scripted:
    """A socket whose send() does what the test says: takes so many bytes, or raises."""

    def __init__(self, near, *answers):
        self._near, self._answers = near, list(answers)
        self.sent = b""

    def setsockopt(self, *_):
        pass

    def fileno(self):
        return self._near.fileno()

    def send(self, data, flags):
        assert flags == socket.MSG_DONTWAIT
        answer = self._answers.pop(0) if self._answers else len(data)
        if isinstance(answer, Exception):
            raise answer
        self.sent += data[:answer]
        return min(answer, len(data))


def wait_until_caught_up(sender):
    wait_for(lambda: not sender._behind, "end of the thread", DEADLINE_S)


@pytest.mark.parametrize(
    "answers",
    [
        (20,),  # a part, and the thread sends the rest
        (20, BlockingIOError(), 20),
        (BlockingIOError(),),
        (BlockingIOError(), 1, BlockingIOError(), 1, 49),
    ],
)
def test_a_message_is_never_torn(connection, answers):
    near, _ = connection
    scripted = Scripted(near, *answers)
    sender = NewestOnly(scripted)
    sender.write(message(1))
    wait_until_caught_up(sender)
    assert scripted.sent == message(1)
    sender.write(message(2))
    assert scripted.sent == message(1) + message(2)


def test_the_begun_message_is_finished_before_the_newest_one(connection):
    near, far = connection
    near.setblocking(False)
    with pytest.raises(BlockingIOError):
        while True:
            near.send(bytes(65536))
    scripted = Scripted(near, 20)
    sender = NewestOnly(scripted)
    for number in (1, 2, 3):  # the thread waits for room in the full connection
        sender.write(message(number))
    while sender._behind:
        far.recv(65536)
    assert scripted.sent == message(1) + message(3)


def test_after_an_error_in_the_thread_the_next_write_tells_of_it(connection):
    near, _ = connection
    scripted = Scripted(near, 20, ConnectionResetError("gone"), ConnectionResetError("gone"))
    sender = NewestOnly(scripted)
    sender.write(message(1))
    wait_until_caught_up(sender)
    with pytest.raises(ConnectionResetError):
        sender.write(message(2))
