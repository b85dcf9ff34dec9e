"""The connection of the two sides: frames over a Unix socket. Runs in the Python of either ROS.

Frames that cannot be sent at once wait, up to the depth of their topic; beyond that the oldest are
dropped. Topics take turns. So the newest velocity never waits behind old ones.
"""

from __future__ import annotations

import ctypes
import pickle
import signal
import socket
import threading
import time
from collections import OrderedDict, deque
from contextlib import suppress
from typing import Callable, Iterator, NamedTuple

PR_SET_PDEATHSIG = 1  # linux/prctl.h
BUFFER_BYTES = 1 << 16  # small, as frames in the kernel's buffer cannot be dropped


class Frame(NamedTuple):
    """A message between the two sides.

    Without a topic it is a sign of life; data: a line for each topic that cannot be carried.
    """

    topic: str
    type: str  # package/msg/Name, as in ROS 2; "": the last latched sender has exited
    data: bytes
    stamp_s: float  # monotonic clock, which both sides share
    is_latched: bool = False
    announces: bool = False  # no message, but the topic exists, so subscribers find it

    def packed(self) -> bytes:
        """Return the bytes of the frame as a tuple: the other side has this class elsewhere."""
        return pickle.dumps(tuple(self))


def frames(connection: socket.socket) -> Iterator[Frame]:
    """Yield the frames that arrive, until the other side closes the connection."""
    # Reset: the other side exited with frames unread; the other two: in the middle of a frame.
    ends = ConnectionResetError, EOFError, pickle.UnpicklingError
    with connection.makefile("rb", buffering=1 << 18) as stream, suppress(*ends):
        while True:
            yield Frame(*pickle.load(stream))


class Sender:
    """Sends frames in a thread; put() never waits."""

    def __init__(self, connection: socket.socket, depth_of: Callable[[str], int]) -> None:
        """depth_of: how many messages of a topic may wait."""
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, BUFFER_BYTES)
        self._connection, self._depth_of = connection, depth_of
        self._waiting: OrderedDict[str, deque[Frame]] = OrderedDict()
        self._changed = threading.Condition()
        self._has_ended = False
        threading.Thread(target=self._send, daemon=True).start()

    def put(self, frame: Frame) -> None:
        """Send a frame as soon as possible."""
        with self._changed:
            if frame.topic not in self._waiting:
                self._waiting[frame.topic] = deque(maxlen=self._depth_of(frame.topic))
            self._waiting[frame.topic].append(frame)
            self._changed.notify()

    def end(self) -> None:
        """Send nothing more."""
        with self._changed:
            self._has_ended = True
            self._changed.notify()

    def _next(self) -> Frame | None:
        with self._changed:
            while not self._has_ended:
                for topic, waiting in self._waiting.items():
                    if waiting:
                        self._waiting.move_to_end(topic)
                        return waiting.popleft()
                self._changed.wait()
        return None

    def _send(self) -> None:
        with suppress(OSError):  # the other side has exited; frames() ends, too
            for frame in iter(self._next, None):
                self._connection.sendall(frame.packed())


def end_with_parent() -> None:
    """Make this process exit when its parent exits."""
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGTERM)


def is_late(frame: Frame, longest_s: float) -> bool:
    """Return whether a frame is older than it may be. longest_s: 0 allows any age."""
    return bool(longest_s) and time.monotonic() - frame.stamp_s > longest_s
