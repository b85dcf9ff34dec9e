#!/usr/bin/python3
"""Looks at all robots as a page does. viewer.py PORT SECONDS -> JSON, one line when it begins.

"frames": in a second, over the time; "longest": gap between two frames [s]. With "stalled" in place
of SECONDS it connects, looks at everything and reads nothing.
"""

import asyncio
import json
import sys
import time

from tornado.httpclient import HTTPRequest
from tornado.websocket import websocket_connect

LOOK = {"kind": "watch", "robots": True, "look": "robot_1", "graph": True, "log": True}


async def main(port, seconds):
    headers = {"Origin": f"http://127.0.0.1:{port}"}
    request = HTTPRequest(f"ws://127.0.0.1:{port}/ws", headers=headers)
    socket = await websocket_connect(request)
    socket.write_message(json.dumps(LOOK))
    if seconds == "stalled":
        print("ready", flush=True)
        time.sleep(3600)  # with the loop: nothing is read
    frames, began, last, longest = 0, None, None, 0.0
    while began is None or last - began < float(seconds):
        message = await socket.read_message()
        if not message.startswith('{"kind":"robots"') or (not began and "robot_1" not in message):
            continue
        now = time.monotonic()
        if began is None:
            began = last = now
            print("ready", flush=True)
            continue
        frames, longest, last = frames + 1, max(longest, now - last), now
    print(json.dumps({"frames": frames / (last - began), "longest": longest}))


asyncio.run(main(sys.argv[1], sys.argv[2]))
