"""Hands rospy the calls to an Announcement, those from before it could answer included."""

from __future__ import annotations

import threading

from rospy.impl import tcpros_base

from node_kit.ros.lifecycle.announcement import Announcement


def answer_early_callers(announcement: Announcement | None) -> None:
    """Answer the calls to the announced address; use it once the services are open."""
    if announcement:
        announcement.keep()
        threading.Thread(target=_answer, args=(announcement,), daemon=True).start()


def _answer(announcement: Announcement) -> None:
    while True:  # until the process exits
        tcpros_base._tcpros_server._tcp_server_callback(*announcement.listener.accept())
