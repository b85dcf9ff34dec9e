"""The topics joy of robots: the driven robot's is published, and others are shown."""

from __future__ import annotations

from math import isfinite
from typing import Any, ClassVar, Sequence

import rospy
from sensor_msgs.msg import Joy

from cockpit_server.driving.driver_session import Axes, Buttons
from cockpit_server.graph import GraphWatcher, topic_of
from cockpit_server.messages import ReceivedMessage, Subscriptions, decoded
from cockpit_server.pages import Page, TabSource
from cockpit_server.ros.feeds import later_once
from cockpit_server.schema import or_null, text
from gamepad.liveness import Trembling
from node_kit.ros.rospy_patches.prompt_publisher import PromptPublisher

FRAME = "cockpit"
DIGITS = 4  # after the point
LONGEST_JOY = 4000  # bytes; a gamepad's message has some 100, and a huge one would delay the driver


def shown(data: bytes) -> dict[str, Any] | None:
    """Return {axes, buttons} of the bytes of a Joy; None if it is malformed or too long."""
    joy = decoded(Joy, data, LONGEST_JOY)
    if joy is None:
        return None
    axes = [round(value, DIGITS) if isfinite(value) else 0.0 for value in joy.axes]
    return {"axes": axes, "buttons": list(joy.buttons)}


class Joysticks(TabSource):
    """The publisher of the driven robot's joystick, and the newest messages of those in sight."""

    watches: ClassVar = {"look": (or_null(text), None)}

    def __init__(self, subscriptions: Subscriptions, graphs: GraphWatcher, own_name: str) -> None:
        self._subscriptions, self._graphs, self._own_name = subscriptions, graphs, own_name
        self._driven: str | None = None  # the robot that is driven from a page
        self._publishers: dict[str, PromptPublisher] = {}  # by robot; at most one
        self._trembling = Trembling()
        self._message = Joy()
        self._message.header.frame_id = FRAME
        # topic -> (arrival of the newest message [s], what pages receive of it)
        self._newest: dict[str, tuple[float, dict[str, Any] | None]] = {}
        self._rivals: dict[str, tuple[str, float]] = {}  # topic -> (node, newest message [s])

    def advertise(self, robot: str | None) -> None:
        """Advertise the topic of this robot only, or none, so that the graph shows what drives."""
        if robot != self._driven:
            self._driven = robot
            later_once(self._update_publisher)

    def _update_publisher(self) -> None:
        robot = self._driven
        for other in set(self._publishers) - {robot}:
            self._publishers.pop(other).end()
        if robot is not None and robot not in self._publishers:
            self._publishers[robot] = PromptPublisher(topic_of(robot, "joy"), Joy)

    def is_connected(self, robot: str) -> bool:
        """Return whether all subscribers of the driven robot's joystick are connected."""
        publisher = self._publishers.get(robot)
        subscribers = self._graphs.graph.joystick_subscribers(robot)
        return subscribers <= (publisher.names if publisher else set())

    def send(self, robot: str, axes: Axes, buttons: Buttons) -> None:
        """Publish at once, if the topic is advertised already; one thread at a time."""
        publisher = self._publishers.get(robot)
        if publisher is None:
            return
        self._message.header.stamp = rospy.Time.now()
        self._message.axes = self._trembling.shown(axes)
        self._message.buttons = buttons
        publisher.publish(self._message)

    def rival(self, robot: str, since: float) -> str:
        """Return the other node that has published for the robot since a time [s], or ""."""
        name, sent = self._rivals.get(topic_of(robot, "joy"), ("", 0.0))
        return name if sent >= since else ""

    def collect(self, pages: Sequence[Page], now: float) -> None:
        in_sight = {page.watch.look for page in pages} & self._graphs.graph.robots()
        robots = {robot for robot in (*in_sight, self._driven) if robot is not None}
        handlers = {topic_of(robot, "joy"): self._on_joy for robot in robots}
        self._subscriptions.set_subscriptions(self, handlers, every=False)
        self._newest = {topic: self._newest[topic] for topic in handlers if topic in self._newest}

    def send_to(self, page: Page, now: float) -> None:
        robot = page.watch.look
        arrived, joy = self._newest.get(topic_of(robot or "", "joy"), (0.0, None))
        if page.watch.floor and page.take_if_new("pad", (robot, arrived)) and joy:
            page.send("pad", robot=robot, age=round(max(0.0, now - arrived), 3), **joy)

    def _on_joy(self, message: ReceivedMessage) -> None:
        if message.sender != self._own_name:
            self._rivals[message.topic] = (message.sender, message.arrived)
        self._newest[message.topic] = (message.arrived, shown(message.data))
