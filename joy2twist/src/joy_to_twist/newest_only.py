"""Sends messages over a socket without ever waiting for the other side (pure: no ROS, no clock)."""

import select
import socket
import threading

# Room for some messages on their way [bytes; the kernel doubles it]. More room would only keep
# more old velocities for a subscriber that has stopped reading.
SEND_BUFFER_BYTES = 8192


class NewestOnly:
    """One connection on which write() returns at once.

    What the kernel does not take is kept, and of several such messages only the newest: an old
    velocity is worth nothing. A thread that lives only as long as the other side is behind sends
    it later. A message that has begun is always finished before the next one.
    """

    def __init__(self, connected_socket):
        """connected_socket: a TCP socket, on which nobody else sends."""
        self._socket = connected_socket
        self._lock = threading.Lock()
        self._behind = False  # the thread runs
        self._begun = b""  # the rest of a message of which the kernel has taken a part
        self._newest = b""  # the message to send after that
        # A small message goes out at once instead of waiting for the answer to the last one.
        connected_socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        connected_socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, SEND_BUFFER_BYTES)

    def write(self, message):
        """Send the message (bytes), now or as soon as there is room. Raises OSError if broken."""
        with self._lock:
            if self._behind:
                self._newest = message
                return
            sent = self._send(message)
            if sent == len(message):
                return
            self._begun, self._newest = (message[sent:], b"") if sent else (b"", message)
            self._behind = True
        threading.Thread(target=self._catch_up, daemon=True).start()

    def _catch_up(self):
        room = select.poll()
        try:
            room.register(self._socket, select.POLLOUT)
            while self._behind:
                room.poll()
                with self._lock:
                    self._send_some()
        except (OSError, ValueError):
            # The other side is gone, or the connection was closed here. The next write() says so.
            with self._lock:
                self._behind = False

    def _send_some(self):
        if self._begun:
            self._begun = self._begun[self._send(self._begun) :]
        elif self._newest:
            sent = self._send(self._newest)
            if sent:
                self._begun, self._newest = self._newest[sent:], b""
        else:
            self._behind = False

    def _send(self, data):
        """The number of bytes that the kernel has taken."""
        try:
            return self._socket.send(data, socket.MSG_DONTWAIT)
        except BlockingIOError:
            return 0
