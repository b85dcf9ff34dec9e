"""What NewestOnly asks of its socket, and its thread, which here runs when a test says so."""

import socket
import threading

import pytest

from node_kit import newest_only
from node_kit.newest_only import NewestOnly

FIRST, SECOND, THIRD, STOP = b"11111111", b"22222222", b"33333333", b"00000000"


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
    """One end of a connection, with room for more."""
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


def test_a_message_does_not_wait_for_the_answer_to_the_last_one(real):
    near = Near(real)
    NewestOnly(near)
    assert near.options == [(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)]


def test_the_room_for_messages_on_their_way_is_as_asked_for(real):
    near = Near(real)
    NewestOnly(near, buffer_bytes=8192)
    assert near.options[1:] == [(socket.SOL_SOCKET, socket.SO_SNDBUF, 8192)]


def test_what_the_kernel_takes_needs_no_thread(real, threads):
    near = Near(real)
    NewestOnly(near).write(FIRST)
    assert near.sent == FIRST and threads == []


def test_one_thread_which_keeps_no_program_alive_sends_the_rest(real, threads):
    near = Near(real, 3)
    sender = NewestOnly(near)
    for one in (FIRST, SECOND, THIRD):
        sender.write(one)
    [(catch_up, is_daemon)] = threads
    assert is_daemon
    assert near.sent == FIRST[:3]
    catch_up()
    assert near.sent == FIRST + THIRD


def test_a_message_of_which_nothing_was_taken_gives_way_to_a_newer_one(real, threads):
    near = Near(real, BlockingIOError(), BlockingIOError(), 3)
    sender = NewestOnly(near)
    sender.write(FIRST)
    sender.write(SECOND)
    threads[0][0]()
    assert near.sent == SECOND


def test_who_is_behind_again_gets_a_thread_again(real, threads):
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
    sender = NewestOnly(near, STOP)
    sender.write(FIRST)
    sender.write(SECOND)
    monkeypatch.setattr(newest_only, "resends", lambda _: 2)
    sender.write(THIRD)
    sender.write(THIRD)
    threads[0][0]()
    assert near.sent == FIRST + STOP


def test_a_connection_that_is_closed_while_it_is_behind_ends_the_thread(real, threads):
    near = Near(real, 3, OSError("closed"))
    sender = NewestOnly(near)
    sender.write(FIRST)
    real.close()
    threads[0][0]()
    with pytest.raises(OSError, match="closed"):
        sender.write(SECOND)
