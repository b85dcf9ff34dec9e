"""A separate master, the bridge, a held stick, and the velocities that the bridge carries."""

import os
import struct
import threading
import time
from contextlib import contextmanager

import rospy
from sensor_msgs.msg import Joy

from node_kit.ros.rospy_patches.connections import sender_of
from tutorial_testing.nodes import init_node
from tutorial_testing.processes import REPOSITORY, Program, command_line, descendants, free_port
from tutorial_testing.waiting import wait_for

CLASS = REPOSITORY / "common/ros2_tutorials/ros2_tutorials/new_joy2twist.py"
RATE = 50.0  # [Hz]
BRIDGE = "/ros2_bridge"
SIDES = {"ROS 1": "ros2_bridge.ros.ros1_side", "ROS 2": "ros2_bridge.ros.ros2_side"}
ZERO = (0.0, 0.0)  # velocity [m/s, rad/s]
REST_S = 0.62  # after which a robot without a driver is at rest, within a tolerance()


@contextmanager
def own_master():
    """Provide a master and a domain of ROS 2 for this process alone, which becomes a node."""
    port = free_port()
    os.environ["ROS_MASTER_URI"] = f"http://127.0.0.1:{port}"
    os.environ["ROS_DOMAIN_ID"] = str(1 + port % 100)
    with Program("roscore", "-p", str(port)) as core:
        wait_for(lambda: "started core service" in core.output, "master")
        init_node("test", disable_signals=True)
        yield
        rospy.signal_shutdown("the end")


def single(value):
    """Return a number rounded to float32."""
    return struct.unpack("f", struct.pack("f", value))[0]


class Bridge:
    def __init__(self, program):
        self.program = program
        wait_for(self.is_up, "both sides of the bridge")

    def process(self, side):
        """Return the id of a side's process; None if it does not run."""
        pids = descendants(self.program.pid)[1:]
        return next((pid for pid in pids if SIDES[side] in command_line(pid)), None)

    def is_up(self):
        assert not self.program.ended, self.program.output
        return all(map(self.process, SIDES))


class Stick:
    """Publishes Joys of which no two are alike, at an even rate, until it is released."""

    def __init__(self):
        self.sent = []
        self._publisher = rospy.Publisher("/joy", Joy, queue_size=10, tcp_nodelay=True)
        self._ends = threading.Event()
        self._thread = threading.Thread(target=self._push, daemon=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.end()
        self._publisher.unregister()

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
        """Stop publishing; return the time [s] of the end, as stamps have it."""
        self._ends.set()
        if self._thread.is_alive():
            self._thread.join()
        return time.time()


def carried(twists):
    return [(twist.linear.x, twist.angular.z) for twist in twists if sender_of(twist) == BRIDGE]


def wait_for_doctor(start, line):
    """Wait until the doctor prints it: the bridge reports its state twice a second."""

    def says():
        doctor = start("rosrun", "tutorial_tools", "doctor.py")
        doctor.wait()
        assert "Traceback" not in doctor.output
        return line in " ".join(doctor.output.split())

    wait_for(says, f"doctor's {line}")
