"""Passes connections on to the SDK; changes the subprotocol's name and the SDK's metadata.

foxglove-sdk 0.30 accepts only the name foxglove.sdk.v1. Lichtblick and npm's @foxglove/ws-protocol
offer only foxglove.websocket.v1, whose messages are the same.
"""

from __future__ import annotations

import asyncio
import contextlib
import re
import socket
import ssl
from typing import Callable

OLD, NEW = b"foxglove.websocket.v1", b"foxglove.sdk.v1"
HEAD_S = 10.0  # for a request and its answer; asyncio limits each to 64 kB
_END = b"\r\n\r\n"
_NAMES = re.compile(rb"(?im)^sec-websocket-protocol:.*$")
CLOSE = b"\x88\x02\x03\xe8"  # a close frame with the code 1000, which the SDK never sends
_CHUNK = 1 << 18  # bytes
# Clients publish goals only to a server that names a ROS; the SDK for Python has no metadata.
_LIBRARY, _ROS = re.compile(rb'"fg-library":"[^"]{8,}"'), b'"ROS_DISTRO":"noetic"'
_Change = Callable[[bytes], bytes]
_ENDS = (OSError, EOFError, asyncio.TimeoutError, asyncio.LimitOverrunError)


def renamed(head: bytes, old: bytes, new: bytes) -> bytes:
    """Return the head of a request or an answer, with another name of the subprotocol."""
    return _NAMES.sub(lambda line: line[0].replace(old, new), head)


def is_old(request: bytes) -> bool:
    """Return whether a request offers only the old name of the subprotocol."""
    offered = b"".join(_NAMES.findall(request))
    return OLD in offered and NEW not in offered


def with_ros(greeting: bytes) -> bytes:
    """Return the first message of the SDK, of the same length, with ROS 1 for its library."""
    return _LIBRARY.sub(lambda part: _ROS.ljust(len(part[0])), greeting, count=1)


async def serve(
    listener: socket.socket, server_port: int, limit: int, tls: ssl.SSLContext | None
) -> None:
    """Relay what connects to a listener, until cancelled.

    limit: the bytes kept for a client that does not read. Then no more is read from the SDK, which
    drops the oldest messages. tls: ends here.
    """

    async def relay(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        with contextlib.suppress(*_ENDS), contextlib.closing(writer):
            writer.transport.set_write_buffer_limits(limit)
            request = await asyncio.wait_for(reader.readuntil(_END), HEAD_S)
            from_sdk, to_sdk = await asyncio.open_connection("127.0.0.1", server_port)
            with contextlib.closing(to_sdk):
                to_sdk.write(renamed(request, OLD, NEW) if is_old(request) else request)
                answer = await asyncio.wait_for(from_sdk.readuntil(_END), HEAD_S)
                writer.write(renamed(answer, NEW, OLD) if is_old(request) else answer)
                ways = [_pass_on(reader, to_sdk), _pass_on(from_sdk, writer, with_ros)]
                tasks = [asyncio.ensure_future(way) for way in ways]
                await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
                for task in tasks:
                    task.cancel()
                if answer.startswith(b"HTTP/1.1 101"):
                    writer.write(CLOSE)

    # What is wrong with a connection, such as its TLS, concerns that client alone.
    asyncio.get_running_loop().set_exception_handler(lambda *_: None)
    server = await asyncio.start_server(relay, sock=listener, ssl=tls)
    await server.serve_forever()


async def _pass_on(
    reader: asyncio.StreamReader, writer: asyncio.StreamWriter, change: _Change = bytes
) -> None:
    with contextlib.suppress(OSError):
        while True:
            data = change(await reader.read(_CHUNK))
            if not data:
                return
            change = bytes  # only the first part is changed
            writer.write(data)
            await writer.drain()
