"""The programs' clock: real time without waits for a CPU (/proc/*/task/*/schedstat).

On a busy machine programs wait for a CPU, which is not their authors' fault. So deadlines use a
clock that nearly stops during such waits. A program that is idle although it could run ends a wait.

The tests of all packages wait by it, too, through tutorial_testing.waiting: CpuClock and times_of()
are public.
"""

from __future__ import annotations

import contextlib
import os
import time
from typing import Callable, Dict, Iterator, Tuple

SLOWEST = 0.05  # of real time: a deadline takes at most twenty times as long
LOOKING = 0.05  # largest share of the time that looking may take
IDLE = 0.1  # [CPUs] programs that use less only wait
BUSY = 0.15  # share of the time spent waiting for a CPU: a late answer proves little
OVERLOADED = 0.86  # it proves nothing
REACH_S = 30.0  # the kernel counts a thread's wait only when it is over
STARVED_S = 0.5  # ready, but not run

# {thread: (its process, ns running, ns ready but not run)}
Times = Dict[int, Tuple[int, int, int]]


def fields_of(stat: str) -> list[bytes]:
    """Return the fields of /proc/*/stat after the name, which may be any bytes. Raises OSError."""
    with open(stat, "rb") as file:
        return file.read().rsplit(b")", 1)[1].split()


def times() -> Times:
    processes = map(int, filter(str.isdigit, os.listdir("/proc")))
    return {thread: spent for process in processes for thread, spent in times_of(process).items()}


def times_of(process: int) -> Times:
    """Return the times of a process's threads; none if it has ended."""
    threads: Times = {}
    with contextlib.suppress(OSError):  # it has ended
        for thread in os.listdir(f"/proc/{process}/task"):
            # It may have ended, or the kernel does not count.
            with contextlib.suppress(OSError, ValueError):
                with open(f"/proc/{process}/task/{thread}/schedstat") as file:
                    at_work, ready, _ = file.read().split()
                threads[int(thread)] = process, int(at_work), int(ready)
    return threads


def is_ready(process: int, thread: int) -> bool:
    """Return whether a thread waits for a CPU or for the disk."""
    with contextlib.suppress(OSError, IndexError):  # it has ended
        return fields_of(f"/proc/{process}/task/{thread}/stat")[0] in (b"R", b"D")
    return False


class CpuClock:
    """The programs' clock."""

    def __init__(
        self,
        ours: set[int],
        read: Callable[[], Times] = times,
        ready: Callable[[int, int], bool] = is_ready,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """ours: ids of processes that do not count as programs; the set may grow later."""
        self._ours, self._read, self._ready, self._clock = ours, read, ready, clock
        # (start, time lost until then): since the beginning, and since begin().
        self._whole_and_part = [(clock(), 0.0)]
        self._last_s = self._worked_s = clock()
        self._last: Times = {}
        self._changed_s: dict[int, float] = {}
        self._next_s = self._lost_s = self._reach_s = 0.0

    def now(self) -> float:
        """Return the programs' time [s]; look at the programs if that is due."""
        now_s = self._clock()
        if now_s >= self._next_s:
            self._look(now_s)
        return now_s - self._lost_s

    def _look(self, now_s: float) -> None:
        passed_s, new = now_s - self._last_s, self._read()
        longest = worked = 0
        for thread, (process, at_work, ready) in new.items():
            before = self._last.get(thread, (process, 0, 0))
            longest = max(longest, ready - before[2])
            if process not in self._ours:
                worked += at_work - before[1] + ready - before[2]
            if new[thread] != self._last.get(thread):
                self._changed_s[thread] = now_s
        if self._last:
            self._reach_s = min(REACH_S, self._reach_s + passed_s)
            lost_s = min(longest / 1e9, (1 - SLOWEST) * self._reach_s)
            self._lost_s += lost_s
            self._reach_s -= lost_s
            if worked / 1e9 > IDLE * passed_s:
                self._worked_s = now_s - self._lost_s
        self._last, self._last_s = new, now_s
        self._next_s = now_s + max(0.05, (self._clock() - now_s) / LOOKING)

    def _ready_threads(self) -> Iterator[int]:
        """Yield the ready threads, the master's included: a program may wait for its answer."""
        for thread, (process, _, _) in self._last.items():
            if process != os.getpid() and self._ready(process, thread):
                yield thread

    def idle_s(self) -> float:
        """Return how long the programs have been idle [s of their time]; 0 if it is not counted."""
        idle_s = self.now() - self._worked_s if self._last else 0.0
        if idle_s > STARVED_S and any(self._ready_threads()):
            self._worked_s = self.now()
            return 0.0
        return idle_s

    def starved(self) -> bool:
        """Return whether a ready thread has not run for long."""
        now_s = self._clock()
        return any(now_s - self._changed_s[thread] > STARVED_S for thread in self._ready_threads())

    def crowd(self) -> int:
        return len({process for process, _, _ in self._last.values()} - self._ours)

    def begin(self) -> None:
        """Let busy() also judge the time from now on."""
        self.now()
        self._whole_and_part[1:] = [(self._clock(), self._lost_s)]

    def busy(self) -> bool:
        """Return whether the machine was busy, since start or begin(): delays prove little."""
        return max(self._lost_shares()) > BUSY

    def overloaded(self) -> bool:
        """Return whether the machine was so busy that a late answer proves nothing."""
        return self._lost_shares()[0] > OVERLOADED

    def _lost_shares(self) -> list[float]:
        now_s = self._clock()
        return [(self._lost_s - lost) / max(1e-3, now_s - at) for at, lost in self._whole_and_part]
