"""A program is blamed for working without end only if it had the processor, and we ended it."""

import os
import time
from types import SimpleNamespace

import pytest

from tutorial_check import running


@pytest.fixture
def program():
    made = running.Program(SimpleNamespace(pid=os.getpid()), "this one")
    made.was_stopped = True
    return made


def test_one_that_had_more_processor_time_than_any_start_needs(program, monkeypatch):
    monkeypatch.setattr(running, "SPINNING_S", time.process_time() / 2)
    assert not program.spins  # nobody has looked yet
    program.note_work()
    assert program.spins


def test_not_one_that_had_less(program, monkeypatch):
    monkeypatch.setattr(running, "SPINNING_S", time.process_time() + 3600)
    program.note_work()
    assert not program.spins


def test_not_one_that_ended_by_itself(program, monkeypatch):
    monkeypatch.setattr(running, "SPINNING_S", 0.0)
    program.was_stopped = False
    program.note_work()
    assert not program.spins


def test_of_one_that_has_gone_nothing_is_learnt():
    gone = running.Program(SimpleNamespace(pid=2**22 + 1), "gone")  # beyond every process id
    gone.note_work()
    assert not gone.spins
