"""HTTP and WebSocket: which requests are answered, and how many."""

from __future__ import annotations

import asyncio
import gzip
import logging
import mimetypes
import os
import socket
from functools import lru_cache
from pathlib import Path
from typing import Any, Awaitable

from tornado.httpserver import HTTPServer
from tornado.iostream import StreamClosedError
from tornado.web import Application, RequestHandler
from tornado.websocket import WebSocketClosedError, WebSocketHandler

from cockpit_server import limits
from cockpit_server.access import DRIVER, Access, without_token
from cockpit_server.hub import Hub
from cockpit_server.pages import Page
from node_kit.io.newest_only import CUT_AFTER_RESENDS, resends
from tutorial_tools.io.command.charts import FETCHED, OF_DEBIAN

HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",  # the token is in the address
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Permissions-Policy": "gamepad=(self), camera=(), microphone=(), geolocation=()",
    "Cache-Control": "no-store",
    "Server": "cockpit",
}
NO_TOKEN = "open the address that the cockpit printed, with its token"
NOT_PUBLISHED = (
    "{address}: not the gateway of this container, through which its published port is reached. "
    "If it is your own machine, start the container with COCKPIT_PEERS={address}"
)
# connect-src: older browsers do not take a WebSocket for 'self'.
POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; "
    "connect-src 'self' ws://{host}; frame-ancestors 'none'; base-uri 'none'; form-action 'none'"
)


class _Checked(RequestHandler):
    """Requests that must come from this page and name this machine; a flood of them is delayed."""

    def set_default_headers(self) -> None:
        for name, value in HEADERS.items():
            self.set_header(name, value)

    async def prepare(self) -> None:
        host = self.request.host
        await asyncio.sleep(self.hub.request_wait_s())
        if not self.access.may_come(self.address):
            self.refuse(403, NOT_PUBLISHED.format(address=self.address))
        elif not self.access.may_request(host, self.request.headers.get("Origin")):
            self.refuse(403, "not an address of the cockpit: open the one that it printed")
        else:
            self.set_header("Content-Security-Policy", POLICY.format(host=host))

    @property
    def hub(self) -> Hub:
        return self.settings["hub"]

    @property
    def access(self) -> Access:
        return self.settings["access"]

    @property
    def address(self) -> str:
        return str(self.request.remote_ip)

    @property
    def role(self) -> str | None:
        return self.access.role(self.get_query_argument("token", None))

    def refuse(self, status: int, why: str) -> None:
        self.set_status(status)
        self.set_header("Content-Type", "text/plain; charset=utf-8")
        self.finish(f"{why}\n")

    def write_error(self, status_code: int, **_: Any) -> None:
        self.refuse(status_code, f"{status_code}: nothing here")


class _Index(_Checked):
    """The page, for a valid token where one is needed."""

    def get(self) -> None:
        if self.role is None:
            self.refuse(403, NO_TOKEN)
            return
        self.set_header("Content-Type", "text/html; charset=utf-8")
        self.finish((self.settings["folder"] / "index.html").read_bytes())


class _NotFound(_Checked):
    def get(self) -> None:
        self.refuse(404, "nothing here")


class _Files(_Checked):
    """The files of a folder. Tornado adds an ETag, so that browsers keep them."""

    def initialize(self, folder: Path) -> None:
        self._folder = folder

    def get(self, name: str) -> None:
        path = self._folder / name
        if not path.is_file():
            self.refuse(404, "nothing here")
            return
        self.set_header("Content-Type", mimetypes.guess_type(name)[0] or "text/plain")
        self.set_header("Cache-Control", "no-cache")
        self.set_header("Vary", "Accept-Encoding")
        data = path.read_bytes()
        if "gzip" in self.request.headers.get("Accept-Encoding", ""):
            self.set_header("Content-Encoding", "gzip")
            data = compressed(data)
        self.finish(data)


@lru_cache(maxsize=100)
def compressed(data: bytes) -> bytes:
    """Compress a file once: that takes a millisecond, and the page is a third as large."""
    return gzip.compress(data, mtime=0)


class _Socket(_Checked, WebSocketHandler):
    """The connection between a page and the Hub."""

    page: Page
    stream: Any
    ws_connection: Any
    reads = 0  # since the last message or pong

    async def get(self, *_: Any, **__: Any) -> None:
        role, origin = self.role, self.request.headers.get("Origin")
        if not self.access.may_connect(self.request.host, origin):
            self.refuse(403, "only this cockpit's own page may connect")
        elif role is None:
            self.refuse(403, NO_TOKEN)
        elif not self.hub.make_room(role == DRIVER):
            self.refuse(503, f"{limits.MOST_PAGES} pages are open: close one, or try again later")
        else:
            await super().get()

    def get_compression_options(self) -> dict[str, int]:
        # RFC 7692: it divides the traffic of a class by four, and needs little memory for a page.
        return {"compression_level": 1, "mem_level": 4}

    def check_origin(self, origin: str) -> bool:
        return True  # get() has checked it

    def open(self, *_: Any, **__: Any) -> None:
        self.set_nodelay(True)
        self.stream = self.ws_connection.stream
        self.stream.socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, limits.SEND_BUFFER)
        self.settings["streams_of_pages"].add(self.stream)
        self.bound_reads()
        self.page = Page(
            next(self.hub.page_numbers), str(self.role), self.address, self.send,
            self.stream.writing, self.is_cut, self.stream.close,
        )  # fmt: skip
        self.hub.join(self.page)

    def bound_reads(self) -> None:
        """Close a page that sends pings, or pieces of a message, without end.

        Tornado reports neither pieces nor pings, whose answers would pile up unread.
        """
        read_bytes = self.stream.read_bytes

        def counted(*how: Any, **more: Any) -> Awaitable[bytes]:
            self.reads += 1
            if self.reads > limits.MOST_READS:
                self.stream.close()
            return read_bytes(*how, **more)

        self.stream.read_bytes = counted

    def send(self, text: str) -> None:
        try:
            self.write_message(text)
        except (WebSocketClosedError, StreamClosedError):
            pass  # on_close() follows.

    def is_cut(self) -> bool:
        return not self.stream.closed() and resends(self.stream.socket) >= CUT_AFTER_RESENDS

    def on_message(self, message: Any) -> Awaitable[None] | None:
        self.reads = 0
        wait_s = self.hub.wait_s(self.page)
        if wait_s:
            return self.receive_later(wait_s, message)
        self.hub.receive(self.page, message)
        return None

    async def receive_later(self, wait_s: float, message: Any) -> None:
        # Meanwhile tornado reads nothing from this page, so that TCP slows the sender.
        await asyncio.sleep(wait_s)
        self.hub.receive(self.page, message)

    def on_pong(self, data: bytes) -> Awaitable[None] | None:  # type: ignore[override]
        # A page can send pongs without a ping; a pong costs as much as a message.
        self.reads = 0
        wait_s = self.hub.wait_s(self.page)
        return asyncio.sleep(wait_s) if wait_s else None

    def on_close(self) -> None:
        self.settings["streams_of_pages"].discard(self.stream)
        if hasattr(self, "page"):
            self.hub.leave(self.page)


class _Server(HTTPServer):
    """A server with a limit: a new connection replaces the oldest one that is not a page's."""

    def initialize(self, application: Application, **more: Any) -> None:  # type: ignore[override]
        super().initialize(application, **more)
        self._of_pages = application.settings["streams_of_pages"]
        self._streams: list[Any] = []  # the oldest first

    def handle_stream(self, stream: Any, address: tuple[str, int]) -> None:
        self._streams = [*(other for other in self._streams if not other.closed()), stream]
        if len(self._streams) > limits.MOST_CONNECTIONS:
            next(other for other in self._streams if other not in self._of_pages).close()
        if not stream.closed():
            super().handle_stream(stream, address)


def folder_of_charts() -> Path:
    """Return the folder of dygraphs: Debian's, or the one that ./tutorial has fetched."""
    fetched = Path(os.environ.get("TUTORIAL_RESULTS", ""), FETCHED)
    return OF_DEBIAN if OF_DEBIAN.exists() else fetched


def server(hub: Hub, access: Access, folder: Path) -> HTTPServer:
    """Return the HTTP server of the page in a folder; it does not listen yet."""
    for name in ("tornado.access", "tornado.general"):
        logging.getLogger(name).setLevel(logging.CRITICAL)  # Anyone could fill the log.
    logging.getLogger("tornado.application").addFilter(_hide_token)
    application = Application(
        [
            ("/", _Index),
            ("/ws", _Socket),
            (r"/page/([\w.-]+)", _Files, {"folder": folder}),
            (r"/lib/(dygraph\.min\.js|dygraph\.css)", _Files, {"folder": folder_of_charts()}),
        ],
        default_handler_class=_NotFound,
        access=access,
        hub=hub,
        folder=folder,
        streams_of_pages=set(),
        websocket_max_message_size=limits.LONGEST_MESSAGE,
        websocket_ping_interval=limits.PING_S,
        websocket_ping_timeout=3 * limits.PING_S,
        log_function=lambda handler: None,
    )
    return _Server(
        application,
        idle_connection_timeout=limits.LONGEST_IDLE_S,
        body_timeout=limits.LONGEST_IDLE_S,
        max_header_size=limits.LONGEST_HEADER,
        max_body_size=limits.LONGEST_BODY,
        max_buffer_size=4 * limits.LONGEST_HEADER,
    )


def _hide_token(record: logging.LogRecord) -> bool:
    record.msg, record.args = without_token(record.getMessage()), None
    return True
