"""A client of Foxglove's protocol in Python, which uses a WebSocket in its own thread."""

import asyncio
import json
import struct
import threading

from tornado.httpclient import HTTPRequest
from tornado.websocket import websocket_connect

from tutorial_testing.processes import Started
from tutorial_testing.waiting import wait_for

MESSAGE, TIME, ANSWER, ASSET = 1, 2, 3, 4  # the first byte of what a server sends
OLD_NAME = "foxglove.websocket.v1"  # of the subprotocol


class SocketClient(Started):
    """A context manager. It subscribes by topic, and keeps what arrives."""

    def __init__(self, port, subprotocol=OLD_NAME, tls=None):
        """tls: the ssl.SSLContext, if any."""
        super().__init__()
        self._tls = tls
        self._port, self._subprotocol = port, subprotocol
        self.texts, self.times = [], []  # what arrived
        self._data, self._topics, self.answers, self.assets = [], {}, {}, []
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever, daemon=True)

    def begin(self):
        self._thread.start()
        self._stack.callback(self._end)
        asyncio.run_coroutine_threadsafe(self._connect(), self._loop).result(30)

    def _end(self):
        self.close()
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()
        self._loop.close()

    async def _connect(self):
        url = f"ws{'s' if self._tls else ''}://127.0.0.1:{self._port}"
        request = HTTPRequest(url, ssl_options=self._tls)
        self._socket = await websocket_connect(request, subprotocols=[self._subprotocol])
        self._reading = asyncio.ensure_future(self._read())

    async def _read(self):
        while True:
            message = await self._socket.read_message()
            if message is None:
                self.texts.append({"op": "closed"})
                return
            if isinstance(message, str):
                self.texts.append(json.loads(message))
            elif message[0] == TIME:
                self.times.append(struct.unpack_from("<Q", message, 1)[0])
            elif message[0] == MESSAGE:
                number, stamp = struct.unpack_from("<IQ", message, 1)
                self._data.append((self._topics[number], stamp, message[13:]))
            elif message[0] == ASSET:
                self.assets.append(message[1:])
            elif message[0] == ANSWER:
                number, length = struct.unpack_from("<II", message, 5)
                self.answers[number] = message[13 + length :]

    @property
    def subprotocol(self):
        return self._socket.selected_subprotocol

    @property
    def close_code(self):
        """The number in the close frame of the server, or None."""
        return self._socket.close_code

    def send(self, message):
        """Send bytes, a text, or a dict as JSON."""
        data = json.dumps(message) if isinstance(message, dict) else message
        self._loop.call_soon_threadsafe(self._write, data)

    def _write(self, data):
        self._socket.write_message(data, binary=isinstance(data, bytes))

    def close(self):
        self._loop.call_soon_threadsafe(self._socket.close)

    def cut(self):
        """Close the connection without a close frame, as a machine that is gone."""
        self._loop.call_soon_threadsafe(self._socket.stream.close)

    def stall(self):
        """Stop reading; tornado then reads no more than its buffers take."""
        self._loop.call_soon_threadsafe(self._reading.cancel)

    def of(self, operation):
        return [text for text in list(self.texts) if text["op"] == operation]

    def channel(self, topic):
        """Return the newest channel of a topic, once it is advertised."""

        def find():
            lists = [text["channels"] for text in reversed(self.of("advertise"))]
            return next((c for channels in lists for c in channels if c["topic"] == topic), None)

        return wait_for(find, f"channel {topic}")

    def subscribe(self, *topics):
        for topic in topics:
            channel, number = self.channel(topic), len(self._topics)
            self._topics[number] = topic
            wanted = [{"id": number, "channelId": channel["id"]}]
            self.send({"op": "subscribe", "subscriptions": wanted})

    def data(self, topic):
        """Return the bytes of a topic's messages until now."""
        return [data for about, _, data in list(self._data) if about == topic]

    def stamps(self, topic):
        """Return the log times [ns] of a topic's messages until now."""
        return [stamp for about, stamp, _ in list(self._data) if about == topic]

    def advertise(self, number, topic, kind, encoding="ros1"):
        about = {"id": number, "topic": topic, "encoding": encoding, "schemaName": kind}
        self.send({"op": "advertise", "channels": [about]})

    def publish(self, number, data):
        self.send(struct.pack("<BI", 1, number) + data)

    def statuses(self):
        return [text["message"] for text in self.of("status")]

    def call(self, service, number, data):
        """Call a service, once it is advertised."""

        def find():
            lists = [text["services"] for text in self.of("advertiseServices")]
            return next((s for services in lists for s in services if s["name"] == service), None)

        identity = wait_for(find, f"service {service}")["id"]
        self.send(struct.pack("<BIII", 2, identity, number, 4) + b"ros1" + data)
