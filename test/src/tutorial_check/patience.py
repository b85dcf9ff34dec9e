"""How much of the time that passes is the programs' own: Linux's /proc/*/task/*/schedstat.

On a machine with other things to do a program stands in line for a processor. That is no fault of
its author's. So deadlines go by a clock that nearly stands still meanwhile; and a program that has
done nothing for a while, although it could have, need not be waited for any longer.
"""

import time
from pathlib import Path

SLOWEST = 0.2  # of real time: a deadline is at most five times as long
LOOKING = 0.05  # of the time at most goes into looking
IDLE = 0.1  # of one processor; who uses less only waits
STRAINED = 0.15  # of the time spent in line: then what was seen late says little


def times(proc="/proc"):
    """{thread: (its process, nanoseconds at work, nanoseconds in line)}, of all that can be seen."""
    found = {}
    for path in Path(proc).glob("[0-9]*/task/[0-9]*/schedstat"):
        try:
            at_work, in_line, _ = path.read_text().split()
        except (OSError, ValueError):
            continue  # ended meanwhile, or a kernel that does not count
        found[int(path.parts[-2])] = int(path.parts[-4]), int(at_work), int(in_line)
    return found


class Patience:
    """The programs' clock."""

    def __init__(self, ours, read=times, clock=time.monotonic):
        """ours: a set of process ids whose work is not the programs'; it may grow later."""
        self._ours, self._read, self._clock = ours, read, clock
        self._began_s = self._last_s = self._busy_s = clock()
        self._last, self._next_s, self._lost_s = {}, 0.0, 0.0

    def now(self):
        """The programs' time [s]; looks at them if that is due."""
        now_s = self._clock()
        if now_s >= self._next_s:
            self._look(now_s)
        return now_s - self._lost_s

    def _look(self, now_s):
        passed_s = now_s - self._last_s
        new = self._read()
        waited = worked = 0
        for thread, (process, at_work, in_line) in new.items():
            _, worked_before, waited_before = self._last.get(thread, (0, 0, 0))
            waited += max(0, in_line - waited_before)
            if process not in self._ours:
                worked += max(0, at_work - worked_before) + max(0, in_line - waited_before)
        if self._last:
            self._lost_s += min(waited / 1e9, (1 - SLOWEST) * passed_s)
            if worked / 1e9 > IDLE * passed_s:
                self._busy_s = now_s - self._lost_s
        self._last, self._last_s = new, now_s
        self._next_s = now_s + max(0.05, (self._clock() - now_s) / LOOKING)

    def idle_s(self):
        """For how long the programs have done nothing [s of theirs]; never, where nothing is counted."""
        return self.now() - self._busy_s if self._last else 0.0

    def strained(self):
        """Whether the machine was so busy that what came late says little."""
        return self._lost_s > STRAINED * (self._clock() - self._began_s)
