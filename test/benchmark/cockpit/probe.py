#!/usr/bin/python3
"""Times inputs of a page until their /cmd_vel comes, beside messages that are sent back.

probe.py COCKPIT_PORT ECHO_PORT COUNT [TOKEN] -> JSON: {"input": [s, ...], "echo": [s, ...],
"losses": how often the operator was lost, "stalls": how often the machine held up this program or
the echo, as it may hold up the cockpit}
"""

import asyncio
import gc
import json
import sys
import time

import rospy
from geometry_msgs.msg import Twist
from tornado.httpclient import HTTPRequest
from tornado.websocket import websocket_connect

STEP = 2.0**-12  # of the stick, from each input to the next: exact as float32
SCALE = 0.35  # m/s for a whole stick, as config/f710_d.yaml has it
PERIOD_S = 0.02  # a fast gamepad's; each input beside one message that is sent back
STALL_S = 0.1  # the server drops what is later (LATE_S of the seat)
sent_s, heard = {}, {"input": [], "echo": [], "losses": 0, "stalls": 0}


def on_twist(twist):
    began = sent_s.pop(round(twist.linear.x / SCALE / STEP), None)
    if began is not None:
        heard["input"].append(time.monotonic() - began)


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


async def connect(port, query=""):
    headers = {"Origin": f"http://127.0.0.1:{port}"}
    address = f"ws://127.0.0.1:{port}/ws{query}"
    socket = await websocket_connect(HTTPRequest(address, headers=headers))
    socket.protocol.set_nodelay(True)
    return socket


async def read_echo(socket):
    while True:
        took_s = time.monotonic() - float(await socket.read_message())
        heard["echo"].append(took_s)
        heard["stalls"] += took_s > STALL_S


async def pause(seconds):
    """Sleep, and notice where the scheduler let this program sleep for too long."""
    end = time.monotonic() + seconds
    await asyncio.sleep(seconds)
    heard["stalls"] += time.monotonic() - end > STALL_S


async def main(cockpit_port, echo_port, count, token=""):
    page, echo = Page(await connect(cockpit_port, f"?token={token}")), await connect(echo_port)
    tasks = [asyncio.ensure_future(page.read()), asyncio.ensure_future(read_echo(echo))]
    page.say("drive", robot="", mode="D")
    await page.release()
    for number in range(-20, count):  # all is warm from 0 on
        if not page.armed:
            heard["losses"] += 1
            await page.release()
        stick = number % 2000 + 500
        if number >= 0:
            sent_s[stick] = time.monotonic()
        page.input(stick * STEP, 1)
        await pause(PERIOD_S / 2)
        echo.write_message(str(time.monotonic()))
        await pause(PERIOD_S / 2)
    await asyncio.sleep(0.5)
    for task in tasks:
        task.cancel()


rospy.init_node("probe", disable_signals=True)
subscriber = rospy.Subscriber("/cmd_vel", Twist, on_twist, tcp_nodelay=True)
gc.freeze()
asyncio.run(main(*map(int, sys.argv[1:4]), *sys.argv[4:]))
print(json.dumps(heard))
