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
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import wait_for

AXES, BUTTONS = 6, 12  # the F710 in D mode
LAUNCH = ("roslaunch", "joy2twist", "launch_joy_node.launch", "rviz:=false", "cockpit:=false")


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


class JoystickTest(RosTest):
    """A test case with a FIFO in place of a joystick, and every message of /joy."""

    def setUp(self):
        self.stream = Stream()
        self.addCleanup(self.stream.remove)
        self.joys = []
        self._subscriber = self.hear("joy", Joy, self.joys.append)

    def start_driver(self, *parameters):
        """Start joy_node, which reads the FIFO; parameters as ~name:=value without the ~."""
        if rospy.has_param("/joy_node"):
            rospy.delete_param("/joy_node")  # left by the previous test: the master keeps them
        given = [f"_{parameter}" for parameter in (f"dev:={self.stream.path}", *parameters)]
        return self.start(node_path("gamepad", "joy_node"), *given)

    def plug_in(self, **axes):
        """Plug the gamepad in once the driver is connected; wait for its first message."""
        wait_for(self._subscriber.get_num_connections, "connection")
        self.stream.plug_in(**axes)
        wait_for(lambda: self.last, "first message")

    @property
    def last(self):
        """(axes, buttons held) of the newest message, or None."""
        if not self.joys:
            return None
        joy = self.joys[-1]
        return tuple(joy.axes), [n for n, held in enumerate(joy.buttons) if held]
