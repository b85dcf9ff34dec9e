"""Fixes three faults of rospy's connections; README.md lists them."""

from __future__ import annotations

import contextlib
import socket
import struct
import threading
import time
import weakref
from ipaddress import ip_address
from typing import Any, Callable

from rospy.exceptions import TransportException
from rospy.impl.masterslave import ROSHandler
from rospy.impl.tcpros import get_tcpros_handler
from rospy.impl.tcpros_base import TCPROS, TCPROSServer
from rospy.impl.tcpros_pubsub import TCPROSSub
from rospy.msg import deserialize_messages

from node_kit.rules.throttle import ThrottleEach

GREETING_S = 2.0  # for a peer to name its topic; on a local network this takes milliseconds
# A message that takes longer and arrives slower declares a wrong length: the messages after it fill
# it up, and control messages are too small to do so in that time.
LONGEST_ARRIVAL_S, SLOWEST_ARRIVAL = 0.5, 1e6  # [s], [bytes/s]
WARNING_PERIOD_S = 1.0  # a sender may send a hundred bad messages a second
_LENGTH = struct.Struct("<I")

_greet = TCPROSServer._tcp_server_callback  # rospy's own
_connect = ROSHandler._connect_topic  # rospy's own
# A lock for each (topic, publisher) in use.
_turns: weakref.WeakValueDictionary[tuple[str, str], Any] = weakref.WeakValueDictionary()
_turns_lock = threading.Lock()
_warn: Callable[[str], object] | None = None  # takes a line about an unreadable message
_may_warn = ThrottleEach(1.0 / WARNING_PERIOD_S)


def be_careful() -> None:
    """Patch all connections of this node; call this before rospy.init_node()."""
    TCPROSServer._tcp_server_callback = _greet_in_time
    TCPROSSub.read_messages = _read_messages
    connect_once()


def connect_once() -> None:
    """Connect to each publisher only once, and patch nothing else: for nodes that observe."""
    ROSHandler._connect_topic = _connect_in_turn


def report_bad_messages(warn: Callable[[str], object]) -> None:
    """Call warn(line), which must not block, at most once a second for each topic."""
    global _warn  # noqa: PLW0603  rospy makes the connections
    _warn = warn


def sender_of(message: Any) -> str:
    """Return the name of the node that sent a message, "" if unknown."""
    return header_of(message).get("callerid", "")


def has_sender(subscriber: Any) -> bool:
    """Return whether a rospy.Subscriber is connected; rospy also counts pending connections."""
    return any(link.socket is not None for link in list(subscriber.impl.connections))


def header_of(message: Any) -> dict[str, str]:
    """Return the header of a message's connection: one object (`is`) for each connection."""
    return message._connection_header


def is_remote(subscriber: Any, message: Any) -> bool:
    """Return whether a rospy.Subscriber received a message from another host."""
    for link in list(subscriber.impl.connections):
        if link.header is header_of(message):
            with contextlib.suppress(AttributeError, OSError):  # closed in the meantime
                peer, own = link.socket.getpeername()[0], link.socket.getsockname()[0]
                return peer != own and not ip_address(peer).is_loopback
    return False


def established(subscriber: Any) -> list[Any]:
    """Return the open connections of a rospy.Subscriber, without the pending ones."""
    return [link for link in list(subscriber.impl.connections) if link.header and link.socket]


def renew(subscriber: Any, old: Any) -> None:
    """Replace a connection of a rospy.Subscriber; its unread messages are lost."""
    address = [TCPROS, *old.dest_address]
    # rospy drops the old connection to the same publisher.
    get_tcpros_handler().create_transport(subscriber.resolved_name, old.endpoint_id, address)


def is_connected(subscriber: Any, old: Any) -> bool:
    """Return whether a rospy.Subscriber has a connection to the publisher of an old one."""
    return bool(subscriber.impl.has_connection(old.endpoint_id))


def _greet_in_time(self: Any, sock: socket.socket, client_addr: Any) -> None:
    """Replace TCPROSServer's: greet each peer in another thread, with a timeout."""

    def greet() -> None:
        # Not the timeout of the socket, which restarts with every byte and remains set.
        too_late = threading.Timer(GREETING_S, _cut, [sock])
        too_late.daemon = True
        too_late.start()
        with contextlib.suppress(OSError):  # the peer has disconnected
            _greet(self, sock, client_addr)
        too_late.cancel()

    threading.Thread(target=greet, daemon=True).start()


def _connect_in_turn(self: Any, topic: str, uri: str) -> Any:
    """Replace ROSHandler's: a second thread finds the connection of the first."""
    with _turns_lock:
        turn = _turns.setdefault((topic, uri), threading.Lock())
    with turn:
        return _connect(self, topic, uri)


def _cut(sock: socket.socket) -> None:
    with contextlib.suppress(OSError):
        sock.shutdown(socket.SHUT_RDWR)


def _read_messages(self: Any, buffer: Any, messages: list[Any], _sock: object) -> None:
    """Replace TCPROSSub's: report an unreadable message, and restart with an empty buffer.

    On a TransportException, rospy closes the connection and opens a new one.
    """
    try:
        deserialize_messages(buffer, messages, self.recv_data_class, queue_size=self.queue_size)
        if messages:
            self.incomplete_since = None
        else:
            _check_arrival(self, buffer)
    except Exception as error:  # malformed bytes may raise anything
        del messages[:]
        buffer.seek(0)
        buffer.truncate()
        self.incomplete_since = None
        if _warn and _may_warn.ready(self.resolved_name, time.monotonic()):
            _warn(
                f"A message on {self.resolved_name} cannot be read ({error}): the connection to "
                "its sender is renewed."
            )
        raise TransportException(f"{self.resolved_name}: a message cannot be read") from None


def _check_arrival(self: Any, buffer: Any) -> None:
    """Raise ValueError if the current message does not arrive completely."""
    now = time.monotonic()
    if getattr(self, "incomplete_since", None) is None:
        self.incomplete_since = now
        return
    taken_s = now - self.incomplete_since
    with buffer.getbuffer() as arrived:
        is_slow = len(arrived) < SLOWEST_ARRIVAL * taken_s
        (length,) = _LENGTH.unpack_from(arrived) if len(arrived) >= _LENGTH.size else (0,)
    if is_slow and taken_s > LONGEST_ARRIVAL_S:
        raise ValueError(f"it declares {length} bytes, which do not arrive")
