"""Questions to a master or a node, with a timeout, which rospy's own lack.

Also: which node holds a name, and the address of this machine.
"""

from __future__ import annotations

import os
import socket
import threading
import xmlrpc.client
from typing import Any
from urllib.parse import urlsplit

from node_kit.rules.answer import Answer

TIMEOUT_S = 2.0  # for each question; on a local network an answer takes milliseconds
MASTER_S = 10.0  # a busy master still knows which node has a name
PATIENCE_S = 3.0  # a node that hangs or waits for the CPU still holds its name


# The Answer for each exception: the first one that fits.
_MEANINGS = (
    (ConnectionRefusedError, Answer.REFUSED),
    (socket.gaierror, Answer.UNKNOWN_NAME),
    (ConnectionError, Answer.STRANGE),
    (OSError, Answer.SILENT),  # a timeout, or no route to that host
    (Exception, Answer.STRANGE),  # the reply is not from a ROS program
)


class _Transport(xmlrpc.client.Transport):
    def __init__(self, timeout_s: float) -> None:
        super().__init__()
        self._timeout_s = timeout_s

    def make_connection(self, host: Any) -> Any:
        connection = super().make_connection(host)
        connection.timeout = self._timeout_s
        return connection


def call(
    uri: str, method: str, *arguments: Any, caller: str | None = None, timeout_s: float = TIMEOUT_S
) -> tuple[Answer, Any]:
    """Call a method of a master or a node; return (Answer, value or None).

    caller: the name of the calling node, if it is one.
    """
    answer: list[tuple[Answer, Any]] = [(Answer.SILENT, None)]

    def ask() -> None:
        try:
            with xmlrpc.client.ServerProxy(uri, transport=_Transport(timeout_s)) as server:
                name = caller or f"/question_{os.getpid()}"
                code, _, value = getattr(server, method)(name, *arguments)
                answer[0] = (Answer.WELL, value) if code == 1 else (Answer.STRANGE, None)
        except Exception as error:
            answer[0] = (next(a for kind, a in _MEANINGS if isinstance(error, kind)), None)

    # The timeout of a socket is not enough: another kind of server may keep sending, and name
    # resolution has no timeout.
    thread = threading.Thread(target=ask, daemon=True)
    thread.start()
    thread.join(2 * timeout_s)
    return answer[0]


def known_nodes(master_uri: str) -> set[str]:
    """Return the names of the nodes that a master knows, dead ones included."""
    answer, state = call(master_uri, "getSystemState", timeout_s=MASTER_S)
    columns = state if answer is Answer.WELL else ()
    return {node for column in columns for _, users in column for node in users}


def holder(master_uri: str, name: str) -> tuple[str, str] | None:
    """Return (uri, description) of the node that holds a name, or None if the name is free.

    The name of a dead node is free: its port refuses or belongs to another node, or its host is
    gone. The name of a node that accepts a connection without an answer is not free: the node may
    be stopped, and may continue.
    """
    answer, uri = call(master_uri, "lookupNode", name, timeout_s=MASTER_S)
    if answer is not Answer.WELL:
        return None
    answer, pid = call(uri, "getPid", timeout_s=PATIENCE_S)
    if answer is Answer.WELL:
        answer, own = call(uri, "getName", timeout_s=PATIENCE_S)  # rospy's nodes know it
        if answer is Answer.WELL and own != name:
            return None
        return uri, f"at {uri}, process {pid}"
    if answer is Answer.SILENT and accepts(uri):
        return uri, f"at {uri}, but does not answer"
    return None


def accepts(uri: str) -> bool:
    """Return whether a URI accepts a connection; that of a stopped process does."""
    try:
        parts = urlsplit(uri)
        with socket.create_connection((parts.hostname or "", parts.port or 0), PATIENCE_S):
            return True
    except (OSError, ValueError):
        return False


def family(address: str) -> socket.AddressFamily:
    """Return the address family of a numeric address."""
    return socket.AF_INET6 if ":" in address else socket.AF_INET


def way_out(address: str) -> str:
    """Return the own address on the route to another address, or "". Send nothing."""
    try:
        with socket.socket(family(address), socket.SOCK_DGRAM) as probe:
            probe.connect((address, 9))
            return str(probe.getsockname()[0])
    except OSError:
        return ""
