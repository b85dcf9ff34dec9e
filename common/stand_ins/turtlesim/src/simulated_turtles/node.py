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
from simulated_turtles.turtle import Turtle


class Turtlesim:
    """Turtles that drive and draw.

    Subscribers, of each turtle: NAME/cmd_vel (geometry_msgs/Twist). Publishers, at 62.5 Hz:
    NAME/pose (turtlesim/Pose), NAME/color_sensor (turtlesim/Color). Services: clear, reset
    (std_srvs/Empty), spawn, kill, NAME/set_pen, NAME/teleport_absolute, NAME/teleport_relative.
    Parameters, read at the start and by clear and reset: ~background_r (69), ~background_g (86),
    ~background_b (255). Time is the monotonic clock's, whatever /use_sim_time says, as upstream.
    """

    def __init__(self, given: dict[str, Any]) -> None:
        """Begin with turtle1; given: private parameters."""
        for name, default in BACKGROUND.items():
            rospy.set_param(f"~{name}", given.get(name, default))
        self._lock = threading.RLock()
        self._field = Field(self._background())
        self._ends: dict[str, list[Any]] = {}  # each turtle's ends of topics and services
        rospy.loginfo(f"Starting turtlesim with node name {rospy.get_name()}")
        self._spawn("", *START)
        self._serve("clear", Empty, self._clear)
        self._serve("reset", Empty, self._reset)
        self._serve("spawn", srv.Spawn, lambda a: {"name": self._spawn(a.name, a.x, a.y, a.theta)})
        self._serve("kill", srv.Kill, self._kill)

    def _serve(self, name: str, kind: Any, answer: Callable[[Any], Any]) -> rospy.Service:
        def handle(request: Any) -> Any:
            try:
                with self._lock:
                    return answer(request) or {}
            except ValueError as error:
                rospy.logerr(str(error))
                raise rospy.ServiceException(str(error)) from None

        return rospy.Service(name, kind, handle)

    @staticmethod
    def _background() -> tuple[int, int, int]:
        return background({name: rospy.get_param(f"~{name}", None) for name in BACKGROUND})

    def _clear(self, _: object) -> None:
        rospy.loginfo("Clearing turtlesim.")
        self._field.paper.fill(self._background())

    def _reset(self, _: object) -> None:
        rospy.loginfo("Resetting turtlesim.")
        self._field.reset(self._background())
        self._spawn("", *START)

    def _spawn(self, name: str, x: float, y: float, theta: float) -> str:
        name = self._field.spawn(name, x, y, theta, time.monotonic())
        self._open_and_close()
        rospy.loginfo(f"Spawning turtle [{name}] at x=[{x:f}], y=[{y:f}], theta=[{theta:f}]")
        return name

    def _kill(self, request: srv.KillRequest) -> None:
        self._field.kill(request.name)
        self._open_and_close()

    def _open_and_close(self) -> None:
        """Have topics and services for exactly the turtles of the field."""
        turtles = self._field.turtles
        for name in self._ends.keys() - turtles.keys():
            for end in self._ends.pop(name):
                end.shutdown() if isinstance(end, rospy.Service) else end.unregister()
        for name in turtles.keys() - self._ends.keys():
            self._ends[name] = [
                rospy.Publisher(f"{name}/pose", Pose, queue_size=1),
                rospy.Publisher(f"{name}/color_sensor", Color, queue_size=1),
                rospy.Subscriber(f"{name}/cmd_vel", Twist, self._command, name, queue_size=1),
            ]
            for service, kind, answer in (
                ("set_pen", srv.SetPen, self._set_pen),
                ("teleport_absolute", srv.TeleportAbsolute, self._jump_to),
                ("teleport_relative", srv.TeleportRelative, self._jump_by),
            ):
                answers = partial(self._of_turtle, name, answer)
                self._ends[name].append(self._serve(f"{name}/{service}", kind, answers))

    def _of_turtle(self, name: str, answer: Callable[[Turtle, Any], None], request: Any) -> None:
        if name not in self._field.turtles:  # killed meanwhile
            raise ValueError(f"there is no turtle [{name}]")
        answer(self._field.turtles[name], request)

    def _set_pen(self, turtle: Turtle, pen: srv.SetPenRequest) -> None:
        color = pen.r, pen.g, pen.b
        self._field.set_pen(turtle, color, pen.width, pen.off, time.monotonic())

    def _jump_to(self, turtle: Turtle, to: srv.TeleportAbsoluteRequest) -> None:
        jump = partial(turtle.jump_to, to.x, to.y, to.theta)
        self._field.teleport(turtle, jump, time.monotonic())

    def _jump_by(self, turtle: Turtle, by: srv.TeleportRelativeRequest) -> None:
        jump = partial(turtle.jump_by, by.linear, by.angular)
        self._field.teleport(turtle, jump, time.monotonic())

    def _command(self, twist: Twist, name: str) -> None:
        try:
            with self._lock:
                if name in self._field.turtles:
                    velocity = twist.linear.x, twist.linear.y, twist.angular.z
                    self._field.turtles[name].command(*velocity, time.monotonic())
        except ValueError as error:
            rospy.logwarn_throttle(1.0, f"{name}/cmd_vel is ignored: {error}")

    def _step(self) -> list[State]:
        with self._lock:
            states = self._field.step(time.monotonic())
            for state in states:
                pose, color, *_ = self._ends[state.name]
                pose.publish(*state.pose)
                color.publish(*state.color)
        for place in filter(None, (state.outside for state in states)):
            words = "[x={:f}, y={:f}]".format(*place)
            rospy.logwarn(f"Oh no! I hit the wall! (Clamping from {words})")
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


def open_window() -> Any:
    """Return the window; None without a screen, or in a line why there is none."""
    try:
        if os.environ.get("DISPLAY"):
            from simulated_turtles.window import Window  # noqa: PLC0415 - it needs python3-tk

            return Window()
    except Exception as error:  # ImportError, or TclError of the module that may be missing
        rospy.logwarn(f"no window, for which python3-tk and a screen are needed: {error}")
    return None


def main() -> int:
    """Run the node; return its exit code."""
    return run("turtlesim", dict, lambda given: Turtlesim(given).spin())
