#!/usr/bin/python3
"""A person at the workstation: an F710 in D mode, held as the words on standard input say.

drive    LB and the stick forward
release  the stick still forward, LB not
neutral  neither

A change is published at once, as a driver does, and printed: the word and the time [s].
"""

import sys
import threading
import time

import rospy
from sensor_msgs.msg import Joy

from tutorial_testing.nodes import init_node

PERIOD_S = 0.02
FORWARD, LB = 1, 4  # indices of the axis and the button
HANDS = {"drive": (0.5, 1), "release": (0.5, 0), "neutral": (0.0, 0)}


def main():
    # Without /rosout: to ask the robot's master something at every line would not survive a cut.
    init_node("pilot", disable_rosout=True, disable_signals=True)
    publisher = rospy.Publisher("joy", Joy, queue_size=1, tcp_nodelay=True)
    lock = threading.Lock()
    joy = Joy(axes=[0.0] * 6, buttons=[0] * 12)

    def publish():
        joy.header.stamp = rospy.Time.now()
        publisher.publish(joy)

    def repeat():
        while True:
            time.sleep(PERIOD_S)
            with lock:
                publish()

    threading.Thread(target=repeat, daemon=True).start()
    print("ready", time.time(), flush=True)
    for line in sys.stdin:
        with lock:
            joy.axes[FORWARD], joy.buttons[LB] = HANDS[line.strip()]
            now = time.time()
            publish()
        print(line.strip(), now, flush=True)


if __name__ == "__main__":
    main()
