"""A FIFO in place of a joystick device, and what joy_node makes of it."""

import contextlib
import os
import shutil
import tempfile
import time

import rospy
from sensor_msgs.msg import Joy

from gamepad.js_event import AXIS, BUTTON, INIT, JsEvent, pack
from tutorial_testing.nodes import node_path
from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for

AXES, BUTTONS = 6, 12  # of the F710 in D mode


class Stream:
    """The end of a FIFO into which the kernel's part is written."""

    def __init__(self):
        self._folder = tempfile.mkdtemp()
        self.path = os.path.join(self._folder, "js0")
        self._fd = None

    def plug_in(self, axes=AXES):
        """Make the device, wait for its reader, send it the state at opening: all zero."""
        os.mkfifo(self.path)
        self._fd = wait_for(self._open, "reader of the device")
        self.send(*[(BUTTON | INIT, n, 0) for n in range(BUTTONS)])
        self.send(*[(AXIS | INIT, n, 0) for n in range(axes)])

    def _open(self):
        with contextlib.suppress(OSError):  # no reader yet
            return os.open(self.path, os.O_WRONLY | os.O_NONBLOCK)

    def send(self, *events):
        """Send events as (type, number, value), in one write."""
        os.write(self._fd, b"".join([pack(JsEvent(0, v, kind, n)) for kind, n, v in events]))

    def pull_out(self):
        """Take the device away; return the ROS time [s] just before."""
        now = time.time()
        os.unlink(self.path)
        os.close(self._fd)
        self._fd = None
        return now

    def remove(self):
        """Leave nothing behind."""
        if self._fd is not None:
            os.close(self._fd)
        shutil.rmtree(self._folder)


class JoyLog:
    """Every message of /joy."""

    def __init__(self):
        self.messages = []
        self._subscriber = rospy.Subscriber("joy", Joy, self.messages.append, queue_size=1000)
        self.stop = self._subscriber.unregister

    @property
    def connected(self):
        """Whether a node publishes here."""
        return self._subscriber.get_num_connections() > 0

    @property
    def last(self):
        """(axes, buttons held) of the newest message, or None."""
        if not self.messages:
            return None
        joy = self.messages[-1]
        return tuple(joy.axes), [n for n, held in enumerate(joy.buttons) if held]


def driver(path, *parameters):
    """Start joy_node, reading a path; parameters as ~name:=value without the ~."""
    if rospy.has_param("/joy_node"):
        rospy.delete_param("/joy_node")  # of the test before: the master keeps them
    given = [f"_{parameter}" for parameter in (f"dev:={path}", *parameters)]
    return Program(node_path("gamepad", "joy_node"), *given)
