"""Sends messages over a socket without waiting for the other side."""

from __future__ import annotations

import select
import socket
import threading
from typing import Callable

# Linux resends an unacknowledged packet after at least 0.2 s, then after twice that, and so on. A
# packet that is lost on a radio link is resent once. A second time means no answer for about 0.6 s,
# the time for which a TurtleBot obeys a velocity.
CUT_AFTER_RESENDS = 2
# struct tcp_info of linux/tcp.h begins with these bytes: tcpi_state, tcpi_ca_state (4: packets were
# lost), tcpi_retransmits. Four bytes are requested, because QEMU's user mode
# supports options of that length only, and returns uninitialised memory for any other.
_INFO_BYTES = 4
_STATE_AT, _CONGESTION_AT, _RESENDS_AT = 0, 1, 2
_STATES = range(1, 13)  # TCP_ESTABLISHED to TCP_NEW_SYN_RECV, linux/tcp_states.h
_LOSS = 4  # TCP_CA_Loss: a packet was resent because it was not acknowledged


class NewestOnly:
    """A connection on which write() returns at once.

    It keeps the newest message that the kernel does not accept: an old velocity is worthless. A
    thread, which exists only while the other side is behind, sends it later. A message that was
    sent in part is always completed first.

    With a stop message: when the network is cut, the kernel keeps the messages that it has accepted
    and delivers them all at once later. So that these end with a stop, a cut connection gets a last
    stop and then nothing, even after the network is back, until free() is called.
    """

    def __init__(
        self,
        connected_socket: socket.socket,
        stop: bytes | None = None,
        report: Callable[[bool], object] = lambda is_cut: None,
        buffer_bytes: int | None = None,
        held: bool = False,
    ) -> None:
        """Take over a TCP socket.

        stop: the message that stops a robot, or None if late messages are harmless. report: called
        with True when the connection is cut, and with False when it is in use again. buffer_bytes:
        for the kernel's buffer, which the kernel doubles. held: send nothing before free().
        """
        self._socket = connected_socket
        self._stop = stop
        self._report = report
        self._lock = threading.Lock()
        self._behind = False  # whether the thread runs
        self._begun = b""  # the rest of a message that was sent in part
        self._newest = b""  # the message to send after that
        self.held = held
        # Send a small message at once, without waiting for the acknowledgement of the last one.
        connected_socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        if buffer_bytes:
            connected_socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, buffer_bytes)

    def write(self, message: bytes) -> None:
        """Send the message now, or as soon as the kernel accepts it. Raises OSError if closed."""
        with self._lock:
            if self._stop:
                if self.held:
                    return
                if self._is_cut():
                    self.held = True
                    self._report(True)
                    message = self._stop
            if self._behind:
                self._newest = message
                return
            sent = self._send(message)
            if sent == len(message):
                return
            self._begun, self._newest = (message[sent:], b"") if sent else (b"", message)
            self._behind = True
        threading.Thread(target=self._catch_up, daemon=True).start()

    def free(self) -> None:
        """Use a held connection again, if the network is back: everything was released."""
        with self._lock:
            if self.held and not self._is_cut():
                self.held = False
                self._report(False)

    def _is_cut(self) -> bool:
        return resends(self._socket) >= CUT_AFTER_RESENDS

    def _catch_up(self) -> None:
        writable = select.poll()
        try:
            writable.register(self._socket, select.POLLOUT)
            while self._behind:
                writable.poll()
                with self._lock:
                    self._send_some()
        except (OSError, ValueError):
            # The connection was closed at one of its ends: the next write() raises.
            with self._lock:
                self._behind = False

    def _send_some(self) -> None:
        if self._begun:
            self._begun = self._begun[self._send(self._begun) :]
        elif self._newest:
            sent = self._send(self._newest)
            if sent:
                self._begun, self._newest = self._newest[sent:], b""
        else:
            self._behind = False

    def _send(self, data: bytes) -> int:
        """Return the number of bytes that the kernel has accepted."""
        try:
            return self._socket.send(data, socket.MSG_DONTWAIT)
        except BlockingIOError:
            return 0


def resends(connected_socket: socket.socket) -> int:
    """Return how often Linux has resent the packet that the other side has not yet acknowledged.

    0 if the kernel's reply is implausible: a meaningless reply must not stop a robot.
    """
    info = connected_socket.getsockopt(socket.IPPROTO_TCP, socket.TCP_INFO, _INFO_BYTES)
    if len(info) < _INFO_BYTES or info[_STATE_AT] not in _STATES or info[_CONGESTION_AT] != _LOSS:
        return 0
    return info[_RESENDS_AT]
