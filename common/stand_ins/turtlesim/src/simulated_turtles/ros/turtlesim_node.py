"""The node turtlesim: ROS and a window around the rules in field.py."""

from __future__ import annotations

import base64
import math
import os
import threading
import time
from typing import Any

import rospy
from geometry_msgs.msg import Twist
from std_srvs.srv import Empty
from turtlesim import srv
from turtlesim.msg import Color, Pose

from node_kit.ros.rospy_patches.questions import answer
from simulated_turtles.field import SIZE, Field
from simulated_turtles.services import OF_TURTLES, SERVICES

PERIOD_S = 0.016  # 62.5 Hz
BACKGROUND = {"background_r": 69, "background_g": 86, "background_b": 255}


class Turtlesim:
    """The turtles, which drive and draw.

    Subscribers, of each turtle: NAME/cmd_vel (geometry_msgs/Twist). Publishers, at 62.5 Hz:
    NAME/pose (turtlesim/Pose), NAME/color_sensor (turtlesim/Color). Services: clear, reset
    (std_srvs/Empty), spawn, kill, NAME/set_pen, NAME/teleport_absolute, NAME/teleport_relative.
    Parameters, read at the start and by clear and reset: ~background_r (69), ~background_g (86),
    ~background_b (255). As upstream, time is real, whatever /use_sim_time says.
    """

    def __init__(self, given: dict[str, Any]) -> None:
        """Start with turtle1; given: private parameters."""
        for name, default in BACKGROUND.items():
            rospy.set_param(f"~{name}", given.get(name, default))
        rospy.loginfo(f"Starting turtlesim with node name {rospy.get_name()}")
        self._lock = threading.RLock()
        self._field = Field(background, time.monotonic())
        self._ends: dict[str, list[Any]] = {}  # topics and services of each turtle
        self._open_and_close()
        self._services = [self._serve(service) for service in SERVICES]
        answer("picture", self._picture)

    def _picture(self, known: int) -> tuple[int, str]:
        """Return the version of the picture, and a PNG in base64 unless the version is known."""
        with self._lock:
            version = self._field.version
            png = b"" if version == known else self._field.picture("PNG")
        return version, base64.b64encode(png).decode()

    def _serve(self, name: str) -> rospy.Service:
        kind = getattr(srv, name.rpartition("/")[2].title().replace("_", ""), Empty)

        def handle(request: Any) -> Any:
            try:
                return self._call(name, **{f: getattr(request, f) for f in request.__slots__}) or {}
            except ValueError as error:
                rospy.logerr(str(error))
                raise rospy.ServiceException(str(error)) from None

        return rospy.Service(name, kind, handle)

    def _call(self, service: str, **values: Any) -> str | None:
        with self._lock:
            text = self._field.call(service, values, time.monotonic())
            self._open_and_close()
        return text

    def _open_and_close(self) -> None:
        """Open and close topics and services to match the turtles of the field."""
        for name in self._ends.keys() - self._field.turtles.keys():
            for end in self._ends.pop(name):
                end.shutdown() if isinstance(end, rospy.Service) else end.unregister()
        for name in self._field.turtles.keys() - self._ends.keys():
            self._ends[name] = [
                rospy.Publisher(f"{name}/pose", Pose, queue_size=1),
                rospy.Publisher(f"{name}/color_sensor", Color, queue_size=1),
                rospy.Subscriber(f"{name}/cmd_vel", Twist, self._command, name, queue_size=1),
                *(self._serve(f"{name}/{service}") for service in OF_TURTLES),
            ]

    def _command(self, twist: Twist, name: str) -> None:
        velocity = {"ahead": twist.linear.x, "left": twist.linear.y, "turn": twist.angular.z}
        try:
            self._call(f"{name}/command", **velocity)
        except ValueError as error:
            rospy.logwarn_throttle(1.0, f"{name}/cmd_vel is ignored: {error}")

    def spin(self) -> None:
        """Drive, publish and draw until the node is shut down or its window is closed."""
        (window, image), shown = open_window(), -1
        while not rospy.is_shutdown():
            with self._lock:
                self._field.step(time.monotonic())
                for name, turtle in self._field.turtles.items():
                    pose, color, *_ = self._ends[name]
                    pose.publish(*turtle.pose)
                    color.publish(*turtle.seen)
                if window and shown != self._field.version:
                    image.put(self._field.picture("PPM"))
                    shown = self._field.version
                if window:
                    window.update()
            time.sleep(PERIOD_S - time.monotonic() % PERIOD_S)


def background() -> tuple[int, ...]:
    """Return the background (r, g, b) in the parameters, read as roscpp reads whole numbers."""
    given = ((rospy.get_param(f"~{name}", None), value) for name, value in BACKGROUND.items())
    return tuple(whole(value, default) & 255 for value, default in given)


def whole(value: Any, default: int) -> int:
    """Return a number as an int32, or the default for other values, such as true and false.

    Halves are rounded up; all negative numbers are rounded down.
    """
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return default
    if not abs(value) < 2**31:  # or NaN; roscpp returns INT_MIN
        return 0
    return math.floor(value) if math.fmod(value, 1.0) < 0.5 else math.ceil(value)


def open_window() -> tuple[Any, Any]:
    """Return a window and its image, for the main thread, or (None, None) without a screen."""
    try:
        import tkinter  # noqa: PLC0415

        root = tkinter.Tk(className="turtlesim")
    except Exception as error:  # ImportError, or TclError, whose module may be missing
        if os.environ.get("DISPLAY"):
            rospy.logwarn(f"no window, which needs python3-tk and a screen: {error}")
        return None, None
    root.title("TurtleSim")
    root.resizable(False, False)
    root.protocol("WM_DELETE_WINDOW", lambda: rospy.signal_shutdown("its window is closed"))
    image = tkinter.PhotoImage(width=SIZE, height=SIZE)
    tkinter.Label(root, image=image, borderwidth=0).pack()
    return root, image
