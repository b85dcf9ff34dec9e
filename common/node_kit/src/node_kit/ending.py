"""The end of a node: quiet, in time, and with the robot at rest first."""

import os
import signal
import threading

import rospy

# How long rospy may say goodbye to the master and to other nodes [s]. It would wait for ever for
# one that does not answer; roslaunch waits 15 s for a node, a user does not.
LONGEST_GOODBYE_S = 1.2


def end_on_signals():
    """Let SIGINT and SIGTERM shut the node down; call before init_node(disable_signals=True).

    rospy's own handler talks to the master from the thread that it has interrupted. If that was
    just doing the same, as while the node starts, it waits for its own lock for ever.
    """

    def end(number, _frame):
        _exit_soon()
        threading.Thread(
            target=rospy.signal_shutdown, args=(f"signal {number}",), daemon=True
        ).start()

    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, end)


def end_in_time():
    """Limit what comes after the node's own shutdown, however it began; call after init_node()."""
    rospy.on_shutdown(_exit_soon)


def _exit_soon():
    timer = threading.Timer(LONGEST_GOODBYE_S, os._exit, [0])
    timer.daemon = True
    timer.start()


def is_ending():
    """Whether the end was asked for; rospy.is_shutdown() says so only after the topics close."""
    return rospy.core.is_shutdown_requested()
