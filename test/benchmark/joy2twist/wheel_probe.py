#!/usr/bin/python3
"""Moves a stick before joy_node and times the wheels that follow: wheel_probe.py COUNT -> JSON."""

import gc
import json
import random
import sys
import threading
import time

import rospy
from nav_msgs.msg import Odometry

from gamepad.js_event import AXIS, BUTTON, FULL
from tutorial_testing.joystick_stream import Stream, driver
from tutorial_testing.waiting import wait_for

LB, FORWARD = 4, 1
SPEEDS = (0.2, 0.4)  # by turns; every relay gives 1 m/s at full deflection
NEAR = 0.01
DEADLINE_S, REST_S = 5.0, 0.5

awaited, shown = [0.0], threading.Event()


def on_odometry(odometry):
    if abs(odometry.twist.twist.linear.x - awaited[0]) < NEAR:
        shown.set()


def push(speed, deadline_s=DEADLINE_S):
    """Move the stick, forward is negative; how long the wheels take [s], None if they do not."""
    shown.clear()
    awaited[0] = speed
    began_s = time.monotonic()
    stream.send((AXIS, FORWARD, round(-FULL * speed)))
    return time.monotonic() - began_s if shown.wait(deadline_s) else None


def drives():
    """Whether all nodes on the way are there; one that arms sees all released first."""
    stream.send((BUTTON, LB, 0), (AXIS, FORWARD, 0))
    time.sleep(REST_S)
    stream.send((BUTTON, LB, 1))
    return push(SPEEDS[1], deadline_s=1.0)


rospy.init_node("wheel_probe")
rospy.Subscriber("odom", Odometry, on_odometry, tcp_nodelay=True)
stream = Stream()
try:
    with driver(stream.path, "deadzone:=0"):
        stream.plug_in()
        wait_for(drives, "wheels that follow the stick")
        gc.freeze()
        latencies_s = []
        for number in range(int(sys.argv[1])):
            time.sleep(random.uniform(0.03, 0.06))  # any moment of the periods on the way
            latencies_s.append(push(SPEEDS[number % 2]))
finally:
    stream.remove()
if None in latencies_s:
    sys.exit("wheel_probe.py: the wheels do not follow")
print(json.dumps(sorted(latencies_s)))
