"""Passes connections on to the SDK, and renames the WebSocket's subprotocol on the way.

foxglove-sdk 0.30 accepts only the name foxglove.sdk.v1. Lichtblick and npm's @foxglove/ws-protocol
offer only foxglove.websocket.v1, whose messages are the same.
"""

from __future__ import annotations

import asyncio
import contextlib
import re
import socket
import ssl
import threading

OLD, NEW = b"foxglove.websocket.v1", b"foxglove.sdk.v1"
HEAD_S = 10.0  # for a request and its answer; asyncio limits each to 64 kB
_END = b"\r\n\r\n"
_NAMES = re.compile(rb"(?im)^sec-websocket-protocol:.*$")
_CHUNK = 1 << 18  # bytes


def renamed(head: bytes, old: bytes, new: bytes) -> bytes:
    """Return the head of a request or an answer, with another name of the subprotocol."""
    return _NAMES.sub(lambda line: line[0].replace(old, new), head)


def is_old(request: bytes) -> bool:
    """Return whether a request offers only the old name of the subprotocol."""
    offered = b"".join(_NAMES.findall(request))
    return OLD in offered and NEW not in offered


class Relay:
    """Relays in a thread of its own; tls, if any, ends here.

    send_buffer_limit: the bytes that it keeps for a client that does not read; then it reads no
    more from the SDK, which drops the oldest messages.
    """

    def __init__(
        self, listener: socket.socket, server_port: int, limit: int, tls: ssl.SSLContext | None
    ) -> None:
        self._listener, self._server_port, self._limit, self._tls = (
            listener,
            server_port,
            limit,
            tls,
        )
        threading.Thread(target=lambda: asyncio.run(self._serve()), daemon=True).start()

    async def _serve(self) -> None:
        # What is wrong with a connection, such as its TLS, concerns that client alone.
        asyncio.get_running_loop().set_exception_handler(lambda *_: None)
        server = await asyncio.start_server(self._relay, sock=self._listener, ssl=self._tls)
        await server.serve_forever()

    async def _relay(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        with contextlib.closing(writer), contextlib.suppress(
            OSError, EOFError, asyncio.TimeoutError, asyncio.LimitOverrunError
        ):
            writer.transport.set_write_buffer_limits(self._limit)
            request = await asyncio.wait_for(reader.readuntil(_END), HEAD_S)
            from_sdk, to_sdk = await asyncio.open_connection("127.0.0.1", self._server_port)
            with contextlib.closing(to_sdk):
                to_sdk.write(renamed(request, OLD, NEW) if is_old(request) else request)
                answer = await asyncio.wait_for(from_sdk.readuntil(_END), HEAD_S)
                writer.write(renamed(answer, NEW, OLD) if is_old(request) else answer)
                ways = _pass_on(reader, to_sdk), _pass_on(from_sdk, writer)
                tasks = [asyncio.ensure_future(way) for way in ways]
                await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
                for task in tasks:
                    task.cancel()


async def _pass_on(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
    with contextlib.suppress(OSError):
        while data := await reader.read(_CHUNK):
            writer.write(data)
            await writer.drain()
