"""How much of the time that passes is the programs' own: Linux's /proc/*/task/*/schedstat.

On a machine with other things to do a program stands in line for a processor. That is no fault of
its author's. So deadlines go by a clock that nearly stands still meanwhile; and a program that has
done nothing for a while, although it could have, need not be waited for any longer.
"""

import contextlib
import os
import time

from tutorial_check.running import fields_of

SLOWEST = 0.05  # of real time: a deadline is at most twenty times as long
LOOKING = 0.05  # of the time at most goes into looking
IDLE = 0.1  # of one processor; who uses less only waits
STRAINED = 0.15  # of the time spent in line: then what was seen late says little
HOPELESS = 0.86
REACH_S = 30.0  # the kernel tells how long one stood in line only when that is over
STARVED_S = 0.5  # in line without a turn


def _threads(proc):
    for process in filter(str.isdigit, os.listdir(proc)):
        with contextlib.suppress(OSError):  # ended meanwhile; pathlib's glob would raise that
            yield from ((process, thread) for thread in os.listdir(f"{proc}/{process}/task"))


def times(proc="/proc"):
    """{thread: (its process, nanoseconds at work, nanoseconds in line)}, of all that can be seen."""
    found = {}
    for process, thread in _threads(proc):
        try:
            with open(f"{proc}/{process}/task/{thread}/schedstat") as file:
                at_work, in_line, _ = file.read().split()
        except (OSError, ValueError):
            continue  # ended meanwhile, or a kernel that does not count
        found[int(thread)] = int(process), int(at_work), int(in_line)
    return found


def is_ready(process, thread):
    """Whether it would work if it had a processor, or waits for the disk."""
    try:
        return fields_of(f"/proc/{process}/task/{thread}/stat")[0] in (b"R", b"D")
    except (OSError, IndexError):
        return False  # ended meanwhile


class Patience:
    """The programs' clock."""

    def __init__(self, ours, read=times, ready=is_ready, clock=time.monotonic):
        """ours: a set of process ids whose work is not the programs'; it may grow later."""
        self._me = os.getpid()
        self._ours, self._read, self._ready, self._clock = ours, read, ready, clock
        self._began_s = self._last_s = self._busy_s = clock()
        self._part = self._began_s, 0.0  # its beginning, and what had been lost by then
        self._last, self._changed_s = {}, {}
        self._next_s = self._lost_s = self._reach_s = 0.0

    def now(self):
        """The programs' time [s]; looks at them if that is due."""
        now_s = self._clock()
        if now_s >= self._next_s:
            self._look(now_s)
        return now_s - self._lost_s

    def _look(self, now_s):
        passed_s = now_s - self._last_s
        new = self._read()
        longest = worked = 0
        for thread, spent in new.items():
            process, at_work, in_line = spent
            before = self._last.get(thread, (process, 0, 0))
            longest = max(longest, in_line - before[2])
            if process not in self._ours:
                worked += at_work - before[1] + in_line - before[2]
            if thread not in self._last or spent != before:
                self._changed_s[thread] = now_s
        if self._last:
            self._reach_s = min(REACH_S, self._reach_s + passed_s)
            lost_s = min(longest / 1e9, (1 - SLOWEST) * self._reach_s)
            self._lost_s += lost_s
            self._reach_s -= lost_s
            if worked / 1e9 > IDLE * passed_s:
                self._busy_s = now_s - self._lost_s
        self._last, self._last_s = new, now_s
        self._next_s = now_s + max(0.05, (self._clock() - now_s) / LOOKING)

    def _ready_ones(self):
        """Threads in line. The master's, too: a program may wait for its answer."""
        for thread, (process, _, _) in self._last.items():
            if process != self._me and self._ready(process, thread):
                yield thread

    def idle_s(self):
        """For how long the programs have done nothing [s of theirs]; never, where nothing is counted."""
        idle_s = self.now() - self._busy_s if self._last else 0.0
        if idle_s > STARVED_S and any(self._ready_ones()):
            self._busy_s = self.now()
            return 0.0
        return idle_s

    def starved(self):
        """Whether one stands in line and has not had its turn for long."""
        now_s = self._clock()
        return any(now_s - self._changed_s[each] > STARVED_S for each in self._ready_ones())

    def crowd(self):
        """How many processes the programs are."""
        return len({process for process, _, _ in self._last.values()} - self._ours)

    def begin(self):
        """What begins now is looked at by itself."""
        self.now()
        self._part = self._clock(), self._lost_s

    def strained(self):
        """Whether the machine was so busy that what came late says little: ever, or just now."""
        return max(self._lost_share(), self._lost_share(*self._part)) > STRAINED

    def hopeless(self):
        """Whether it was so busy that what came late says nothing."""
        return self._lost_share() > HOPELESS

    def _lost_share(self, began_s=None, lost_s=0.0):
        began_s = self._began_s if began_s is None else began_s
        return (self._lost_s - lost_s) / max(1e-3, self._clock() - began_s)
