"""Detects that this process was suspended: by a signal, a debugger or a virtual machine.

After a suspension, the messages that wait in its sockets are old.
"""

from __future__ import annotations

import signal
import threading
import time

_BEAT_S = 0.1  # period at which a thread reads the clock
_LONGEST_GAP_S = 0.5  # between two readings, even on a busy machine; a longer gap is a suspension
_SAME_S = 0.1  # within this time, the clock and the signal report the same suspension


class Suspensions:
    """Counts the suspensions of this process. Create it in the main thread."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._number = 0
        self._counted = -_SAME_S  # when
        self._looked = _now()
        # SIGCONT ends every stop by a signal, and arrives however short the stop was.
        signal.signal(signal.SIGCONT, self._on_continue)
        threading.Thread(target=self._beat, daemon=True).start()

    def number(self) -> int:
        """Return the number of suspensions so far; fast enough to call for every message."""
        self._notice(_now())
        return self._number

    def _notice(self, now: float) -> None:
        if now - self._looked > _LONGEST_GAP_S:
            with self._lock:  # several threads may detect it, and one counts it
                if now - self._looked > _LONGEST_GAP_S:
                    self._number += 1
                    self._counted = self._looked = now

    def _on_continue(self, _number: int, _frame: object) -> None:
        # Not with the lock, which the interrupted main thread may hold.
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
        # Not the present time: a suspension since `now` must still be detected.
        self._looked = max(self._looked, now)


def _now() -> float:
    # Unlike time.monotonic(), this clock runs while the machine sleeps.
    return time.clock_gettime(time.CLOCK_BOOTTIME)
