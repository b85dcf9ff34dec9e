"""A heart that beats in a thread, and tells when this process was not run in time."""

import threading
import time

BEAT_S = 0.01
LATE_S = 0.1  # a gap worth telling


def beat(late):
    """Begin. late: called with the time of the system clock [s] and the gap [s], after each gap."""

    def go():
        before = time.monotonic()
        while True:
            time.sleep(BEAT_S)
            now = time.monotonic()
            if now - before > LATE_S:
                late(time.time(), now - before)
            before = now

    threading.Thread(target=go, daemon=True).start()
