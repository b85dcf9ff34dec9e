"""The programs' clock: it slows down while they stand in line for a processor."""

import os

import pytest

from tutorial_check.patience import SLOWEST, Patience, times

OURS, THEIRS = 1, 2
MS = 1_000_000  # nanoseconds


class Machine:
    """A clock, and one thread of the checker's and one of a program's."""

    def __init__(self):
        self.now_s = 100.0
        self.threads = {OURS: [0, 0], THEIRS: [0, 0]}
        self.is_ready = False

    def read(self):
        return {thread: (thread, *spent) for thread, spent in self.threads.items()}

    def ready(self, process, thread):
        return self.is_ready and thread == THEIRS

    def clock(self):
        return self.now_s

    def pass_time(self, passed_s, worked_ms=0, in_line_ms=0, thread=THEIRS):
        self.now_s += passed_s
        self.threads[thread][0] += worked_ms * MS
        self.threads[thread][1] += in_line_ms * MS


@pytest.fixture
def machine():
    return Machine()


@pytest.fixture
def patience(machine):
    made = Patience({OURS}, machine.read, machine.ready, machine.clock)
    made.now()
    return made


def test_alone_it_is_the_clock_on_the_wall(machine, patience):
    began_s = patience.now()
    machine.pass_time(1.0, worked_ms=900)
    assert patience.now() - began_s == pytest.approx(1.0)
    assert not patience.strained()


def test_what_was_spent_in_line_does_not_count(machine, patience):
    began_s = patience.now()
    machine.pass_time(1.0, worked_ms=300, in_line_ms=700)
    assert patience.now() - began_s == pytest.approx(0.3)
    assert patience.strained()
    assert not patience.hopeless()


def test_the_checker_s_own_waiting_counts_as_well(machine, patience):
    began_s = patience.now()
    machine.pass_time(1.0, in_line_ms=500, thread=OURS)
    assert patience.now() - began_s == pytest.approx(0.5)


def test_it_never_stands_still(machine, patience):
    began_s = patience.now()
    machine.pass_time(10.0, in_line_ms=100_000)  # ten threads at once
    assert patience.now() - began_s == pytest.approx(10.0 * SLOWEST)
    assert patience.hopeless()


def test_idle_is_who_neither_works_nor_stands_in_line(machine, patience):
    machine.pass_time(1.0, worked_ms=500)
    assert patience.idle_s() == pytest.approx(0.0)
    machine.pass_time(1.0, worked_ms=20)
    machine.pass_time(1.0, worked_ms=900, thread=OURS)
    assert patience.idle_s() == pytest.approx(2.0)
    machine.pass_time(1.0, in_line_ms=500)
    assert patience.idle_s() == pytest.approx(0.0)


def test_what_is_told_late_counts_for_the_time_before(machine, patience):
    began_s = patience.now()
    for _ in range(4):
        machine.pass_time(1.0)
        patience.now()
    machine.pass_time(1.0, in_line_ms=4000)
    assert patience.now() - began_s == pytest.approx(1.0)


def test_who_stands_in_line_is_not_idle_though_nothing_is_counted_yet(machine, patience):
    machine.is_ready = True
    for _ in range(5):
        machine.pass_time(1.0)
        assert patience.idle_s() == pytest.approx(0.0)
    assert patience.starved()
    machine.pass_time(0.1, worked_ms=5)
    patience.now()
    assert not patience.starved()


def test_where_nothing_is_counted_nobody_is_idle_and_time_is_time(machine):
    patience = Patience({OURS}, dict, machine.ready, machine.clock)
    began_s = patience.now()
    machine.pass_time(5.0)
    assert patience.now() - began_s == pytest.approx(5.0)
    assert patience.idle_s() == 0.0


def test_this_process_is_among_those_seen():
    assert {process for process, _, _ in times().values()} >= {os.getpid()}


def test_one_that_ends_while_it_is_looked_at_is_left_out(tmp_path):
    (tmp_path / "7").mkdir()  # its threads have gone
    (tmp_path / "8" / "task" / "81").mkdir(parents=True)  # this one in the very last moment
    (tmp_path / "9" / "task" / "9").mkdir(parents=True)
    (tmp_path / "9" / "task" / "9" / "schedstat").write_text("5 6 7\n")
    (tmp_path / "uptime").write_text("1 2\n")
    assert times(tmp_path) == {9: (9, 5, 6)}


def test_a_short_strain_after_a_long_calm_is_seen(machine, patience):
    machine.pass_time(80.0, worked_ms=10_000)
    patience.begin()
    machine.pass_time(3.0, worked_ms=1_000, in_line_ms=1_500)
    patience.now()
    assert patience.strained()
    assert not patience.hopeless()


def test_a_calm_after_a_strain_is_still_strained(machine, patience):
    machine.pass_time(3.0, worked_ms=1_000, in_line_ms=1_500)
    patience.begin()
    machine.pass_time(1.0, worked_ms=100)
    patience.now()
    assert patience.strained()
