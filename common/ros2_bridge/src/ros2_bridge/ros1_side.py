"""The side of ROS 1: hands bytes on, whatever their type. It listens for the other side."""

from __future__ import annotations

import os
import socket
import threading
import time
from typing import Callable

import rospy

from node_kit.raw_messages import Raw, RawPublisher, subscribe, types_of_others
from ros2_bridge.link import Frame, Sender, frames, is_late
from ros2_bridge.routes import Route

NAME = "ros2_bridge"
LOOK_S = 0.5  # how often the master is asked which topics there are


class Ros1Side:
    """Subscribes and publishes in ROS 1."""

    def __init__(self, routes: list[Route], path: str, warn: Callable[[str], object]) -> None:
        """Listen. path: of the socket on which the other side comes. warn: takes a line."""
        self._routes = {route.topic: route for route in routes}
        self._warn = warn
        self._sender: Sender | None = None
        self._latched: dict[
            tuple[str, str], Frame
        ] = {}  # by topic and sender, for a new other side
        self._publishers: dict[str, tuple[str, RawPublisher | None]] = {}  # by topic, with the type
        self._lock = threading.Lock()
        if os.path.exists(path):
            os.unlink(path)
        self._socket = socket.socket(socket.AF_UNIX)
        self._socket.bind(path)
        self._socket.listen(1)

    def run(self) -> None:
        """Carry messages until the node is shut down."""
        for route in self._routes.values():
            if route.to_ros2:
                self._subscribe(route)
        threading.Thread(target=self._serve, daemon=True).start()
        threading.Thread(target=self._look, daemon=True).start()
        rospy.spin()

    def _look(self) -> None:
        """Announce to the other side what others publish, before a first message comes."""
        announced: dict[str, tuple[Sender, str]] = {}  # to whom, and with which type
        while not rospy.is_shutdown():
            time.sleep(LOOK_S)
            sender = self._sender
            for topic, kind in types_of_others() if sender else ():
                route = self._routes.get(topic)
                if sender and route and route.to_ros2 and announced.get(topic) != (sender, kind):
                    announced[topic] = sender, kind
                    name, now_s = kind.replace("/", "/msg/"), time.monotonic()
                    sender.put(Frame(topic, name, b"", now_s, announces=True))

    def _subscribe(self, route: Route) -> None:
        def hear(raw: Raw) -> None:
            if raw.sender == rospy.get_name():
                return  # what came through the bridge
            kind = raw.type.replace("/", "/msg/")
            frame = Frame(route.topic, kind, raw.data, time.monotonic(), raw.is_latched)
            with self._lock:
                if raw.is_latched:
                    self._latched[route.topic, raw.sender] = frame
                if self._sender:
                    self._sender.put(frame)

        subscribe(route.topic, hear, route.depth)

    def _serve(self) -> None:
        while True:
            connection, _ = self._socket.accept()
            sender = Sender(connection, lambda topic: self._routes[topic].depth)
            with self._lock:
                for frame in self._latched.values():
                    sender.put(frame)
                self._sender = sender
            for frame in frames(connection):
                self._publish(frame)
            with self._lock:
                self._sender = None
            sender.end()
            connection.close()

    def _publish(self, frame: Frame) -> None:
        route = self._routes.get(frame.topic)
        if route and route.to_ros1 and not is_late(frame, route.longest_s):
            publisher = self._publisher(route, frame)
            if publisher and not frame.announces:
                publisher.publish(frame.data)

    def _publisher(self, route: Route, frame: Frame) -> RawPublisher | None:
        kind, publisher = self._publishers.get(frame.topic, ("", None))
        if kind == frame.type:
            return publisher
        if publisher:
            self._warn(f"{frame.topic} is now {frame.type} in ROS 2, and no more {kind}")
            publisher.end()
            publisher = None
        try:
            name = frame.type.replace("/msg/", "/")
            publisher = RawPublisher(frame.topic, name, route.depth, frame.is_latched)
        except LookupError as error:
            self._warn(f"{frame.topic}: {error}; it is not carried")
        self._publishers[frame.topic] = frame.type, publisher
        return publisher
