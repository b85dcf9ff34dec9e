#!/usr/bin/python3
"""A burst of joystick events, and the least that a program can do to follow it.

    joystick_burst.py send COUNT FIFO ...      prints the time [s] of each event
    joystick_burst.py follow INTERVAL_S FIFO   prints times [s] and values, as the driver would

Processes of their own: the threads of a ROS node would hold them up. The second one is the measure
of what this machine can do at the moment.
"""

import select
import struct
import sys
import time

from gamepad.js_event import AXIS, JsEvent, pack

EVENTS_PER_S = 1000


def send(count, *paths):
    """Axis 0 is at 1, 2, ... count."""
    fifos = [open(path, "wb", buffering=0) for path in paths]  # noqa: SIM115  until the end
    began, sent = time.monotonic(), []
    for step in range(1, int(count) + 1):
        # A late event is followed by the next ones without a pause.
        time.sleep(max(0.0, began + step / EVENTS_PER_S - time.monotonic()))
        sent.append(time.time())
        for fifo in fifos:
            fifo.write(pack(JsEvent(0, step, AXIS, 0)))
    print(*sent)


def follow(interval_s, path):
    """Print the newest value an interval after the first that is not printed yet."""
    printed, newest, due = [], None, None
    with open(path, "rb", buffering=0) as fifo:
        while True:
            timeout = None if due is None else max(0.0, due - time.monotonic())
            if select.select([fifo], (), (), timeout)[0]:
                data = fifo.read(512)
                if not data:
                    break
                newest = list(struct.iter_unpack("=IhBB", data))[-1][1]
                due = due or time.monotonic() + float(interval_s)
            if due and time.monotonic() >= due:
                printed += [time.time(), newest]
                due = None
    print(*printed)


if __name__ == "__main__":
    {"send": send, "follow": follow}[sys.argv[1]](*sys.argv[2:])
