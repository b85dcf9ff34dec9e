"""Every suspension is noticed, however short, and commands sent meanwhile are ignored."""

import signal

import pytest

from node_kit.io import suspension
from node_kit.io.suspension import Suspensions


@pytest.fixture
def clock(monkeypatch):
    """A clock that the test sets, with no thread that reads it."""
    shown = [100.0]  # the last value stays
    monkeypatch.setattr(suspension, "_now", lambda: shown.pop(0) if shown[1:] else shown[0])
    monkeypatch.setattr(Suspensions, "_beat", lambda self: None)
    before = signal.getsignal(signal.SIGCONT)
    yield shown
    signal.signal(signal.SIGCONT, before)


@pytest.mark.parametrize(
    "steps",  # (time that passes [s], whether SIGCONT comes then, suspensions so far)
    [
        [(0.45, False, 0), (0.1, False, 1), (0.0, False, 1)],  # busy, then suspended
        [(0.001, True, 1)],  # a stop by a signal, which is noticed however short
        [(3.0, False, 1), (0.01, True, 1), (0.2, True, 2)],  # clock and signal: one suspension
    ],
)
def test_suspensions_are_counted_once(clock, steps):
    suspensions = Suspensions()
    for passed_s, is_continued, number in steps:
        clock[0] += passed_s
        if is_continued:
            signal.raise_signal(signal.SIGCONT)
        assert suspensions.number() == number
    clock.append(clock[0] + 3.0)  # during a check
    suspensions._look()
    assert suspensions.number() == number + 1
