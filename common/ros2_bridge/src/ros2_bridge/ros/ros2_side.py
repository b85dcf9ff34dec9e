"""The side of ROS 2, which runs in its Python: converts the bytes, subscribes and publishes.

Needs rclpy, rosbags, and the folder ros2_bridge alone.
"""

from __future__ import annotations

import importlib
import signal
import socket
import sys
import threading
import time
from importlib.machinery import PathFinder
from pathlib import Path
from typing import Any, Callable

import rclpy
from rclpy.duration import Duration
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.signals import SignalHandlerOptions
from rosbags.typesys import Stores, get_typestore

from ros2_bridge.io.connection import Frame, Sender, end_with_parent, frames, is_late
from ros2_bridge.routes import Echoes, Route, depth_of, read_routes

NAME = "ros2_bridge"
LOOK_S = 0.5  # interval of looking for new topics
CONNECT_S = 10.0


class Ros2Side:
    """Subscribes and publishes in ROS 2."""

    def __init__(self, routes: list[Route], connection: socket.socket) -> None:
        """Create the node. connection: to the side of ROS 1."""
        self.node = rclpy.create_node(NAME)
        self._routes = {route.topic: route for route in routes}
        self._store = get_typestore(Stores.LATEST)
        self._sender = Sender(connection, lambda topic: depth_of(self._routes, topic))
        self._publishers: dict[str, tuple[tuple[str, bool], Any]] = {}
        self._subscriptions: dict[str, tuple[tuple[str, QoSProfile] | None, Any]] = {}
        self._echoes, self._lock = Echoes(), threading.Lock()  # used by two threads
        self._said: set[str] = set()
        self._wrong: dict[str, str] = {}  # by topic: why it is not carried
        self.node.create_timer(LOOK_S, self._look)
        self._look()

    def _say(self, topic: str, line: str) -> None:
        """Report a fault of a topic to the user, each line once, and to the other side."""
        self._wrong[topic] = line
        if line not in self._said:
            self._said.add(line)
            self.node.get_logger().warning(line)

    def _say_lost(self, topic: str, kind: str, target: str, error: Exception) -> None:
        why = " ".join(str(error).split())[:200] or type(error).__name__
        self._say(topic, f"{topic} ({kind}) cannot be carried to {target}: {why}")

    def _class(self, topic: str, kind: str) -> Any:
        """Return the class of package/msg/Name; report it and return None if there is none."""
        package, _, name = kind.partition("/msg/")
        try:
            is_here = is_generated(package, name)
            message = getattr(importlib.import_module(f"{package}.msg"), name) if is_here else None
        except (Exception, SystemExit):  # An incomplete package may raise anything.
            message = None
        if not message:
            self._say(topic, f"{topic}: {kind}: ROS 2 has no such type here; it is not carried")
            return None
        self._wrong.pop(topic, None)
        return message

    # ---------------------------------------------------------------- from ROS 1

    def carry(self, connection: socket.socket) -> None:
        """Publish what arrives, until the other side closes the connection."""
        for frame in frames(connection):
            route = self._routes.get(frame.topic)
            if not route or is_late(frame, route.longest_s):
                continue
            try:
                self._publish(frame, route)
            except Exception as error:  # message, type or conversion; only this topic is affected
                self._say_lost(frame.topic, frame.type, "ROS 2", error)

    def _publish(self, frame: Frame, route: Route) -> None:
        if not frame.type:
            self._forget(route)
            return
        publisher = self._publisher(frame, route)
        if publisher is None or frame.announces:
            return
        data = bytes(self._store.ros1_to_cdr(frame.data, frame.type))
        if route.to_ros1:
            with self._lock:
                self._echoes.expect(frame.topic, data, time.monotonic())
        publisher.publish(data)
        self._wrong.pop(frame.topic, None)

    def _forget(self, route: Route) -> None:
        """Replace a publisher with a new one, which has kept no messages."""
        (kind, is_latched), publisher = self._publishers.pop(route.topic, (("", False), None))
        if publisher:
            self.node.destroy_publisher(publisher)
            self._publisher(Frame(route.topic, kind, b"", 0.0, is_latched), route)

    def _publisher(self, frame: Frame, route: Route) -> Any:
        kind, publisher = self._publishers.get(frame.topic, (None, None))
        is_same = kind and kind[0] == frame.type
        # If any sender latches, the publisher keeps messages for all senders: it is not remade.
        if kind and (frame.announces or (is_same and kind[1] >= frame.is_latched)):
            return publisher
        if kind and not is_same:
            line = f"{frame.topic} is now {frame.type} in ROS 1, no longer {kind[0]}"
            self._say(frame.topic, line)
        if publisher:
            self.node.destroy_publisher(publisher)
        cls, profile = self._class(frame.topic, frame.type), quality(route, frame.is_latched)
        made = cls and self.node.create_publisher(cls, frame.topic, profile)
        self._publishers[frame.topic] = (frame.type, frame.is_latched), made
        return made

    # ------------------------------------------------------------------ to ROS 1

    def _look(self) -> None:
        """Subscribe to new topics, and again if the type or the quality of service has changed."""
        wrong = "\n".join(list(self._wrong.values())).encode()
        self._sender.put(Frame("", "", wrong, time.monotonic(), announces=True))
        for route in self._routes.values():
            if not route.to_ros1:
                continue
            publishers = self.node.get_publishers_info_by_topic(route.topic)
            publishers = [publisher for publisher in publishers if publisher.node_name != NAME]
            kinds = sorted({publisher.topic_type for publisher in publishers})
            if len(kinds) > 1:
                line = f"{route.topic} has several types in ROS 2: {', '.join(kinds)}"
                self._say(route.topic, line)
            before, subscription = self._subscriptions.get(route.topic, (None, None))
            if kinds:
                kind = before[0] if before and before[0] in kinds else kinds[0]
                (_, is_own_kept), _ = self._publishers.get(route.topic, (("", False), None))
                offered = [publisher.qos_profile for publisher in publishers]
                wanted = kind, fitting(route, offered, is_own_kept)
                if wanted != before:
                    if subscription:
                        self.node.destroy_subscription(subscription)
                    self._subscribe(route, *wanted)

    def _subscribe(self, route: Route, kind: str, profile: QoSProfile) -> None:
        self._subscriptions[route.topic] = (kind, profile), None
        cls = self._class(route.topic, kind)
        if cls is None:
            return
        latched = profile.durability == DurabilityPolicy.TRANSIENT_LOCAL
        made = self.node.create_subscription(
            cls, route.topic, self._hearer(route, kind, latched), profile, raw=True
        )
        self._subscriptions[route.topic] = (kind, profile), made
        now_s = time.monotonic()
        self._sender.put(Frame(route.topic, kind, b"", now_s, latched, announces=True))

    def _hearer(self, route: Route, kind: str, is_latched: bool) -> Callable[..., None]:
        def hear(data: bytes, about: dict[str, int]) -> None:
            # A message may have waited for this side to be restarted.
            age_s = max(0.0, time.time() - 1e-9 * about["source_timestamp"])
            sent_s = time.monotonic() - age_s
            with self._lock:
                if route.to_ros2 and self._echoes.take(route.topic, data, time.monotonic()):
                    return
            try:
                converted = bytes(self._store.cdr_to_ros1(data, kind))
            except Exception as error:  # only this message is affected
                self._say_lost(route.topic, kind, "ROS 1", error)
                return
            self._sender.put(Frame(route.topic, kind, converted, sent_s, is_latched))
            self._wrong.pop(route.topic, None)

        return hear


def is_generated(package: str, name: str) -> bool:
    """Return whether package.msg has a message of this name, without importing it."""
    spec = PathFinder.find_spec(package) if package.isidentifier() else None
    line = f"from {package}.msg._"
    for place in (spec.submodule_search_locations if spec else None) or ():
        path = Path(place) / "msg" / "__init__.py"
        lines = path.read_text(errors="replace").splitlines() if path.is_file() else []
        imports = [text.split() for text in lines if text.startswith(line)]
        if any(words[2:4] == ["import", name] for words in imports):
            return True
    return False


def quality(route: Route, is_latched: bool) -> QoSProfile:
    """Return the quality of service of a route."""
    is_kept = is_latched and route.may_latch
    return QoSProfile(
        depth=route.depth,
        lifespan=Duration(seconds=route.longest_s),  # 0: without a limit
        reliability=ReliabilityPolicy[route.reliability.upper()],
        durability=DurabilityPolicy.TRANSIENT_LOCAL if is_kept else DurabilityPolicy.VOLATILE,
    )


def fitting(route: Route, offered: list[QoSProfile], is_own_kept: bool) -> QoSProfile:
    """Return the quality of service with which a subscription receives from all publishers.

    is_own_kept: this node's own publisher keeps messages, which must not return.
    """
    kept = {profile.durability for profile in offered}
    profile = quality(route, kept == {DurabilityPolicy.TRANSIENT_LOCAL} and not is_own_kept)
    if any(own.reliability == ReliabilityPolicy.BEST_EFFORT for own in offered):
        profile.reliability = ReliabilityPolicy.BEST_EFFORT
    return profile


def connect(path: str) -> socket.socket:
    """Wait until the other side listens; return a connection to it. Raises OSError."""
    deadline_s = time.monotonic() + CONNECT_S
    while True:
        connection = socket.socket(socket.AF_UNIX)
        try:
            connection.connect(path)
            return connection
        except OSError:
            connection.close()
            if time.monotonic() > deadline_s:
                raise
            time.sleep(0.05)  # there is no event to wait for


def main() -> None:
    """Carry messages between ROS 2 and the node of ROS 1, until one of them exits."""
    end_with_parent()
    folder = sys.argv[1]
    try:
        connection = connect(f"{folder}/socket")
    except OSError:
        sys.exit("ros2_bridge: the side of ROS 1 does not listen")
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    with open(f"{folder}/topics.yaml", encoding="utf-8") as file:
        routes = read_routes(file.read())
    side = Ros2Side(routes, connection)
    reader = threading.Thread(target=side.carry, args=(connection,), daemon=True)
    reader.start()
    try:
        while reader.is_alive():
            rclpy.spin_once(side.node, timeout_sec=0.2)
    except KeyboardInterrupt:
        return
    sys.exit(1)  # the side of ROS 1 has exited: bridge.py restarts this one


if __name__ == "__main__":
    main()
