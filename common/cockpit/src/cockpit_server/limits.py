"""Limits for pages: their number, their messages, and their part of the one thread's time."""

from math import inf
from typing import Optional

MOST_PAGES = 64  # a class, each with a page and a phone
MOST_CONNECTIONS = 256  # each takes a file descriptor, of which a process may have 1024
LONGEST_IDLE_S = 20.0  # a connection without a request
PING_S = 1.0  # a page that does not answer three of them is closed
# Reads between two messages of a page: a frame takes up to four. Browsers send ours in one piece.
MOST_READS = 400
LONGEST_MESSAGE = 8192  # bytes; the longest of a page is a watch of MOST_FIELDS fields (schema.py)
LONGEST_HEADER = 16384  # bytes
LONGEST_BODY = 1024  # bytes; nothing is uploaded
# What the kernel buffers for a page that does not read [bytes]; the kernel doubles it.
SEND_BUFFER = 65536

# The part of the thread's time for each of: messages of pages that do not drive, messages to pages,
# HTTP.
SHARE = 0.15
SENDING_BURST_S = 0.003  # how long the driver waits while messages are sent to pages in turn
MESSAGE_S = 0.0005  # reading a message; its further cost is known afterwards
MESSAGES_BURST_S = 0.005  # how long the driver waits for messages of others
REQUEST_S = 0.002  # answering an HTTP request; measured: 1 to 2 ms
REQUESTS_BURST_S = 0.5  # Ten pages load at once, with 25 files each.
# As many requests wait as there are connections: a flood of one page delays others by 3.4 s.
REQUESTS_DEBT_S = MOST_CONNECTIONS * REQUEST_S


class Budget:
    """Time that refills at SHARE, up to burst_s. Costs are known afterwards: there may be debt."""

    def __init__(self, burst_s: float, cost_s: float, most_debt_s: float = inf) -> None:
        """most_debt_s: the limit for the cost of all actions that wait."""
        self._burst_s = self._left_s = burst_s
        self._cost_s, self._least_s = cost_s, -most_debt_s
        self._at: Optional[float] = None

    def wait_s(self, now: float) -> float:
        """Return how long [s] the next action has to wait, which costs cost_s."""
        gained = 0.0 if self._at is None else max(0.0, now - self._at) * SHARE
        left_s, self._at = min(self._burst_s, self._left_s + gained), now
        self._left_s = max(self._least_s, left_s - self._cost_s)
        return max(0.0, -left_s / SHARE)

    def spend(self, seconds: float) -> None:
        self._left_s -= seconds
