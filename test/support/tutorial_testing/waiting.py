"""Waiting for what a test is about, with one deadline for all.

A deadline counts only time in which the machine gave a test and its programs their turn.
"""

import contextlib
import os
import time
from pathlib import Path

from tutorial_check.processes.cpu_clock import CpuClock, times_of

DEADLINE_S = 150.0  # generous: ten times what a build takes, or the start of a dozen nodes
LONGEST_S = 4 * DEADLINE_S  # for what cannot know what it lost, such as subprocess.run()
# What a busy machine may add to a time that is demanded, beside lost_s(): of a program that starts
# or exits, and of a message from one node to the next.
BUSY_S, HOP_S = 2.0, 0.3


def descendants(pid):
    """Return a process and its descendants, in any namespace and environment."""
    children = []
    with contextlib.suppress(OSError):  # ended meanwhile
        for each in Path(f"/proc/{pid}/task").glob("*/children"):  # each thread has its own
            children += each.read_text().split()
    return [pid, *(one for child in children for one in descendants(int(child)))]


def _times():
    """Return those of the threads that this test has: below rostest's or pytest's process."""
    return {id_: times for pid in descendants(os.getppid()) for id_, times in times_of(pid).items()}


_clock = CpuClock(set(), read=_times)


def lost_s():
    """Return the time [s] so far that waits for a processor have cost."""
    now = _clock.now()
    return time.monotonic() - now


class Stopwatch:
    """Measures how long something takes, without the waits for a processor meanwhile."""

    def __init__(self):
        self._began_s, self._lost_s = time.monotonic(), lost_s()

    @property
    def lost_s(self):
        """The time [s] that was lost since it began: by so much a bound of the test grows."""
        return lost_s() - self._lost_s

    @property
    def took_s(self):
        """The time [s] since it began, but for what was lost."""
        return time.monotonic() - self._began_s - self.lost_s


def tolerance():
    """Return a function: by how much [s] what is measured from now on may exceed its bound."""
    watch = Stopwatch()
    return lambda: HOP_S + watch.lost_s


def wait_for(condition, what, deadline_s=DEADLINE_S, seen=str):
    """Return the first true value of condition(); AssertionError naming `what` at the deadline.

    seen: returns what is seen in its place. It asks 100 times a second in the first second, then 20
    times; and less often where a question takes processor time here, so that it leaves five sixths
    of it.
    """
    begin = _clock.now()
    while True:
        worked_s = time.thread_time()
        value = condition()
        if value:
            return value
        waited_s = _clock.now() - begin
        worked_s = time.thread_time() - worked_s
        if waited_s > deadline_s:
            raise AssertionError(f"no {what} within {deadline_s:.0f} s\n{seen()}")
        time.sleep(max(0.01 if waited_s < 1.0 else 0.05, 5 * worked_s))
