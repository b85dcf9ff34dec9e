#!/usr/bin/python3
"""Publishes Joy at a rate and times the Twist that comes back. probe.py RATE COUNT -> JSON."""

import gc
import json
import sys
import time

import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy

STEP = 2.0**-14  # of the stick, from each message to the next: exact as float32
rate, count = float(sys.argv[1]), int(sys.argv[2])
sent_s, latency_s = {}, {}


def on_twist(twist):
    now = time.monotonic()
    number = round(twist.linear.x / STEP)
    if number in sent_s:
        latency_s.setdefault(number, now - sent_s[number])


def send(stick):
    joy.header.stamp = rospy.Time.now()
    joy.axes[1] = stick
    publisher.publish(joy)


rospy.init_node("probe")
joy = Joy(axes=[0.0] * 6, buttons=[0] * 12)
publisher = rospy.Publisher("joy", Joy, queue_size=1)
publisher.impl.set_queue_size(None)
subscriber = rospy.Subscriber("cmd_vel", Twist, on_twist, tcp_nodelay=True)
while not (publisher.get_num_connections() and subscriber.get_num_connections()):
    time.sleep(0.01)
gc.freeze()
for held in (0, 1):  # released first: a node that arms waits for that
    joy.buttons[4] = held
    for _ in range(10):
        send(0.0)
        time.sleep(0.02)
start = time.monotonic()
for number in range(1, count + 1):
    time.sleep(max(0.0, start + number / rate - time.monotonic()))
    sent_s[number] = time.monotonic()
    send(number * STEP)
deadline = time.monotonic() + 5
while count not in latency_s and time.monotonic() < deadline:
    time.sleep(0.01)
print(json.dumps({"latency_s": sorted(latency_s.values()), "newest": count in latency_s}))
