"""The end of a node: quiet, within a limit, and after the robot has stopped."""

from __future__ import annotations

import os
import signal
import threading

import rospy

# How long rospy may take to unregister from master and other nodes [s]. Without a limit it would
# wait for one that does not answer; roslaunch waits 15 s for a node, a user does not.
LONGEST_GOODBYE_S = 1.2


def end_on_signals() -> None:
    """Shut the node down on SIGINT, SIGTERM and SIGHUP, which arrives when a terminal is closed.

    Call this before init_node(disable_signals=True). A program under nohup keeps ignoring SIGHUP.
    rospy's own handler calls the master from the thread that it interrupts. If that thread was
    calling the master, as at the start of a node, it waits for its own lock forever.
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
    """Limit the time between the start of a shutdown and the exit; call this after init_node()."""
    rospy.on_shutdown(_exit_soon)


def _exit_soon() -> None:
    timer = threading.Timer(LONGEST_GOODBYE_S, os._exit, [0])
    timer.daemon = True
    timer.start()


def wait_for_goodbye() -> None:
    """Wait until the shutdown is complete: a node that exits earlier stays registered."""
    if rospy.core._shutdown_lock.acquire(timeout=LONGEST_GOODBYE_S):  # held until then
        rospy.core._shutdown_lock.release()


def is_ending() -> bool:
    """Return whether the shutdown has started; rospy.is_shutdown() waits until the topics close."""
    return rospy.core.is_shutdown_requested()
