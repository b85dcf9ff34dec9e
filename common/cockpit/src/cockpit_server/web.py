"""HTTP and WebSocket: rights and bounds of requests."""

from __future__ import annotations

import asyncio
import logging
import socket
import time
from pathlib import Path
from typing import Any, Awaitable

import rospkg
from tornado.httpserver import HTTPServer
from tornado.iostream import StreamClosedError
from tornado.web import Application, RequestHandler, StaticFileHandler
from tornado.websocket import WebSocketClosedError, WebSocketHandler

from cockpit_server.access import Access, without_token
from cockpit_server.admission import connection_to_close, page_to_close
from cockpit_server.clients import Client, name_of
from cockpit_server.hub import Hub
from cockpit_server.schema import LONGEST_MESSAGE
from node_kit.rospy_patches.newest_only import CUT_AFTER_RESENDS, resends

CHARTS = Path("/usr/share/javascript/dygraphs")
MOST_CLIENTS = 64  # a class, each with a page and a phone
MOST_CONNECTIONS = 256  # each takes a file descriptor, of which a process may have 1024
LONGEST_IDLE_S = 20.0  # a connection on which nothing is asked
PING_S = 1.0  # a page that does not answer three of them is closed
MOST_PINGS = 100  # unanswered, per page
MOST_FRAGMENTS = 64  # per message: browsers send ours in one piece
LONGEST_HEADER = 16384  # bytes
LONGEST_BODY = 1024  # bytes; nothing is uploaded
# What waits in the kernel for a page that does not read [bytes]; the kernel doubles it.
SEND_BUFFER = 65536
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
    """Answers requests that come from this page and name this machine; slows busy addresses."""

    def set_default_headers(self) -> None:
        for name, value in HEADERS.items():
            self.set_header(name, value)

    async def prepare(self) -> None:
        host, access = self.request.host, self.settings["access"]
        await asyncio.sleep(self.settings["hub"].request_wait_s(self.address))
        if not access.may_come(self.address):
            self.refuse(403, NOT_PUBLISHED.format(address=self.address))
        elif not access.may_request(host, self.request.headers.get("Origin")):
            self.refuse(403, "not an address of the cockpit: open the one that it printed")
        else:
            self.set_header("Content-Security-Policy", POLICY.format(host=host))

    @property
    def address(self) -> str:
        return str(self.request.remote_ip)

    @property
    def role(self) -> Any:
        return self.settings["access"].role(self.get_query_argument("token", None))

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
    async def prepare(self) -> None:
        await super().prepare()
        if not self._finished:
            self.refuse(404, "nothing here")


class _Files(_Guarded, StaticFileHandler):
    def set_extra_headers(self, path: str) -> None:
        self.set_header("Cache-Control", "no-cache")


class _Socket(_Guarded, WebSocketHandler):
    """The connection between a page and the Hub."""

    client: Any = None
    stream: Any
    ws_connection: Any
    pings = fragments = 0

    async def get(self, *_: Any, **__: Any) -> None:
        origin = self.request.headers.get("Origin")
        if not self.settings["access"].may_connect(self.request.host, origin):
            self.refuse(403, "only this cockpit's own page may connect")
        elif self.role is None:
            self.refuse(403, NO_TOKEN)
        elif not self.has_room(self.settings["hub"]):
            self.refuse(503, f"{MOST_CLIENTS} pages are open: close one, or try again later")
        else:
            await super().get()

    def has_room(self, hub: Hub) -> bool:
        """Return whether one more page may be opened, for which a viewer may be closed."""
        pages = list(hub.clients.values())
        if len(pages) < MOST_CLIENTS:
            return True
        page = page_to_close(pages, self.role, self.address, time.monotonic())
        if page is None:
            return False
        hub.leave(page)
        page.close()
        return True

    def get_compression_options(self) -> dict[str, int]:
        # RFC 7692: a class that drives takes a quarter; little memory for each page.
        return {"compression_level": 1, "mem_level": 4}

    def check_origin(self, origin: str) -> bool:
        return True  # get() has looked at it

    def open(self, *_: Any, **__: Any) -> None:
        self.set_nodelay(True)
        self.stream = self.ws_connection.stream
        self.stream.socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, SEND_BUFFER)
        self.settings["pages"].add(self.stream)
        self.limit_fragments(self.ws_connection)
        hub = self.settings["hub"]
        name = name_of(self.request.headers.get("User-Agent", ""), self.address)
        self.client = Client(
            hub.number(), self.role, name, self.send, self.stream.writing, self.is_cut,
            self.stream.close, self.address,
        )  # fmt: skip
        hub.join(self.client)

    def limit_fragments(self, connection: Any) -> None:
        """Close a page whose message never ends: tornado reports only whole ones."""
        receive = connection._receive_frame

        async def receive_frame() -> None:
            await receive()
            is_whole = getattr(connection, "_fragmented_message_buffer", None) is None
            self.fragments = 0 if is_whole else self.fragments + 1
            if self.fragments > MOST_FRAGMENTS:
                self.stream.close()

        connection._receive_frame = receive_frame

    def send(self, text: str) -> None:
        try:
            self.write_message(text)
        except (WebSocketClosedError, StreamClosedError):
            pass  # on_close() comes

    def is_cut(self) -> bool:
        return not self.stream.closed() and resends(self.stream.socket) >= CUT_AFTER_RESENDS

    def on_message(self, message: Any) -> Awaitable[None] | None:
        hub = self.settings["hub"]
        wait_s = hub.wait_s(self.client)
        if not wait_s:
            return hub.hear(self.client, message)
        return self.hear_later(wait_s, message)

    async def hear_later(self, wait_s: float, message: Any) -> None:
        # Meanwhile tornado reads nothing more of this page: TCP holds the sender up.
        await asyncio.sleep(wait_s)
        self.settings["hub"].hear(self.client, message)

    def on_pong(self, data: bytes) -> Awaitable[None] | None:  # type: ignore[override]
        # Most of many pongs were not asked for; each costs as much as a message.
        wait_s = self.settings["hub"].wait_s(self.client)
        return asyncio.sleep(wait_s) if wait_s else None

    def on_ping(self, data: bytes) -> None:
        # Tornado has answered already. A page's script can send no ping, and a program that sends
        # many may leave the answers unread: they would pile up here.
        self.pings += 1
        if self.pings > MOST_PINGS:
            self.stream.close()

    def on_close(self) -> None:
        self.settings["pages"].discard(self.stream)
        if self.client:
            self.settings["hub"].leave(self.client)


class _Server(HTTPServer):
    """Bounds the connections; closes one that is not used for a new one."""

    def initialize(self, application: Application, **more: Any) -> None:  # type: ignore[override]
        super().initialize(application, **more)
        self._pages = application.settings["pages"]
        self._streams: dict[Any, str] = {}  # stream -> its address, the oldest first

    def handle_stream(self, stream: Any, address: tuple[str, int]) -> None:
        self._streams = {one: its for one, its in self._streams.items() if not one.closed()}
        if len(self._streams) >= MOST_CONNECTIONS:
            unused = [pair for pair in self._streams.items() if pair[0] not in self._pages]
            oldest = connection_to_close(unused)
            if oldest is None:
                stream.close()
                return
            oldest.close()
            del self._streams[oldest]
        self._streams[stream] = address[0]
        super().handle_stream(stream, address)


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
            (r"/lib/(dygraph\.min\.js|dygraph\.css)", _Files, {"path": str(CHARTS)}),
        ],
        default_handler_class=_Nothing,
        access=access,
        hub=hub,
        page=page,
        pages=set(),  # streams that are a page's
        websocket_max_message_size=LONGEST_MESSAGE,
        websocket_ping_interval=PING_S,
        websocket_ping_timeout=3 * PING_S,
        log_function=lambda handler: None,
    )
    return _Server(
        application,
        idle_connection_timeout=LONGEST_IDLE_S,
        body_timeout=LONGEST_IDLE_S,
        max_header_size=LONGEST_HEADER,
        max_body_size=LONGEST_BODY,
        max_buffer_size=4 * LONGEST_HEADER,
    )


def _hide_token(record: logging.LogRecord) -> bool:
    record.msg, record.args = without_token(record.getMessage()), None
    return True
