"""HTTP and WebSocket: rights and bounds of requests."""

from __future__ import annotations

import asyncio
import logging
import os
import socket
from pathlib import Path
from typing import Any, Awaitable

import rospkg
from tornado.httpserver import HTTPServer
from tornado.iostream import StreamClosedError
from tornado.web import Application, RequestHandler, StaticFileHandler
from tornado.websocket import WebSocketClosedError, WebSocketHandler

from cockpit_server import limits
from cockpit_server.access import DRIVER, Access, without_token
from cockpit_server.clients import Client
from cockpit_server.io.hub import Hub
from node_kit.ros.rospy_patches.newest_only import CUT_AFTER_RESENDS, resends
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


class _Guarded(RequestHandler):
    """Answers requests that come from this page and name this machine; slows a flood of them."""

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


class _Page(_Guarded):
    """The page, for a valid token if one is needed."""

    def get(self) -> None:
        if self.role is None:
            self.refuse(403, NO_TOKEN)
            return
        self.set_header("Content-Type", "text/html; charset=utf-8")
        self.finish((self.settings["page"] / "index.html").read_bytes())


class _Nothing(_Guarded):
    def get(self) -> None:
        self.refuse(404, "nothing here")


class _Files(_Guarded, StaticFileHandler):
    def set_extra_headers(self, path: str) -> None:
        self.set_header("Cache-Control", "no-cache")


class _Socket(_Guarded, WebSocketHandler):
    """The connection between a page and the Hub."""

    client: Client
    stream: Any
    ws_connection: Any
    reads = 0  # since a message or a pong came

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
        # RFC 7692: a class that drives takes a quarter; little memory for each page.
        return {"compression_level": 1, "mem_level": 4}

    def check_origin(self, origin: str) -> bool:
        return True  # get() has looked at it

    def open(self, *_: Any, **__: Any) -> None:
        self.set_nodelay(True)
        self.stream = self.ws_connection.stream
        self.stream.socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, limits.SEND_BUFFER)
        self.settings["pages"].add(self.stream)
        self.bound_reads()
        self.client = Client(
            next(self.hub.page_numbers), str(self.role), self.address, self.send,
            self.stream.writing, self.is_cut, self.stream.close,
        )  # fmt: skip
        self.hub.join(self.client)

    def bound_reads(self) -> None:
        """Close a page that sends pings, or a message in pieces, without end.

        Tornado reports neither pieces nor the answers to pings, which would pile up unread.
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
            pass  # on_close() comes

    def is_cut(self) -> bool:
        return not self.stream.closed() and resends(self.stream.socket) >= CUT_AFTER_RESENDS

    def on_message(self, message: Any) -> Awaitable[None] | None:
        self.reads = 0
        wait_s = self.hub.wait_s(self.client)
        if wait_s:
            return self.hear_later(wait_s, message)
        self.hub.hear(self.client, message)
        return None

    async def hear_later(self, wait_s: float, message: Any) -> None:
        # Meanwhile tornado reads nothing more of this page: TCP holds the sender up.
        await asyncio.sleep(wait_s)
        self.hub.hear(self.client, message)

    def on_pong(self, data: bytes) -> Awaitable[None] | None:  # type: ignore[override]
        # Most of many pongs were not asked for; each costs as much as a message.
        self.reads = 0
        wait_s = self.hub.wait_s(self.client)
        return asyncio.sleep(wait_s) if wait_s else None

    def on_close(self) -> None:
        self.settings["pages"].discard(self.stream)
        if hasattr(self, "client"):
            self.hub.leave(self.client)


class _Server(HTTPServer):
    """Bounds the connections: the oldest one without a page makes room for a new one."""

    def initialize(self, application: Application, **more: Any) -> None:  # type: ignore[override]
        super().initialize(application, **more)
        self._pages = application.settings["pages"]
        self._streams: list[Any] = []  # the oldest first

    def handle_stream(self, stream: Any, address: tuple[str, int]) -> None:
        self._streams = [*(one for one in self._streams if not one.closed()), stream]
        if len(self._streams) > limits.MOST_CONNECTIONS:
            next(one for one in self._streams if one not in self._pages).close()
        if not stream.closed():
            super().handle_stream(stream, address)


def folder_of_charts() -> Path:
    """Return where dygraphs is: Debian's, or what ./tutorial has fetched where there is none."""
    fetched = Path(os.environ.get("TUTORIAL_RESULTS", ""), FETCHED)
    return OF_DEBIAN if OF_DEBIAN.exists() else fetched


def server(hub: Hub, access: Access) -> HTTPServer:
    """Return the HTTP server; it does not listen yet."""
    for name in ("tornado.access", "tornado.general"):
        logging.getLogger(name).setLevel(logging.CRITICAL)  # whatever strangers send is no news
    logging.getLogger("tornado.application").addFilter(_hide_token)
    page = Path(rospkg.RosPack().get_path("cockpit")) / "page"
    application = Application(
        [
            ("/", _Page),
            ("/ws", _Socket),
            (r"/page/([\w.-]+)", _Files, {"path": str(page)}),
            (r"/lib/(dygraph\.min\.js|dygraph\.css)", _Files, {"path": str(folder_of_charts())}),
        ],
        default_handler_class=_Nothing,
        access=access,
        hub=hub,
        page=page,
        pages=set(),  # streams that are a page's
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
