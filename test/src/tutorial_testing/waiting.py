"""Waiting for what a test is about, with one deadline for all."""

import time

DEADLINE_S = 150.0  # generous: ten times what a build takes, or the start of a dozen nodes
# What a busy machine may add to a time that is demanded of a program.
BUSY_S = 2.0


def wait_for(condition, what, deadline_s=DEADLINE_S):
    """Return the first true value of condition(); AssertionError naming `what` at the deadline."""
    end = time.monotonic() + deadline_s
    while True:
        value = condition()
        if value:
            return value
        if time.monotonic() > end:
            raise AssertionError(f"no {what} within {deadline_s:.0f} s")
        time.sleep(0.01)
