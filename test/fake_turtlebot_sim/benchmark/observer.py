#!/usr/bin/python3
"""Subscribe to topics for a while and print what arrived, as JSON.

    observer.py SECONDS TOPIC ...

For each topic: {"stamps": [ns], "arrivals": [ns, monotonic]}. Only the stamp is read from the
bytes: decoding the messages would take more time than the simulation does.
"""

import json
import struct
import sys
import time

import rospy

# These begin with a Header: seq, secs, nsecs. In TFMessage a length comes first.
HEADED = ("nav_msgs/Odometry", "sensor_msgs/JointState", "kobuki_msgs/SensorState")
STAMP = {**dict.fromkeys(HEADED, 4), "tf2_msgs/TFMessage": 8}

seconds, topics = float(sys.argv[1]), sys.argv[2:]
rospy.init_node("observer", anonymous=True)
heard = {topic: {"stamps": [], "arrivals": []} for topic in topics}


def on_message(message, record):
    record["arrivals"].append(time.monotonic_ns())
    offset = STAMP.get(message._connection_header["type"])
    if offset is not None:
        secs, nsecs = struct.unpack_from("<II", message._buff, offset)
        record["stamps"].append(secs * 10**9 + nsecs)


for topic, record in heard.items():
    rospy.Subscriber(topic, rospy.AnyMsg, on_message, record, tcp_nodelay=True)
while not all(record["arrivals"] for record in heard.values()):
    time.sleep(0.05)
for record in heard.values():
    record["stamps"].clear()
    record["arrivals"].clear()
print("ready", flush=True)
time.sleep(seconds)
print(json.dumps(heard), flush=True)
