#!/usr/bin/python3
"""Times inputs of a page until their /cmd_vel comes.

probe.py COCKPIT_PORT COUNT TOKEN -> JSON: the times [s] of those that came.
"""

import asyncio
import gc
import json
import sys
import time

import rospy
from geometry_msgs.msg import Twist
from tornado.websocket import websocket_connect

from tutorial_testing.socket_page import request

STEP = 2.0**-12  # of the stick, from each input to the next: exact as float32
SCALE = 0.35  # m/s for a whole stick, as config/f710_d.yaml has it
PERIOD_S = 0.02  # a fast gamepad's
sent_s, heard_s = {}, []


def on_twist(twist):
    began = sent_s.pop(round(twist.linear.x / SCALE / STEP), None)
    if began is not None:
        heard_s.append(time.monotonic() - began)


class Page:
    def __init__(self, socket):
        self.socket, self.beat, self.number, self.armed = socket, 0, 0, False

    def say(self, kind, **fields):
        self.socket.write_message(json.dumps({"kind": kind, **fields}))

    def input(self, stick, held):
        self.number += 1
        axes, buttons = [0.0, stick, 0.0, 0.0, 0.0, 0.0], [0, 0, 0, 0, held] + [0] * 7
        self.say(
            "input", n=self.number, t=1000 * time.monotonic(), beat=self.beat, axes=axes,
            buttons=buttons, pad=None, source="keys",
        )  # fmt: skip

    async def read(self):
        while True:
            message = json.loads(await self.socket.read_message())
            if message["kind"] == "beat":
                self.beat = message["n"]
            elif message["kind"] == "seat":
                self.armed = message["yours"] and message["armed"]

    async def release(self):
        while not (self.armed and subscriber.get_num_connections()):
            self.input(0.0, 0)
            await asyncio.sleep(PERIOD_S)


async def main(port, count, token):
    socket = await websocket_connect(request(port, token))
    socket.protocol.set_nodelay(True)
    page = Page(socket)
    reader = asyncio.ensure_future(page.read())
    page.say("drive", robot="", mode="D")
    for number in range(-20, count):  # all is warm from 0 on
        if not page.armed:  # at first, and where a busy machine has lost the operator
            await page.release()
        stick = number % 2000 + 500
        if number >= 0:
            sent_s[stick] = time.monotonic()
        page.input(stick * STEP, 1)
        await asyncio.sleep(PERIOD_S)
    await asyncio.sleep(0.5)
    reader.cancel()


rospy.init_node("probe", disable_signals=True)
subscriber = rospy.Subscriber("/cmd_vel", Twist, on_twist, tcp_nodelay=True)
gc.freeze()
asyncio.run(main(int(sys.argv[1]), int(sys.argv[2]), sys.argv[3]))
print(json.dumps(heard_s))
