"""The end of a node: quiet, in time, with the robot at rest first."""

from __future__ import annotations

import os
import signal
import threading

import rospy

# How long rospy may unregister from the master and from other nodes [s]. It would wait without end
# for one that does not answer; roslaunch waits 15 s for a node, a user does not.
LONGEST_GOODBYE_S = 1.2


def end_on_signals() -> None:
    """Let SIGINT, SIGTERM and SIGHUP, which comes when a terminal is closed, shut the node down;
    call before init_node(disable_signals=True). What nohup starts goes on ignoring SIGHUP.

    rospy's own handler calls the master from the thread that it has interrupted. If that was doing
    the same, as while the node starts, it waits for its own lock without end.
    """

    def end(number: int, _frame: object) -> None:
        _exit_soon()
        threading.Thread(
            target=rospy.signal_shutdown, args=(f"signal {number}",), daemon=True
        ).start()

    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        if number != signal.SIGHUP or signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, end)


def end_in_time() -> None:
    """Limit what comes after the node's own shutdown, however it began; call after init_node()."""
    rospy.on_shutdown(_exit_soon)


def _exit_soon() -> None:
    timer = threading.Timer(LONGEST_GOODBYE_S, os._exit, [0])
    timer.daemon = True
    timer.start()


def wait_for_goodbye() -> None:
    """Wait until the shutdown is complete: a node that exits sooner stays registered."""
    if rospy.core._shutdown_lock.acquire(timeout=LONGEST_GOODBYE_S):  # held until then
        rospy.core._shutdown_lock.release()


def is_ending() -> bool:
    """Return whether the end was requested; rospy.is_shutdown() waits until the topics close."""
    return rospy.core.is_shutdown_requested()
