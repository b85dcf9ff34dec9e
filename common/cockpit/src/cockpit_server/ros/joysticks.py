"""The topics joy of robots: that of the driven one is published, of others the newest is shown."""

from __future__ import annotations

import time
from math import isfinite
from typing import Any, ClassVar, Sequence

import rospy
from sensor_msgs.msg import Joy

from cockpit_server.clients import Client, Source
from cockpit_server.driving.driver_session import Axes, Buttons
from cockpit_server.graph import topic_of
from cockpit_server.ros.feeds import Feeds, Raw, later_once, read
from cockpit_server.ros.graph_watch import GraphWatch
from cockpit_server.schema import or_null, text
from gamepad.liveness import Trembling
from node_kit.ros.rospy_patches.connections import sender_of
from node_kit.ros.rospy_patches.prompt_publisher import PromptPublisher

FRAME = "cockpit"
DIGITS = 4  # after the point
LONGEST_JOY = 4000  # bytes; a gamepad's message has some 100, a huge one would hold up the driver


def shown(data: bytes) -> dict[str, Any] | None:
    """Return {axes, buttons} of the bytes of a Joy, or None if malformed or too long."""
    joy = read(Joy, data, LONGEST_JOY)
    if joy is None:
        return None
    axes = [round(value, DIGITS) if isfinite(value) else 0.0 for value in joy.axes]
    return {"axes": axes, "buttons": list(joy.buttons)}


class Joysticks(Source):
    """Publishes sensor_msgs/Joy for the driven robot; subscribes to it and what pages look at."""

    watches: ClassVar = {"look": (or_null(text), None)}

    def __init__(self, feeds: Feeds, graph_watch: GraphWatch, own_name: str) -> None:
        self._feeds, self._graphs, self._own_name = feeds, graph_watch, own_name
        self._driven: str | None = None  # the robot that is driven from a page
        self._publishers: dict[str, PromptPublisher] = {}  # by robot; at most one
        self._trembling = Trembling()
        self._message = Joy()
        self._message.header.frame_id = FRAME
        # topic -> (when its newest message came [s], what pages get of it)
        self._newest: dict[str, tuple[float, dict[str, Any] | None]] = {}
        self._rivals: dict[str, tuple[str, float]] = {}  # topic -> (node, newest message [s])

    def advertise(self, robot: str | None) -> None:
        """Advertise the topic of this robot only (None: of none): the graph shows what drives."""
        if robot != self._driven:
            self._driven = robot
            later_once(self._keep)

    def _keep(self) -> None:
        robot = self._driven
        for other in set(self._publishers) - {robot}:
            self._publishers.pop(other).end()
        if robot is not None and robot not in self._publishers:
            self._publishers[robot] = PromptPublisher(topic_of(robot, "joy"), Joy)

    def is_heard(self, robot: str) -> bool:
        """Return whether all subscribers of the driven robot's joystick are connected."""
        publisher = self._publishers.get(robot)
        return self._graphs.joystick_listeners(robot) <= (publisher.names if publisher else set())

    def send(self, robot: str, axes: Axes, buttons: Buttons) -> None:
        """Publish at once, if it is advertised already; one thread at a time."""
        publisher = self._publishers.get(robot)
        if publisher is None:
            return
        self._message.header.stamp = rospy.Time.now()
        self._message.axes = self._trembling.shown(axes)
        self._message.buttons = buttons
        publisher.publish(self._message)

    def rival(self, robot: str, since: float) -> str:
        """Return the other node that sent on the robot's topic since a time [s], or ""."""
        name, sent = self._rivals.get(topic_of(robot, "joy"), ("", 0.0))
        return name if sent >= since else ""

    def collect(self, clients: Sequence[Client], now: float) -> None:
        looked_at = {client.watch.look for client in clients} & self._graphs.graph.robots()
        robots = {robot for robot in (*looked_at, self._driven) if robot is not None}
        handlers = {topic_of(robot, "joy"): self._hear for robot in robots}
        self._feeds.set_subscriptions(self, handlers, every=False)
        self._newest = {topic: self._newest[topic] for topic in handlers if topic in self._newest}

    def send_to(self, client: Client, now: float) -> None:
        robot = client.watch.look
        came, joy = self._newest.get(topic_of(robot or "", "joy"), (0.0, None))
        if client.watch.floor and client.take_if_new("pad", (robot, came)) and joy:
            client.send("pad", robot=robot, age=round(max(0.0, now - came), 3), **joy)

    def _hear(self, message: Raw, topic: str) -> None:
        now, sender = time.monotonic(), sender_of(message)
        if sender != self._own_name:
            self._rivals[topic] = (sender, now)
        self._newest[topic] = (now, shown(message.data))
