"""Lets the thread of a subscriber work between messages, so that the next one finds it fast.

After a sleep of some milliseconds the caches of the processor hold what others need: the way from
a message through Python to its answer then takes several times as long as right after another.
"""

from __future__ import annotations

import contextlib
import select
import socket
from time import monotonic
from typing import Any, Callable

from rospy.impl.tcpros_base import TCPROSTransport
from rospy.impl.tcpros_pubsub import TCPROSSub

PERIOD_MS = 2  # Sleeps of 4 ms and more are slow, and 3 ms is a little slower than this.
FOR_S = 0.1  # after a message: a joystick node that repeats does so at 20 Hz or more

_receive = TCPROSTransport.receive_once  # rospy's own
_rehearsals: dict[str, Callable[[], object]] = {}  # by topic


def rehearse(topic: str, once: Callable[[], object]) -> None:
    """Call once() again and again in the thread that awaits the next message of a topic.

    topic: resolved. once: has no effect outside, and takes far less time than PERIOD_MS.
    """
    _rehearsals[topic] = once
    TCPROSTransport.receive_once = _receive_rehearsed


def _receive_rehearsed(self: Any) -> Any:
    """In place of TCPROSTransport's."""
    protocol, sock = self.protocol, self.socket
    if sock and isinstance(protocol, TCPROSSub) and protocol.resolved_name in _rehearsals:
        _rehearse_until_it_comes(sock, _rehearsals[protocol.resolved_name])
    return _receive(self)


def _rehearse_until_it_comes(sock: socket.socket, once: Callable[[], object]) -> None:
    arrived, until = select.poll(), monotonic() + FOR_S
    with contextlib.suppress(ValueError):  # It is closed meanwhile, and is then in no poll.
        arrived.register(sock, select.POLLIN)
    while not arrived.poll(PERIOD_MS) and monotonic() < until:
        once()
