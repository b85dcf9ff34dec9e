"""The side of ROS 1: forwards messages of any type as bytes. The other side connects to it.

bridge.py starts it: python3 -m ros2_bridge.ros.ros1_side FOLDER.
"""

from __future__ import annotations

import socket
import sys
import threading
import time
from pathlib import Path
from typing import Any, Callable

import rospkg
import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus

from node_kit.ros.graph.raw_messages import (
    RawMessage,
    RawPublisher,
    senders,
    subscribe,
    types_of_others,
)
from node_kit.ros.lifecycle.start import run
from ros2_bridge.io.connection import Frame, Sender, end_with_parent, frames, is_late
from ros2_bridge.routes import Route, depth_of, read_routes

NAME = "ros2_bridge"
SOCKET, LIST = "socket", "topics.yaml"  # in the folder that the sides share
LOOK_S = 0.5  # interval of looking for new topics, and of publishing the state
FORGET_S = 5.0  # after the last latched sender: by then subscribers in ROS 2 have its messages
SILENT_S = 2.0  # the other side sends a sign of life every half second


class Ros1Side:
    """Subscribes and publishes in ROS 1."""

    def __init__(self, routes: list[Route], path: str, warn: Callable[[str], object]) -> None:
        """Listen. path: of the socket to which the other side connects. warn: reports a line."""
        self._routes = {route.topic: route for route in routes}
        self._warn = warn
        self._sender: Sender | None = None
        # By topic and sender, for the other side when it restarts.
        self._latched: dict[tuple[str, str], Frame] = {}
        self._last_seen_s: dict[str, float] = {}  # by topic: when a latched sender was there
        self._subscribers: dict[str, rospy.Subscriber] = {}
        self._publishers: dict[str, tuple[str, RawPublisher | None]] = {}  # by topic, with the type
        self._lock = threading.Lock()
        self._not_carried: dict[str, str] = {}  # by topic: why it is not carried
        self._sign_s, self._wrong = -SILENT_S, ""  # last sign of life, and its lines
        Path(path).unlink(missing_ok=True)
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
        """Announce to the other side which topics are published, before the first message."""
        announced: dict[str, tuple[Sender, str]] = {}  # the sender, and its type
        state = rospy.Publisher("/diagnostics", DiagnosticArray, queue_size=1)
        while not rospy.is_shutdown():
            time.sleep(LOOK_S)
            state.publish(self._state())
            self._forget_what_is_gone()
            sender = self._sender
            for topic, kind in types_of_others() if sender else ():
                route = self._routes.get(topic)
                if sender and route and route.to_ros2 and announced.get(topic) != (sender, kind):
                    announced[topic] = sender, kind
                    name, now_s = kind.replace("/", "/msg/"), time.monotonic()
                    sender.put(Frame(topic, name, b"", now_s, announces=True))

    def _state(self) -> DiagnosticArray:
        """Return whether the other side is connected, and what cannot be carried."""
        lines = [(NAME, "carries between ROS 1 and ROS 2", DiagnosticStatus.OK)]
        if time.monotonic() - self._sign_s > SILENT_S:
            lines = [(NAME, "the side of ROS 2 is missing", DiagnosticStatus.ERROR)]
        wrong = [*self._wrong.splitlines(), *self._not_carried.values()]
        lines += [(f"{NAME}: topic", line, DiagnosticStatus.WARN) for line in wrong]
        array = DiagnosticArray()
        array.header.stamp = rospy.Time.now()
        array.status = [
            DiagnosticStatus(name=name, message=line, level=level) for name, line, level in lines
        ]
        return array

    def _subscribe(self, route: Route) -> None:
        def hear(raw: RawMessage) -> None:
            if raw.sender == rospy.get_name():
                return  # which came through the bridge
            if raw.is_latched and raw.is_first and not route.may_latch:
                return  # of unknown age
            kind, is_latched = raw.type.replace("/", "/msg/"), raw.is_latched and route.may_latch
            frame = Frame(route.topic, kind, raw.data, time.monotonic(), is_latched)
            with self._lock:
                if is_latched:
                    self._latched[route.topic, raw.sender] = frame
                if self._sender:
                    self._sender.put(frame)

        self._subscribers[route.topic] = subscribe(route.topic, hear, route.depth)

    def _forget_what_is_gone(self) -> None:
        """Drop latched messages whose sender has exited, as ROS 1 itself does."""
        now_s = time.monotonic()
        with self._lock:
            self._last_seen_s.update((topic, now_s) for topic, _ in self._latched)
            there = {
                (topic, sender)
                for topic, subscriber in self._subscribers.items()
                for sender in senders(subscriber)
            }
            self._latched = {key: frame for key, frame in self._latched.items() if key in there}
            for topic, seen_s in list(self._last_seen_s.items()):
                if now_s - seen_s > FORGET_S:
                    del self._last_seen_s[topic]
                    if self._sender:
                        self._sender.put(Frame(topic, "", b"", now_s, announces=True))

    def _serve(self) -> None:
        while True:
            connection, _ = self._socket.accept()
            sender = Sender(connection, lambda topic: depth_of(self._routes, topic))
            with self._lock:
                for frame in self._latched.values():
                    sender.put(frame)
                self._sender = sender
            for frame in frames(connection):
                if frame.topic:
                    self._publish_or_warn(frame)
                else:
                    self._sign_s, self._wrong = frame.stamp_s, frame.data.decode()
            with self._lock:
                self._sender, self._sign_s = None, -SILENT_S
            sender.end()
            connection.close()

    def _publish_or_warn(self, frame: Frame) -> None:
        try:
            self._publish(frame)
        except Exception as error:  # such as a master that does not answer
            self._warn_of(frame.topic, str(error) or type(error).__name__)

    def _warn_of(self, topic: str, why: str) -> None:
        """Report why a topic is not carried, once for each reason."""
        line = f"{topic}: {why}; it is not carried"
        if self._not_carried.get(topic) != line:
            self._not_carried[topic] = line
            self._warn(line)

    def _publish(self, frame: Frame) -> None:
        route = self._routes.get(frame.topic)
        if route and route.to_ros1 and not is_late(frame, route.longest_s):
            publisher = self._publisher(route, frame)
            if publisher and not frame.announces:
                publisher.publish(frame.data, frame.is_latched)
                self._not_carried.pop(frame.topic, None)

    def _publisher(self, route: Route, frame: Frame) -> RawPublisher | None:
        kind, publisher = self._publishers.get(frame.topic, ("", None))
        if kind == frame.type:
            return publisher
        if publisher:
            self._warn(f"{frame.topic} is now {frame.type} in ROS 2, no longer {kind}")
            publisher.end()
            publisher = None
        self._not_carried.pop(frame.topic, None)
        try:
            name = frame.type.replace("/msg/", "/")
            publisher = RawPublisher(frame.topic, name, route.depth, frame.is_latched)
        except LookupError as error:
            self._warn_of(frame.topic, str(error))
        self._publishers[frame.topic] = frame.type, publisher
        return publisher


def load(folder: Path, given: dict[str, Any]) -> list[Route]:
    """Return the Routes, after writing their list for the other side. Raises ValueError."""
    file = given.pop("topics", "") or f"{rospkg.RosPack().get_path(NAME)}/config/bridge.yaml"
    if given:
        raise ValueError(f"~{next(iter(given))}: is not known; known is ~topics")
    if not isinstance(file, str):
        raise ValueError(f"~topics: {file!r}: the path of a YAML list is wanted")
    try:
        text = Path(file).read_text(encoding="utf-8")
        routes = read_routes(text)
    except (OSError, ValueError) as error:
        raise ValueError(f"~topics: {file}: {getattr(error, 'strerror', error)}") from None
    (folder / LIST).write_text(text, encoding="utf-8")
    return routes


def main() -> int:
    """Run the node; return its exit code."""
    end_with_parent()
    folder = Path(sys.argv.pop(1))
    return run(
        NAME,
        lambda given: load(folder, given),
        lambda routes: Ros1Side(routes, str(folder / SOCKET), rospy.logwarn).run(),
        keeps_name=True,
    )


if __name__ == "__main__":
    sys.exit(main())
