"""Waiting for what a test is about, with one deadline for all."""

import time

DEADLINE_S = 150.0  # generous: ten times what a build takes, or the start of a dozen nodes
# What a busy machine may add to a time that is demanded of a program.
BUSY_S = 2.0


def wait_for(condition, what, deadline_s=DEADLINE_S):
    """Return the first true value of condition(); AssertionError naming `what` at the deadline.

    It asks 100 times a second in the first second, then 20 times; and less often where a question
    takes processor time here, so that it leaves five sixths of it.
    """
    begin = time.monotonic()
    while True:
        worked_s = time.thread_time()
        value = condition()
        if value:
            return value
        worked_s = time.thread_time() - worked_s
        waited_s = time.monotonic() - begin
        if waited_s > deadline_s:
            raise AssertionError(f"no {what} within {deadline_s:.0f} s")
        time.sleep(max(0.01 if waited_s < 1.0 else 0.05, 5 * worked_s))
