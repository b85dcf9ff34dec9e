"""In ROS 2: print which quality of service the bridge chooses, and what its publishers keep."""

import socket
import struct
import sys
import time

import rclpy
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import String

sys.path.insert(0, sys.argv[1])  # the folder of ros2_bridge
from ros2_bridge.io.connection import Frame
from ros2_bridge.ros.ros2_side import Ros2Side, fitting
from ros2_bridge.routes import Route

KIND = "std_msgs/msg/String"
KEPT = QoSProfile(depth=9, durability=DurabilityPolicy.TRANSIENT_LOCAL)
PLAIN = QoSProfile(depth=9, durability=DurabilityPolicy.VOLATILE)
LOOSE = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
FORGET = Frame("/note", "", b"", 0.0, announces=True)


def note(text, is_latched=True):
    data = struct.pack("<I", len(text)) + text.encode()
    return Frame("/note", KIND, data, time.monotonic(), is_latched)


def kept_of(*carried):
    """Return the texts that a late subscriber gets, up to the text "end"."""
    node_end, bridge_end = socket.socketpair()
    with node_end, bridge_end:
        side, texts = Ros2Side([Route("/note", "to_ros2")], bridge_end), []
        node_end.sendall(b"".join(frame.packed() for frame in carried))
        node_end.shutdown(socket.SHUT_WR)
        side.carry(bridge_end)
        side.node.create_subscription(String, "/note", lambda text: texts.append(text.data), KEPT)
        while "end" not in texts:
            rclpy.spin_once(side.node, timeout_sec=0.1)
        side.node.destroy_node()
    return texts


rclpy.init()
for limit_s, is_own_kept, *offered in (
    (0.0, False, KEPT), (0.0, False, KEPT, PLAIN), (0.5, False, KEPT),
    (0.0, True, KEPT), (0.0, False, PLAIN, LOOSE),
):  # fmt: skip
    made = fitting(Route("/a", "both", 1, limit_s), offered, is_own_kept)
    print(made.durability.name, made.reliability.name)
print(*kept_of(note("latched"), note("not", False), note("end")))
print(*kept_of(note("gone"), FORGET, note("end")))
