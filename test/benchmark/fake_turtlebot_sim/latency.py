#!/usr/bin/python3
"""Sends commands at random moments and prints how long /odom takes to show each [s], as JSON."""

import json
import random
import sys
import threading
import time

import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry

DEADLINE_S = 5.0


shown, awaited = threading.Event(), [None]


def on_odom(odometry):
    if odometry.twist.twist.angular.z == awaited[0]:
        shown.set()


rospy.init_node("latency")
rospy.Subscriber("odom", Odometry, on_odom, tcp_nodelay=True)
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1, tcp_nodelay=True)
while not cmd_vel.get_num_connections():
    time.sleep(0.05)
time.sleep(1.0)  # the other connections of this process settle
latencies, rng = [], random.Random(1)
for k in range(int(sys.argv[1])):
    command = Twist()
    awaited[0] = command.angular.z = 0.001 * (k + 1)
    shown.clear()
    time.sleep(rng.uniform(0.05, 0.1))  # any moment of the period
    began_s = time.monotonic()
    cmd_vel.publish(command)
    if not shown.wait(DEADLINE_S):
        sys.exit("latency.py: /odom does not show the command")
    latencies.append(time.monotonic() - began_s)
print(json.dumps(latencies))
