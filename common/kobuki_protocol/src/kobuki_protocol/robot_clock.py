"""The clock of a Kobuki: 16 bits of milliseconds, which restart when it is switched on."""

from __future__ import annotations

WRAP_MS = 1 << 16
NEXT_MS = 100  # a packet newer by up to this much continues the count
TOLERANCE_MS = 300.0  # largest difference between the clocks after a gap
MOST_DRIFT_MS = 0.02  # between two packets: 1 ms/s


class RobotClock:
    """Decides whether a packet continues the count of the earlier ones.

    Packets may come late, for example after a suspension of the driver, and many may be lost. The
    time of a robot that was switched off and on differs from the time expected by our clock.
    """

    def __init__(self) -> None:
        """Wait for the first packet."""
        self._stamp_ms: int | None = None
        self._offset_ms = 0.0  # from the robot's clock to ours, without delays
        self.late_s = 0.0  # delay of the last packet

    def elapsed_s(self, stamp_ms: int, now_s: float) -> float | None:
        """Return the time since the last packet; None if this is the first packet of a count.

        stamp_ms: core.time_stamp. now_s: from a clock that never jumps.
        """
        last, self._stamp_ms, self.late_s = self._stamp_ms, stamp_ms, 0.0
        offset_ms = 1000.0 * now_s - stamp_ms
        if last is None:
            self._offset_ms = offset_ms
            return None
        late_ms = (offset_ms - self._offset_ms + WRAP_MS / 2) % WRAP_MS - WRAP_MS / 2
        dt_ms = (stamp_ms - last) % WRAP_MS
        if dt_ms > NEXT_MS and abs(late_ms) > TOLERANCE_MS:
            self._offset_ms = offset_ms
            return None
        self._offset_ms += min(late_ms, MOST_DRIFT_MS)
        self.late_s = max(0.0, late_ms / 1000.0)
        return dt_ms / 1000.0
