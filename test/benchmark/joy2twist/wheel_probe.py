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
DEADLINE_S = 5.0

awaited, shown = [0.0], threading.Event()


def on_odometry(odometry):
    if abs(odometry.twist.twist.linear.x - awaited[0]) < NEAR:
        shown.set()


def push(speed):
    """Move the stick, forward is negative; how long the wheels take [s]."""
    shown.clear()
    awaited[0] = speed
    began_s = time.monotonic()
    stream.send((AXIS, FORWARD, round(-FULL * speed)))
    if not shown.wait(DEADLINE_S):
        sys.exit("wheel_probe.py: the wheels do not follow")
    return time.monotonic() - began_s


rospy.init_node("wheel_probe")
odometry = rospy.Subscriber("odom", Odometry, on_odometry, tcp_nodelay=True)
stream = Stream()
try:
    with driver(stream.path, "deadzone:=0"):
        stream.plug_in()
        wait_for(odometry.get_num_connections, "robot")
        time.sleep(1.0)  # the other connections settle; the node that arms sees all released
        stream.send((BUTTON, LB, 1))
        gc.freeze()
        latencies_s = []
        for number in range(int(sys.argv[1])):
            time.sleep(random.uniform(0.03, 0.06))  # any moment of the periods on the way
            latencies_s.append(push(SPEEDS[number % 2]))
finally:
    stream.remove()
print(json.dumps(sorted(latencies_s)))
