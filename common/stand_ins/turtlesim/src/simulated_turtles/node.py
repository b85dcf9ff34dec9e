"""The node turtlesim: ROS on one side, the rules of field.py on the other."""

from __future__ import annotations

import os
import threading
import time
from functools import partial
from typing import Any, Callable

import rospy
from geometry_msgs.msg import Twist
from std_srvs.srv import Empty
from turtlesim import srv
from turtlesim.msg import Color, Pose

from node_kit.start import run
from simulated_turtles.field import BACKGROUND, START, Field, State, background, wait_s
from simulated_turtles.paper import outline


class Turtlesim:
    """Turtles that drive and draw.

    Subscribers: NAME/cmd_vel (geometry_msgs/Twist) of each turtle. Publishers, at 62.5 Hz: NAME/pose
    (turtlesim/Pose), NAME/color_sensor (turtlesim/Color). Services: clear, reset (std_srvs/Empty),
    spawn, kill, NAME/set_pen, NAME/teleport_absolute, NAME/teleport_relative (turtlesim).
    Parameters, read at the start and by clear and reset: ~background_r (69), ~background_g (86),
    ~background_b (255). Time is the monotonic clock's, whatever /use_sim_time says, as upstream.
    """

    def __init__(self, given: dict[str, Any]) -> None:
        """Begin with turtle1; given: private parameters."""
        for name, default in BACKGROUND.items():
            rospy.set_param(f"~{name}", given.get(name, default))
        self._lock = threading.RLock()
        self._field = Field(self._background())
        self._ends: dict[str, tuple[Any, ...]] = {}  # what each turtle publishes, hears and serves
        rospy.loginfo(f"Starting turtlesim with node name {rospy.get_name()}")
        self._spawn("", *START)
        for name, kind, answer in (
            ("clear", Empty, self._clear),
            ("reset", Empty, self._reset),
            ("spawn", srv.Spawn, lambda one: self._spawn(one.name, one.x, one.y, one.theta)),
            ("kill", srv.Kill, self._kill),
        ):
            self._serve(name, kind, answer)

    def _serve(self, name: str, kind: Any, answer: Callable[[Any], Any]) -> rospy.Service:
        def handle(request: Any) -> Any:
            try:
                with self._lock:
                    return answer(request)
            except ValueError as error:
                rospy.logerr(str(error))
                raise rospy.ServiceException(str(error)) from None

        return rospy.Service(name, kind, handle)

    @staticmethod
    def _background() -> tuple[int, int, int]:
        return background({name: rospy.get_param(f"~{name}", None) for name in BACKGROUND})

    def _spawn(self, name: str, x: float, y: float, theta: float) -> srv.SpawnResponse:
        name = self._field.spawn(name, x, y, theta, time.monotonic())
        self._open_and_close()
        rospy.loginfo(f"Spawning turtle [{name}] at x=[{x:f}], y=[{y:f}], theta=[{theta:f}]")
        return srv.SpawnResponse(name)

    def _kill(self, request: srv.KillRequest) -> srv.KillResponse:
        self._field.kill(request.name)
        self._open_and_close()
        return srv.KillResponse()

    def _clear(self, _: object) -> object:
        rospy.loginfo("Clearing turtlesim.")
        self._field.paper.fill(self._background())
        return {}

    def _reset(self, _: object) -> object:
        rospy.loginfo("Resetting turtlesim.")
        name = self._field.reset(self._background(), time.monotonic())
        self._open_and_close()
        x, y, theta = START
        rospy.loginfo(f"Spawning turtle [{name}] at x=[{x:f}], y=[{y:f}], theta=[{theta:f}]")
        return {}

    def _open_and_close(self) -> None:
        """Have topics and services for exactly the turtles of the field."""
        for name in self._ends.keys() - self._field.turtles.keys():
            pose, color, commands, *services = self._ends.pop(name)
            for topic in (pose, color, commands):
                topic.unregister()
            for service in services:
                service.shutdown(f"turtle {name} is gone")
        for name in self._field.turtles.keys() - self._ends.keys():
            self._ends[name] = (
                rospy.Publisher(f"{name}/pose", Pose, queue_size=1),
                rospy.Publisher(f"{name}/color_sensor", Color, queue_size=1),
                rospy.Subscriber(f"{name}/cmd_vel", Twist, partial(self._command, name), queue_size=1),
                self._serve(f"{name}/set_pen", srv.SetPen, partial(self._set_pen, name)),
                self._serve(
                    f"{name}/teleport_absolute", srv.TeleportAbsolute, partial(self._jump_to, name)
                ),
                self._serve(
                    f"{name}/teleport_relative", srv.TeleportRelative, partial(self._jump_by, name)
                ),
            )

    def _command(self, name: str, twist: Twist) -> None:
        velocity = twist.linear.x, twist.linear.y, twist.angular.z
        try:
            with self._lock:
                if name in self._field.turtles:
                    self._field.turtles[name].command(*velocity, time.monotonic())
        except ValueError as error:
            rospy.logwarn_throttle(1.0, f"{name}/cmd_vel is ignored: {error}")

    def _set_pen(self, name: str, pen: srv.SetPenRequest) -> object:
        color = pen.r, pen.g, pen.b
        self._field.set_pen(name, color, pen.width, pen.off, time.monotonic())
        return {}

    def _jump_to(self, name: str, to: srv.TeleportAbsoluteRequest) -> object:
        self._field.teleport_absolute(name, to.x, to.y, to.theta, time.monotonic())
        return {}

    def _jump_by(self, name: str, by: srv.TeleportRelativeRequest) -> object:
        self._field.teleport_relative(name, by.linear, by.angular, time.monotonic())
        return {}

    def _step(self) -> list[State]:
        with self._lock:
            states = self._field.step(time.monotonic())
            for state in states:
                pose, color, *_ = self._ends[state.name]
                pose.publish(*state.pose)
                color.publish(*state.color)
        for state in states:
            if state.outside:
                place = "[x={:f}, y={:f}]".format(*state.outside)
                rospy.logwarn(f"Oh no! I hit the wall! (Clamping from {place})")
        return states

    def spin(self) -> None:
        """Drive, publish and show until the node or its window is closed."""
        window, due_s = open_window(), time.monotonic()
        while not rospy.is_shutdown() and (window is None or window.is_open):
            states = self._step()
            if window:
                with self._lock:
                    change = self._field.paper.take_changes()
                window.show(change, [outline(*state.pose[:3]) for state in states])
            pause_s, due_s = wait_s(due_s, time.monotonic())
            time.sleep(pause_s)
        if window:
            window.destroy()


def open_window() -> Any:
    """Return the window; None without a screen or python3-tk, which a line reports if DISPLAY is set."""
    if not os.environ.get("DISPLAY"):
        return None
    try:
        from simulated_turtles.window import Window  # noqa: PLC0415 - python3-tk may be missing

        return Window()
    except ImportError:
        rospy.logwarn("no window: sudo apt install python3-tk; the turtles run without it")
    except Exception as error:  # tkinter.TclError, of a module that may be missing
        rospy.logwarn(f"no window: {error}; the turtles run without it")
    return None


def main() -> int:
    """Run the node; return its exit code."""
    return run("turtlesim", dict, lambda given: Turtlesim(given).spin())
