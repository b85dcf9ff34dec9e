"""What pages may cost: seconds of the one thread that serves them all (pure)."""

from typing import Optional

SHARE = 0.3  # [part of that thread] all pages together, except the one that drives
BURST_S = 0.05  # that one page may use at once, as for opening
ALL_BURST_S = 0.01  # that the messages of all may use at once, while the driver waits
REQUEST_S = 0.002  # answering an HTTP request; measured: 1 to 2 ms
REQUESTS_BURST_S = 0.1  # that one address may use at once: a page loads 25 files
MESSAGE_S = 0.0002  # receiving a message, whatever it asks for


class Budget:
    """Refills at a rate, up to burst_s. A cost is known afterwards: there may be debt."""

    def __init__(self, burst_s: float) -> None:
        self._burst_s = self._left_s = burst_s
        self._at: Optional[float] = None

    def wait_s(self, now: float, rate: float) -> float:
        """Return how long to wait [s] until there is something left. rate: [s/s]."""
        gained = 0.0 if self._at is None else max(0.0, now - self._at) * rate
        self._left_s, self._at = min(self._burst_s, self._left_s + gained), now
        return max(0.0, -self._left_s / rate)

    def spend(self, seconds: float) -> None:
        self._left_s -= seconds
