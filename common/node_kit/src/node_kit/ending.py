"""The end of a node: quiet, in time, with the robot at rest first, and not in place of another."""

from __future__ import annotations

import os
import re
import signal
import threading
from typing import Any

import rosgraph
import rospy
from rospy.impl.masterslave import ROSHandler

from node_kit.questions import Answer, call

# The reason that rosmaster's registrations.py sends to a node that is replaced, with its name.
REPLACED = re.compile(r"\[(\S*)\] Reason: new node registered with same name")

# How long rospy may unregister from the master and from other nodes [s]. It would wait without end
# for one that does not answer; roslaunch waits 15 s for a node, a user does not.
LONGEST_GOODBYE_S = 1.2

_end = ROSHandler.shutdown  # rospy's own


def end_on_signals() -> None:
    """Let SIGINT and SIGTERM shut the node down; call before init_node(disable_signals=True).

    rospy's own handler calls the master from the thread that it has interrupted. If that was doing
    the same, as while the node starts, it waits for its own lock without end.
    """

    def end(number: int, _frame: object) -> None:
        _exit_soon()
        threading.Thread(
            target=rospy.signal_shutdown, args=(f"signal {number}",), daemon=True
        ).start()

    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, end)


def end_in_time() -> None:
    """Limit what comes after the node's own shutdown, however it began; call after init_node()."""
    rospy.on_shutdown(_exit_soon)


def end_only_if_replaced() -> None:
    """Stay when a master takes this node for another; call before rospy.init_node().

    A node that died stays registered. When its name is used again, the master asks the node that
    has its port by then to shut down, even if that has another name or another master.
    """
    ROSHandler.shutdown = _end_if_meant


def _end_if_meant(self: Any, *arguments: Any) -> Any:
    """In place of ROSHandler's; arguments: the caller's name and its reason."""
    replaced = REPLACED.search(str(arguments[-1:]))
    if replaced and (replaced[1] != rospy.get_name() or _has_its_name()):
        rospy.logwarn(
            f"A master says that another node is {replaced[1]} now, and means one that died and "
            "whose port this node has: it goes on."
        )
        return 1, "not ended", 0
    return _end(self, *arguments)


def _has_its_name() -> bool:
    """Return whether the own master knows this node; it forgets the topics of one replaced."""
    master, name = rosgraph.get_master_uri(), rospy.get_name()
    if call(master, "lookupNode", name) != (Answer.WELL, rospy.get_node_uri()):
        return False
    answer, state = call(master, "getSystemState")
    if answer is not Answer.WELL:
        return False
    topics = rospy.topics.get_topic_manager()
    ours = (topics.get_publications(), topics.get_subscriptions())
    return all(
        {topic for topic, _ in own} <= {topic for topic, nodes in known if name in nodes}
        for own, known in zip(ours, state)
    )


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
