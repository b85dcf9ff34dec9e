#!/usr/bin/python3
"""Publishes on 2,000 topics: 1,000 messages a second on /fast, 10 MB each second on /big.

Prints "ready", then each second how many messages went to /fast in how long [s], in total.
"""

import time

import rospy
from std_msgs.msg import String, UInt8MultiArray

TOPICS, RATE_HZ, BIG_BYTES = 2000, 1000, 10_000_000
rospy.init_node("many_topics")
idle = [rospy.Publisher(f"/idle_{k}", String, queue_size=1) for k in range(TOPICS - 2)]
fast = rospy.Publisher("/fast", String, queue_size=RATE_HZ)
big = rospy.Publisher("/big", UInt8MultiArray, queue_size=1)
print("ready", flush=True)
message, start_s, count = UInt8MultiArray(data=bytes(BIG_BYTES)), time.monotonic(), 0
while not rospy.is_shutdown():
    fast.publish("x")
    count += 1
    if count % RATE_HZ == 0:
        big.publish(message)
        print(count, time.monotonic() - start_s, flush=True)
    time.sleep(max(0.0, start_s + count / RATE_HZ - time.monotonic()))
