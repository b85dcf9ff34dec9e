#!/usr/bin/python3
"""Viewers that send what the schema allows, as fast as the server accepts it.

flood.py PORT TOKEN VIEWERS SECONDS: prints "ready" once all are connected, and how many they sent.
"""

import asyncio
import json
import random
import sys
import time

from tornado.websocket import WebSocketClosedError, websocket_connect

from tutorial_testing.socket_page import GOOD, page_request

WATCH = {"kind": "watch", **GOOD["watch"], "graph": True,
         "fields": [f"/odom/pose/covariance[{i}]" for i in range(10)], "bag": True}  # fmt: skip
# The most expensive messages, each sent as often as all others together.
WORST = [
    {"kind": "bag_open", "name": "joy.bag"},
    {"kind": "bag_open", "name": "no.bag"},
    {"kind": "doctor"},
    *({**WATCH, "topic": topic, "look": "x" * 200} for topic in ("/tf", "/no/such/topic")),
]
OTHERS = [{"kind": kind, **fields} for kind, fields in GOOD.items()]
READERS = 5  # a sixth viewer reads nothing


async def read(socket):
    while await socket.read_message() is not None:
        pass


async def send(socket, dice, end):
    sent = 0
    while time.monotonic() < end:
        message = dice.choice([*WORST, dice.choice(OTHERS)])
        try:
            await asyncio.wait_for(socket.write_message(json.dumps(message)), 5)
            sent += 1
        except (WebSocketClosedError, asyncio.TimeoutError):
            await asyncio.sleep(0.01)
    return sent


async def flood(port, token, viewers, seconds):
    requests = [page_request(port, token) for _ in range(viewers)]
    sockets = [await websocket_connect(request) for request in requests]
    tasks = [read(socket) for i, socket in enumerate(sockets) if i % (READERS + 1) != READERS]
    readers = [asyncio.ensure_future(task) for task in tasks]
    print("ready", flush=True)
    end = time.monotonic() + seconds
    sent = await asyncio.gather(*(send(s, random.Random(i), end) for i, s in enumerate(sockets)))
    for reader in readers:
        reader.cancel()
    print(sum(sent), flush=True)


if __name__ == "__main__":
    given_port, given_token, count, length_s = sys.argv[1:]
    asyncio.run(flood(given_port, given_token, int(count), float(length_s)))
