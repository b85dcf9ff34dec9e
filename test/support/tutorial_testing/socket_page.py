"""A page of the cockpit without a browser, which uses a WebSocket in its own thread."""

import asyncio
import contextlib
import json
import threading
import time

from tornado.httpclient import HTTPClientError, HTTPRequest
from tornado.websocket import WebSocketClosedError, websocket_connect

from tutorial_testing.processes import Started
from tutorial_testing.waiting import wait_for

PERIOD_S = 0.05
REST = ([0.0] * 6, [0] * 12)
DRIVE = ([0.0, 1.0, 0.0, 0.0, 0.0, 0.0], [0, 0, 0, 0, 1] + [0] * 7)
# A valid message of each kind, without its kind.
GOOD = {
    "watch": {
        "robots": True, "look": None, "graph": False, "topic": "/odom",
        "fields": ["/odom/pose/pose/position/x"], "field_list": False, "log": True, "bag": False,
        "frames": ["odom", "base_link"],
        "bag_fields": ["/joy/axes[1]"],
    },
    "drive": {"robot": "", "mode": "D"},
    "stop": {},
    "hand_over": {"to": 3},
    "input": {
        "n": 1, "t": 12.5, "beat": 0, "axes": [0, 1, -1.0, 0, 0, 0], "buttons": [0] * 12,
        "pad": None, "source": "keys",
    },
    "release": {"why": "hidden"},
    "reset": {"robot": "robot_1"},
    "bag_open": {"name": "joy.bag"},
    "bag_play": {"topics": ["/joy"], "rate": 1, "loop": False, "robot": ""},
    "bag_pause": {},
    "bag_seek": {"position": 3.5},
    "record": {"on": False},
    "doctor": {},
    "describe": {"what": "message", "name": "std_msgs/String"},
    "publish": {"topic": "/x", "type": "std_msgs/String", "values": {"data": "a"}, "period": None},
    "call": {"service": "/x/reset", "values": {}},
    "set": {"parameter": "/x/rate", "values": {"value": "10"}},
    "again": {"n": 1, "t": 12.5, "beat": 0, "due": "/x"},
    "publish_end": {"topic": None},
}  # fmt: skip


def page_request(port, token=None, **headers):
    address = f"127.0.0.1:{port}"
    query = f"?token={token}" if token else ""
    headers = {"Origin": f"http://{address}", **headers}
    return HTTPRequest(f"ws://{address}/ws{query}", headers=headers)


class SocketPage(Started):
    """A context manager. While hand is not None, it sends that position as a page does; while signs
    has topics, also signs of life, as a page that publishes on them.
    """

    def __init__(self, port, token=None, **headers):
        super().__init__()
        self._request = page_request(port, token, **headers)
        self.messages = []  # all that arrived, except beats
        self.refusal = None  # HTTP status, where the WebSocket was refused
        self.hand, self.signs = None, ()
        self._beat, self._n = 0, 0
        self._socket = None
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
        self._loop.close()  # a loop is three files, and a process may have only 1024

    async def _connect(self):
        try:
            self._socket = await websocket_connect(self._request)
        except HTTPClientError as error:
            self.refusal = error.code
            return
        self._socket.protocol.set_nodelay(True)  # as browsers do
        self._tasks = [asyncio.ensure_future(self._read()), asyncio.ensure_future(self._send())]

    async def _read(self):
        while True:
            text = await self._socket.read_message()
            if text is None:
                self.messages.append({"kind": "closed"})
                return
            message = json.loads(text)
            if message["kind"] == "beat":
                self._beat = message["n"]
            else:
                self.messages.append(message)

    async def _send(self):
        while True:
            if self.hand is not None:
                self._write(self.input(*self.hand))
            for topic in self.signs:
                self._n += 1
                about = {"t": 1000 * time.monotonic(), "beat": self._beat, "due": topic}
                self._write({"kind": "again", "n": self._n, **about})
            await asyncio.sleep(PERIOD_S)

    def _write(self, fields):
        with contextlib.suppress(WebSocketClosedError):
            sent = self._socket.write_message(json.dumps(fields))
            sent.add_done_callback(lambda done: done.exception())  # it may be closed meanwhile

    def input(self, axes, buttons):
        self._n += 1
        return {"kind": "input", "n": self._n, "t": 1000 * time.monotonic(), "beat": self._beat,
                "axes": axes, "buttons": buttons, "pad": None, "source": "keys"}  # fmt: skip

    def say(self, kind, **fields):
        self._loop.call_soon_threadsafe(self._write, {"kind": kind, **fields})

    def close(self):
        if self._socket:
            self._loop.call_soon_threadsafe(self._socket.close)

    def of(self, kind):
        return [message for message in list(self.messages) if message["kind"] == kind]

    def wait_for(self, kind, fits=lambda message: True):
        return wait_for(lambda: next(filter(fits, self.of(kind)), None), f"message {kind}")

    def sit_down(self, then=REST):
        """Take the session, with a joystick that stays released until it is armed."""
        count = len(self.of("session"))
        self.say("drive", robot="", mode="D")
        self.hand = REST

        def is_armed():
            nonlocal count
            sessions = self.of("session")[count:]
            # The page before this one may have left only now.
            if sessions and sessions[-1]["driver"] is None:
                count += len(sessions)
                self.say("drive", robot="", mode="D")
            return any(session["yours"] and session["armed"] for session in sessions)

        wait_for(is_armed, "session that is armed")
        self.hand = then
