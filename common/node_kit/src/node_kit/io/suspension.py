"""Notices that this process was suspended: by a signal, a debugger, a virtual machine.

What it finds in its sockets afterwards was sent meanwhile, and is old.
"""

from __future__ import annotations

import signal
import threading
import time

_BEAT_S = 0.1  # how often a thread of our own looks at the clock
_LONGEST_GAP_S = 0.5  # between two looks, even on a busy machine: after more it was suspended
_SAME_S = 0.1  # the clock and the signal notice one suspension within this time


class Suspensions:
    """Counts how often this process was suspended. Make it in the main thread."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._number = 0
        self._counted = -_SAME_S  # when
        self._looked = _now()
        # It ends every stop by a signal, and is noticed however short the stop was.
        signal.signal(signal.SIGCONT, self._on_continue)
        threading.Thread(target=self._beat, daemon=True).start()

    def number(self) -> int:
        """Return how many there were until now; cheap enough for every message."""
        self._notice(_now())
        return self._number

    def _notice(self, now: float) -> None:
        if now - self._looked > _LONGEST_GAP_S:
            with self._lock:  # several threads may notice it; one counts it
                if now - self._looked > _LONGEST_GAP_S:
                    self._number += 1
                    self._counted = self._looked = now

    def _on_continue(self, _number: int, _frame: object) -> None:
        # Without the lock, which the interrupted main thread may hold.
        now = self._looked = _now()
        if now - self._counted > _SAME_S:
            self._number += 1
            self._counted = now

    def _beat(self) -> None:
        while True:
            time.sleep(_BEAT_S)
            self._look()

    def _look(self) -> None:
        now = _now()
        self._notice(now)
        # Not the time by now: a suspension since then is still to be noticed.
        self._looked = max(self._looked, now)


def _now() -> float:
    # Runs while the whole machine sleeps, unlike time.monotonic().
    return time.clock_gettime(time.CLOCK_BOOTTIME)
