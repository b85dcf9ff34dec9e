"""Suspensions: noticed however short, and what was sent meanwhile is told from what is new."""

import signal
import time

import pytest

from node_kit import suspension
from node_kit.arming import SETTLING_S, Resumption
from node_kit.suspension import Suspensions


class TestResumption:
    """Times in seconds, as they would pass."""

    def test_nothing_is_old_or_held_without_a_suspension(self):
        resumption = Resumption()
        assert not resumption.notice(0, 5.0)
        assert not resumption.is_old(5.0)
        assert not resumption.holds(False, 5.0)
        assert not resumption.is_old(0.0)

    def test_any_other_number_is_new(self):
        resumption = Resumption()
        assert resumption.notice(3, 5.0)
        assert resumption.notice(1, 5.1)

    def test_each_suspension_is_new_once(self):
        resumption = Resumption()
        assert resumption.notice(1, 5.0)
        assert not resumption.notice(1, 5.1)
        assert resumption.notice(3, 5.2)

    def test_what_comes_at_once_is_old(self):
        resumption = Resumption()
        resumption.notice(1, 5.0)
        assert resumption.is_old(5.0)
        assert resumption.is_old(5.0 + 0.99 * SETTLING_S)
        assert not resumption.is_old(5.0 + SETTLING_S)

    def test_it_settles_for_a_quarter_of_a_second(self):
        assert SETTLING_S == 0.25  # less than joy2twist's ~joy_timeout, more than a full socket

    def test_nothing_moves_before_a_stop_that_is_not_old(self):
        resumption = Resumption()
        resumption.notice(1, 5.0)
        assert resumption.holds(False, 5.1)
        assert not resumption.holds(True, 5.2)  # a stop is always obeyed, but this one is old
        assert resumption.holds(False, 5.3)
        assert resumption.holds(False, 500.0)
        assert not resumption.holds(True, 500.1)
        assert not resumption.holds(False, 500.2)


@pytest.fixture
def clock(monkeypatch):
    """A clock that the test sets; no thread looks at it."""
    readings = [100.0]
    monkeypatch.setattr(suspension, "_now", lambda: readings[0])
    monkeypatch.setattr(Suspensions, "_beat", lambda self: None)
    before = signal.getsignal(signal.SIGCONT)
    yield readings
    signal.signal(signal.SIGCONT, before)


def test_a_clock_that_jumps_tells_of_one(clock):
    suspensions = Suspensions()
    clock[0] += 0.45  # busy
    assert suspensions.number() == 0
    clock[0] += 0.1
    assert suspensions.number() == 1
    assert suspensions.number() == 1


def test_a_stop_by_a_signal_is_noticed_however_short(clock):
    suspensions = Suspensions()
    clock[0] += 0.001
    signal.raise_signal(signal.SIGCONT)
    assert suspensions.number() == 1


def test_the_clock_and_the_signal_tell_of_one(clock):
    suspensions = Suspensions()
    clock[0] += 3.0
    assert suspensions.number() == 1
    clock[0] += 0.01
    signal.raise_signal(signal.SIGCONT)
    assert suspensions.number() == 1
    clock[0] += 0.2
    signal.raise_signal(signal.SIGCONT)
    assert suspensions.number() == 2


def test_one_in_the_middle_of_a_look_is_noticed(clock, monkeypatch):
    suspensions = Suspensions()
    with monkeypatch.context() as patch:
        notice = suspensions._notice
        patch.setattr(
            suspensions, "_notice", lambda now: (notice(now), clock.__setitem__(0, clock[0] + 3.0))
        )
        suspensions._look()
    assert suspensions.number() == 1


def test_the_thread_keeps_looking():
    before = signal.getsignal(signal.SIGCONT)
    suspensions = Suspensions()
    try:
        first = suspensions._looked
        deadline = time.monotonic() + 20.0
        while suspensions._looked == first:
            assert time.monotonic() < deadline
    finally:
        signal.signal(signal.SIGCONT, before)
