"""Sends messages over a socket without waiting for the other side (pure: no ROS, no clock)."""

from __future__ import annotations

import select
import socket
import threading
from typing import Callable

# Linux resends what is not acknowledged after 0.2 s or more, then after twice that, and so on. A
# packet lost on a radio link is resent once; a second time means no answer for some 0.6 s,
# as long as a TurtleBot obeys a velocity.
CUT_AFTER_RESENDS = 2
# struct tcp_info of linux/tcp.h begins with these bytes: tcpi_state, tcpi_ca_state (4: packets were
# lost), tcpi_retransmits. Four bytes are asked for, since QEMU's emulation of a processor knows
# options of that length only, and leaves what was in memory in any other.
_INFO_BYTES = 4
_STATE_AT, _CONGESTION_AT, _RESENDS_AT = 0, 1, 2
_STATES = range(1, 13)  # TCP_ESTABLISHED to TCP_NEW_SYN_RECV, linux/tcp_states.h
_LOSS = 4  # TCP_CA_Loss: so it is whenever something was resent because no answer came


class NewestOnly:
    """One connection on which write() returns at once.

    What the kernel does not take is kept, and of several such messages only the newest: an old
    velocity is worth nothing. A thread that lives only as long as the other side is behind sends
    it later. A message that has started is always finished before the next one.

    With a stop message: when the network is cut, the kernel keeps what it has taken and delivers it
    when the network is back, all at once. So that this ends with a stop, a cut connection gets a
    last stop and then nothing; once it is whole again, nothing before free() is called.
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

        stop: the message to stop, or None if a late message does no harm. report: called with True
        when the connection is cut, with False when it is in use again. buffer_bytes: the size of
        the kernel's buffer, which the kernel doubles. held: send nothing before free() is called.
        """
        self._socket = connected_socket
        self._stop = stop
        self._report = report
        self._lock = threading.Lock()
        self._behind = False  # the thread runs
        self._begun = b""  # the rest of a message of which the kernel has taken a part
        self._newest = b""  # the message to send after that
        self.held = held
        # A small message goes out at once instead of waiting for the answer to the last one.
        connected_socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        if buffer_bytes:
            connected_socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, buffer_bytes)

    def write(self, message: bytes) -> None:
        """Send the message now, or as soon as the kernel takes it. Raises OSError if broken."""
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
        """Use a held connection again, if it is whole: all was seen released."""
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
            # The other side is gone, or the connection was closed here: the next write() raises.
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
        """Return the number of bytes that the kernel has taken."""
        try:
            return self._socket.send(data, socket.MSG_DONTWAIT)
        except BlockingIOError:
            return 0


def resends(connected_socket: socket.socket) -> int:
    """Return how often Linux has resent, in vain so far, what the other side has not acknowledged.

    0 if what comes back cannot be right: a meaningless answer must not stop a robot.
    """
    info = connected_socket.getsockopt(socket.IPPROTO_TCP, socket.TCP_INFO, _INFO_BYTES)
    if len(info) < _INFO_BYTES or info[_STATE_AT] not in _STATES or info[_CONGESTION_AT] != _LOSS:
        return 0
    return info[_RESENDS_AT]
