#!/usr/bin/python3
"""A person at the workstation, who holds an F710 in D mode as standard input says:

drive    LB and the stick forward
release  the stick still forward, LB not
neutral  neither

Each change is published at once, as a driver does, and printed: the word and the time [s].
"""

import select
import sys
import time

import rospy
from sensor_msgs.msg import Joy

from tutorial_testing.nodes import init_node

PERIOD_S = 0.02
FORWARD, LB = 1, 4  # indices of the axis and the button
HANDS = {"drive": (0.5, 1), "release": (0.5, 0), "neutral": (0.0, 0)}

# Without /rosout, which would ask the robot's master at every line, and hang when the cable is cut.
init_node("pilot", disable_rosout=True, disable_signals=True)
publisher = rospy.Publisher("joy", Joy, queue_size=1, tcp_nodelay=True)
joy, word = Joy(axes=[0.0] * 6, buttons=[0] * 12), "ready"
while word is not None:
    now = time.time()
    joy.header.stamp = rospy.Time.from_sec(now)
    publisher.publish(joy)
    if word:
        print(word, now, flush=True)
    word = ""
    if select.select([sys.stdin], [], [], PERIOD_S)[0]:
        word = sys.stdin.readline().strip() or None
        joy.axes[FORWARD], joy.buttons[LB] = HANDS.get(word, (0.0, 0))
