"""Simulated time: /clock, 100 times a second, which jumps and stands still when told.

Told by lines `step SECONDS` and `pause SECONDS`.
"""

import sys
import threading
import time

import rospy
from rosgraph_msgs.msg import Clock

from tutorial_testing.nodes import init_node

PERIOD_S = 0.01


def main():
    """Publish until the standard input ends."""
    init_node("simulated_clock", disable_signals=True, disable_rosout=True)
    publisher = rospy.Publisher("/clock", Clock, queue_size=10, tcp_nodelay=True)
    offset = [time.time() - time.monotonic()]
    until = [0.0]

    def tick():
        while True:
            now = time.monotonic()
            if now >= until[0]:
                publisher.publish(Clock(rospy.Time.from_sec(now + offset[0])))
            time.sleep(PERIOD_S)

    threading.Thread(target=tick, daemon=True).start()
    print("ready", flush=True)
    for line in sys.stdin:
        word, seconds = line.split()
        if word == "step":
            offset[0] += float(seconds)
        else:
            until[0] = time.monotonic() + float(seconds)
            offset[0] -= float(seconds)


if __name__ == "__main__":
    main()
