"""A quiet end on Ctrl-C and SIGTERM, whenever they come."""

import signal
import threading

import rospy


def end_on_signals():
    """Let SIGINT and SIGTERM shut the node down; call before init_node(disable_signals=True).

    rospy's own handler talks to the master from the thread that it has interrupted. If that was
    just doing the same, as while the node starts, it waits for its own lock without an end.
    """

    def end(number, _frame):
        threading.Thread(target=rospy.signal_shutdown, args=(f"signal {number}",)).start()

    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, end)
