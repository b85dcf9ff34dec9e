"""What pages may cost: their number, what they send, and seconds of the one thread (pure)."""

from math import inf
from typing import Optional

MOST_PAGES = 64  # a class, each with a page and a phone
MOST_CONNECTIONS = 256  # each takes a file descriptor, of which a process may have 1024
LONGEST_IDLE_S = 20.0  # a connection on which nothing is asked
PING_S = 1.0  # a page that does not answer three of them is closed
# Reads between two messages of a page: a frame takes up to four. Browsers send ours in one piece.
MOST_READS = 400
LONGEST_MESSAGE = 8192  # bytes; the longest that a page sends is a watch with MOST_FIELDS of schema
LONGEST_HEADER = 16384  # bytes
LONGEST_BODY = 1024  # bytes; nothing is uploaded
# What waits in the kernel for a page that does not read [bytes]; the kernel doubles it.
SEND_BUFFER = 65536

# [part of the thread] each of: messages of pages that do not drive, what pages are sent, HTTP.
SHARE = 0.15
SENDING_BURST_S = 0.003  # The driver waits so long for what is sent to pages, one after the other.
MESSAGE_S = 0.0005  # reading a message, before it is known what it costs
MESSAGES_BURST_S = 0.005  # The driver waits so long for messages of others.
REQUEST_S = 0.002  # answering an HTTP request; measured: 1 to 2 ms
REQUESTS_BURST_S = 0.5  # Ten pages load at once, each 25 files.
# As many wait as there are connections: one page that asks without end holds up others for 3.4 s.
REQUESTS_DEBT_S = MOST_CONNECTIONS * REQUEST_S


class Budget:
    """Refills at SHARE, up to burst_s. A cost is known afterwards: there may be debt."""

    def __init__(self, burst_s: float, each_s: float, most_debt_s: float = inf) -> None:
        """most_debt_s: by those that wait."""
        self._burst_s = self._left_s = burst_s
        self._each_s, self._least_s = each_s, -most_debt_s
        self._at: Optional[float] = None

    def wait_s(self, now: float) -> float:
        """Return how long [s] one more has to wait; it costs each_s."""
        gained = 0.0 if self._at is None else max(0.0, now - self._at) * SHARE
        left_s, self._at = min(self._burst_s, self._left_s + gained), now
        self._left_s = max(self._least_s, left_s - self._each_s)
        return max(0.0, -left_s / SHARE)

    def spend(self, seconds: float) -> None:
        self._left_s -= seconds
