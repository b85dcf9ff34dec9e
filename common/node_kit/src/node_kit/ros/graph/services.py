"""Services by name: their types, and calls with a timeout, which rospy's own lack."""

from __future__ import annotations

import socket
import struct
import threading
from contextlib import closing, contextmanager, suppress
from io import BytesIO
from typing import Any, Iterator
from urllib.parse import urlsplit

import rosgraph
import rospy
from rosgraph.network import (
    ROSHandshakeException,
    read_ros_handshake_header,
    write_ros_handshake_header,
)

from node_kit.errors import ServiceError
from node_kit.message_types import service_class
from node_kit.ros.graph.ros_api import call
from node_kit.rules.answer import Answer

PROBE_S = 5.0  # to wait for the type of a service
LONGEST_ANSWER = 50_000_000  # bytes
_READ = 65536  # bytes at a time


def kind_of(name: str) -> Any:
    """Return the class of a running service, from its header. Raises ServiceError."""
    with _connected(name, PROBE_S, probe="1") as (_, header):
        kind = service_class(header.get("type", ""))
    if kind is None:
        raise ServiceError(f"the package of {name} is not installed here")
    return kind


def call_service(name: str, request: Any, kind: Any, timeout_s: float) -> Any:
    """Call a service of the class `kind`; return its response. Raises ServiceError."""
    buffer = BytesIO()
    request.serialize(buffer)
    data = buffer.getvalue()
    with _connected(name, timeout_s, md5sum=kind._md5sum) as (connection, _):
        connection.sendall(struct.pack("<I", len(data)) + data)
        is_well, size = struct.unpack("<BI", _read(connection, 5))
        if size > LONGEST_ANSWER:
            raise ServiceError(f"{name} answers with {size} bytes")
        answer = _read(connection, size)
    if not is_well:
        raise ServiceError(answer.decode(errors="replace") or f"{name} reports a failure")
    try:
        return kind._response_class().deserialize(answer)
    except Exception:  # malformed bytes may raise anything
        raise ServiceError(f"the answer of {name} is malformed") from None


@contextmanager
def _connected(
    name: str, timeout_s: float, **fields: str
) -> Iterator[tuple[socket.socket, dict[str, str]]]:
    """Yield a connection, which is closed after the timeout, and the header of the service."""
    answer, uri = call(rosgraph.get_master_uri(), "lookupService", name, timeout_s=timeout_s)
    if answer is not Answer.WELL:
        raise ServiceError(f"there is no service {name}")
    has_ended = threading.Event()

    def end(connection: socket.socket) -> None:
        has_ended.set()
        with suppress(OSError):
            connection.shutdown(socket.SHUT_RDWR)

    try:
        where = urlsplit(str(uri))
        address = where.hostname or "", where.port or 0
        with closing(socket.create_connection(address, timeout_s)) as connection:
            timer = threading.Timer(timeout_s, end, [connection])
            timer.daemon = True
            timer.start()
            try:
                about = {"callerid": rospy.get_name(), "service": name, "md5sum": "*", **fields}
                write_ros_handshake_header(connection, about)
                header = read_ros_handshake_header(connection, BytesIO(), _READ)
                if "error" in header:
                    raise ServiceError(header["error"])
                yield connection, header
            finally:
                timer.cancel()
    except (OSError, ValueError, struct.error, ROSHandshakeException) as error:
        if has_ended.is_set() or isinstance(error, socket.timeout):
            raise ServiceError(f"{name} has not answered for {timeout_s:g} s") from None
        raise ServiceError(f"the connection to {name} has ended without an answer") from None


def _read(connection: socket.socket, size: int) -> bytes:
    """Return the next `size` bytes. Raises OSError."""
    data = bytearray()
    while len(data) < size:
        part = connection.recv(min(_READ, size - len(data)))
        if not part:
            raise ConnectionError
        data += part
    return bytes(data)
