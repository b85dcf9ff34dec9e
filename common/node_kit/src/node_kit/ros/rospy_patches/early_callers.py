"""Hand rospy the calls to an announced service that came before it could answer."""

from __future__ import annotations

import socket
import threading

from rospy.impl import tcpros_base


def answer_early_callers(listener: socket.socket) -> None:
    """Answer the calls to the announced address; use it once the services are open."""
    threading.Thread(target=_answer, args=(listener,), daemon=True).start()


def _answer(listener: socket.socket) -> None:
    while True:  # until the process exits
        tcpros_base._tcpros_server._tcp_server_callback(*listener.accept())
