#!/usr/bin/python3
"""Viewers that send what the schema allows, as fast as the server takes it.

flood.py PORT TOKEN VIEWERS SECONDS -> JSON, one line when all are connected and one at the end:
messages sent and received, and how many connections the server has closed.
"""

import asyncio
import json
import random
import sys
import time

from tornado.websocket import WebSocketClosedError, websocket_connect

from tutorial_testing.socket_page import GOOD, request

WATCH = {"kind": "watch", **GOOD["watch"], "graph": True, "node": "/fake_turtlebot",
         "fields": [f"/odom/pose/covariance[{i}]" for i in range(10)], "bag": True}  # fmt: skip
# What costs most, each as often as all others together.
WORST = [
    {"kind": "bag_open", "name": "joy.bag"},
    {"kind": "bag_open", "name": "no.bag"},
    {"kind": "doctor"},
    *({**WATCH, "topic": topic, "look": "x" * 200} for topic in ("/tf", "/no/such/topic")),
]
OTHERS = [{"kind": kind, **fields} for kind, fields in GOOD.items()]
READERS = 5  # a sixth viewer reads nothing


class Flood:
    def __init__(self, port, token):
        self.port, self.token = port, token
        self.counts = {"sent": 0, "received": 0, "closed": 0}

    async def read(self, socket):
        while await socket.read_message() is not None:
            self.counts["received"] += 1
        self.counts["closed"] += 1

    async def send(self, socket, dice, end):
        while time.monotonic() < end:
            message = dice.choice([*WORST, dice.choice(OTHERS)])
            try:
                await asyncio.wait_for(socket.write_message(json.dumps(message)), 5)
                self.counts["sent"] += 1
            except (WebSocketClosedError, asyncio.TimeoutError):
                await asyncio.sleep(0.01)

    async def run(self, viewers, seconds):
        requests = [request(self.port, self.token) for _ in range(viewers)]
        sockets = [await websocket_connect(one) for one in requests]
        tasks = [self.read(one) for i, one in enumerate(sockets) if i % (READERS + 1) != READERS]
        readers = [asyncio.ensure_future(task) for task in tasks]
        print("ready", flush=True)
        end = time.monotonic() + seconds
        senders = [self.send(one, random.Random(i), end) for i, one in enumerate(sockets)]
        await asyncio.gather(*senders)
        for reader in readers:
            reader.cancel()
        print(json.dumps(self.counts), flush=True)


if __name__ == "__main__":
    given_port, given_token, count, length_s = sys.argv[1:]
    asyncio.run(Flood(given_port, given_token).run(int(count), float(length_s)))
