"""A master of its own, a stick that is held, and what the wheels say."""

import os
import struct
import threading
import time
from contextlib import contextmanager
from pathlib import Path

import rospy
from sensor_msgs.msg import Joy

from tutorial_testing.nodes import init_node
from tutorial_testing.ports import free_port
from tutorial_testing.processes import Program
from tutorial_testing.waiting import BUSY_S, wait_for

REPOSITORY = Path(__file__).resolve().parents[2]
CLASS = REPOSITORY / "common/ros2_tutorials/ros2_tutorials/new_joy2twist.py"
RATE = 50.0  # [Hz]
TIMEOUT_S, PERIOD_S = 0.6, 0.02  # of the simulated base
ZERO = (0.0, 0.0)  # velocity [m/s, rad/s]
REST_S = TIMEOUT_S + PERIOD_S + BUSY_S  # by then a robot without a driver stands


@contextmanager
def own_master():
    """Have a master and a domain of ROS 2 for this process alone, which is a node then."""
    port = free_port()
    os.environ["ROS_MASTER_URI"] = f"http://127.0.0.1:{port}"
    os.environ["ROS_DOMAIN_ID"] = str(1 + port % 100)
    with Program("roscore", "-p", str(port)) as core:
        wait_for(lambda: "started core service" in core.output, "master")
        init_node("test", disable_signals=True)
        yield
        rospy.signal_shutdown("the end")


def single(value):
    """A number as a float32 of the wire."""
    return struct.unpack("f", struct.pack("f", value))[0]


class Stick:
    """Publishes Joys of which no two are alike, at an even rate, until it is released."""

    def __init__(self):
        self.sent = []
        self._publisher = rospy.Publisher("/joy", Joy, queue_size=10, tcp_nodelay=True)
        self._ends = threading.Event()
        self._thread = threading.Thread(target=self._push, daemon=True)

    def wait_for_listener(self):
        wait_for(self._publisher.get_num_connections, "a subscriber of /joy")
        return self

    def begin(self):
        self._thread.start()
        return self

    def _push(self):
        due = time.monotonic()
        while not self._ends.is_set():
            number = len(self.sent)
            self.push(0.3 + 0.0001 * (number % 1000), 0.2 + 0.0002 * (number % 1000))
            due += 1 / RATE
            self._ends.wait(max(0.0, due - time.monotonic()))

    def push(self, turn, speed):
        """Publish one Joy; return the Twist that it becomes."""
        self.sent.append((single(speed), single(turn)))
        self._publisher.publish(Joy(axes=(turn, speed, 0, 0, 0, 0), buttons=[0] * 12))
        return self.sent[-1]

    def end(self):
        """Stop publishing; return when."""
        self._ends.set()
        if self._thread.is_alive():
            self._thread.join()
        return time.monotonic()


def moves(odometry):
    return abs(odometry.last.twist.twist.linear.x) > 0.01


def stands_after(odometry, since_s):
    """Wait until the robot stands; return how long that took [s]."""
    wait_for(lambda: not moves(odometry), "a robot that stands")
    moving = [when for when, _, odom in odometry.heard if abs(odom.twist.twist.linear.x) > 0.01]
    return moving[-1] - since_s
