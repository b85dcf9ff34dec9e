"""Wait for conditions, with one deadline for all tests.

Deadlines exclude the time that a test and its programs spend waiting for a processor.
"""

import contextlib
import os
import time
from pathlib import Path

from tutorial_check.processes.cpu_clock import CpuClock, times_of

DEADLINE_S = 150.0  # generous: ten times a build, or the start of a dozen nodes
LONGEST_S = 4 * DEADLINE_S  # where the lost time is unknown, as in subprocess.run()
# What a busy machine may add to a required time, beside lost_s(): to the start or exit of a
# program, and to a message from a node to the next.
BUSY_S, HOP_S = 2.0, 0.3


def descendants(pid):
    """Return a process and its descendants, in any namespace and environment."""
    children = []
    with contextlib.suppress(OSError):  # ended meanwhile
        for path in Path(f"/proc/{pid}/task").glob("*/children"):  # of each thread
            children += path.read_text().split()
    return [pid, *(other for child in children for other in descendants(int(child)))]


def _times():
    """Return the times of this test's threads, the descendants of rostest or pytest."""
    return {id_: times for pid in descendants(os.getppid()) for id_, times in times_of(pid).items()}


_clock = CpuClock(set(), read=_times)


def lost_s():
    """Return the time [s] lost so far in waiting for a processor."""
    now = _clock.now()
    return time.monotonic() - now


class Stopwatch:
    """Measures how long something takes, without the time spent waiting for a processor."""

    def __init__(self):
        self._began_s, self._lost_s = time.monotonic(), lost_s()

    @property
    def lost_s(self):
        """The time [s] lost since the start, by which a test's bound grows."""
        return lost_s() - self._lost_s

    @property
    def took_s(self):
        """The time [s] since the start, without the lost time."""
        return time.monotonic() - self._began_s - self.lost_s


def tolerance():
    """Return a function that returns by how much [s] a time from now on may exceed its bound."""
    watch = Stopwatch()
    return lambda: HOP_S + watch.lost_s


def wait_for(condition, what, deadline_s=DEADLINE_S, seen=str):
    """Return the first true value of condition(); AssertionError naming `what` at the deadline.

    seen: returns what to show in that error. It checks 100 times a second in the first second, then
    20 times, and less often if condition() uses the processor: five sixths stay free.
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
