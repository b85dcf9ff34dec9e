"""The programs' clock runs slower while they wait for a processor."""

import os

import pytest

from tutorial_check.processes.cpu_clock import SLOWEST, CpuClock, times
from tutorial_testing.claims import claim

pytestmark = claim(
    "A program that could work and does not is not waited for; one without a processor is"
)
OURS, THEIRS = 1, 2
MS = 1_000_000  # nanoseconds


class Machine:
    """A clock with a thread of the checker and a thread of a program."""

    def __init__(self):
        self.now_s, self.is_ready = 100.0, False
        self.threads = {OURS: [0, 0], THEIRS: [0, 0]}
        self.clock = CpuClock({OURS}, self.read, self.ready, lambda: self.now_s)
        self.began_s = self.clock.now()

    def read(self):
        return {thread: (thread, *spent) for thread, spent in self.threads.items()}

    def ready(self, process, thread):
        return self.is_ready and thread == THEIRS

    def passes(self, passed_s, worked_ms=0, ready_ms=0, thread=THEIRS):
        """Let time pass; return the programs' time since the beginning."""
        self.now_s += passed_s
        self.threads[thread][0] += worked_ms * MS
        self.threads[thread][1] += ready_ms * MS
        return self.clock.now() - self.began_s


@claim("Deadlines go by the time that the programs had")
@pytest.mark.parametrize(("passed", "programs_s", "busy", "overloaded"), [
    ((1.0, 900, 0), 1.0, False, False),
    ((1.0, 300, 700), 0.3, True, False),
    ((1.0, 0, 500, OURS), 0.5, True, False),  # the checker's own waiting counts as well
    ((10.0, 0, 100_000), 10.0 * SLOWEST, True, True),  # ten threads at once; the clock never stops
])  # fmt: skip
def test_time_without_a_processor_does_not_count(passed, programs_s, busy, overloaded):
    machine = Machine()
    assert machine.passes(*passed) == pytest.approx(programs_s)
    assert (machine.clock.busy(), machine.clock.overloaded()) == (busy, overloaded)


def test_programs_are_idle_that_neither_work_nor_wait_for_a_processor():
    machine, idle_s = Machine(), []
    for passed in ((500,), (20,), (900, 0, OURS), (0, 500)):
        machine.passes(1.0, *passed)
        idle_s.append(machine.clock.idle_s())
    assert idle_s == pytest.approx([0.0, 1.0, 2.0, 0.0])


def test_a_ready_program_is_not_idle_but_starved():
    machine = Machine()
    machine.is_ready = True
    for _ in range(5):
        machine.passes(1.0)
        assert machine.clock.idle_s() == pytest.approx(0.0)
    assert machine.clock.starved()
    machine.passes(0.1, worked_ms=5)
    assert not machine.clock.starved()


def test_linux_counts_this_process():
    process, at_work, _ = times()[os.getpid()]
    assert process == os.getpid() and at_work > 0
