"""The other end of the student's topics: sends what we choose, keeps what comes back.

Runs in the process of a forked.Helper; every method returns at once, waiting is the caller's.
"""

from __future__ import annotations

import logging
import threading
import time
import xmlrpc.client
from typing import Any, Sequence

import rosgraph
import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Joy
from std_msgs.msg import String

from node_kit.careful_connections import connect_once

NAME = "tutorial_check"
ECHO = f"/{NAME}/echo"  # topic of the Echo
KINDS = {"String": String, "Joy": Joy, "Twist": Twist, "Odometry": Odometry}
MOST_KEPT = 20_000  # messages of a topic


def _joy(values: tuple[Sequence[float], Sequence[int]]) -> Joy:
    axes, buttons = values
    joy = Joy(axes=axes, buttons=buttons)
    joy.header.stamp = rospy.Time.now()
    return joy


def _plain(message: Any) -> Any:
    """Return a message as numbers or text."""
    if isinstance(message, Twist):
        return tuple(
            getattr(part, axis) for part in (message.linear, message.angular) for axis in "xyz"
        )
    if isinstance(message, Joy):
        return (tuple(message.axes), tuple(message.buttons))
    if isinstance(message, Odometry):
        pose, twist = message.pose.pose, message.twist.twist
        return (
            message.header.stamp.to_sec(),
            pose.position.x,
            pose.position.y,
            pose.orientation.z,
            pose.orientation.w,
            twist.linear.x,
            twist.angular.z,
        )
    return message.data


class _Warnings(logging.Handler):
    """Keeps what rospy says of its connections: it names a topic whose types do not fit."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.lines: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        if len(self.lines) < 100:
            self.lines.append(record.getMessage())


class Echo:
    """A right joy2twist of our own: no more can be asked of the student's on this machine."""

    def __init__(self) -> None:
        connect_once()
        rospy.init_node(f"{NAME}_echo", disable_signals=True, disable_rosout=True)
        self._publisher = rospy.Publisher(ECHO, Twist, queue_size=1, tcp_nodelay=True)
        rospy.Subscriber("/joy", Joy, self._answer)

    def _answer(self, joy: Joy) -> None:
        twist = Twist()
        twist.linear.x = joy.axes[1]
        self._publisher.publish(twist)

    def ready(self) -> bool:
        """Return whether Joy messages come, and its own have a listener."""
        return bool(self._publisher.get_num_connections() > 0)


class Driver:
    """A node with which the checker speaks to the student's."""

    def __init__(self) -> None:
        connect_once()
        rospy.init_node(NAME, anonymous=False, disable_signals=True, disable_rosout=True)
        self._master = rosgraph.Master(f"/{NAME}")
        self._publishers: dict[str, rospy.Publisher] = {}
        self._subscribers: dict[str, rospy.Subscriber] = {}
        self._heard: dict[str, list[tuple[float, str, Any]]] = {}
        self._sent: dict[str, list[float]] = {}
        self._streams: dict[str, threading.Event] = {}
        self._warnings = _Warnings()
        for name in ("rospy", "rosout"):
            logging.getLogger(name).addHandler(self._warnings)

    def warnings(self) -> list[str]:
        """Return what rospy complained of."""
        return list(self._warnings.lines)

    def advertise(self, topic: str, kind: str) -> None:
        """Become a publisher."""
        self._publishers[topic] = rospy.Publisher(
            topic, KINDS[kind], queue_size=1000, tcp_nodelay=True
        )

    def listen(self, topic: str, kind: str) -> None:
        """Keep what comes from now on."""
        self._heard[topic] = []
        self._subscribers[topic] = rospy.Subscriber(
            topic, KINDS[kind], self._keep, topic, tcp_nodelay=True
        )

    def _keep(self, message: Any, topic: str) -> None:
        if len(self._heard[topic]) < MOST_KEPT:
            caller = str(message._connection_header.get("callerid", ""))
            self._heard[topic].append((time.monotonic(), caller, _plain(message)))

    def listeners(self, topic: str) -> int:
        """Return how many are connected to our publisher."""
        return int(self._publishers[topic].get_num_connections())

    def speakers(self, topic: str) -> int:
        """Return how many publishers our subscriber is connected to."""
        return int(self._subscribers[topic].get_num_connections())

    def heard(self, topic: str, since: int = 0) -> list[tuple[float, str, Any]]:
        """Return (monotonic time, sender, value) of each from the given index on."""
        return self._heard[topic][since:]

    def count(self, topic: str) -> int:
        """Return how many were heard."""
        return len(self._heard[topic])

    def send(self, topic: str, values: Any) -> float:
        """Publish one message, (axes, buttons) or text; return when."""
        publisher = self._publishers[topic]
        publisher.publish(_joy(values) if publisher.data_class is Joy else values)
        return time.monotonic()

    def stream(self, topic: str, joys: Sequence[Any], rate: float, repeat: bool) -> None:
        """Publish these one after the other at a rate [Hz], in a thread; see sent()."""
        self._sent[topic] = []
        stop = threading.Event()
        self._streams[topic] = stop
        threading.Thread(
            target=self._stream, args=(topic, joys, 1.0 / rate, repeat, stop), daemon=True
        ).start()

    def _stream(
        self,
        topic: str,
        joys: Sequence[Any],
        period: float,
        repeat: bool,
        stop: threading.Event,
    ) -> None:
        due = time.monotonic()
        while True:
            for joy in joys:
                self._sent[topic].append(self.send(topic, joy))
                due = max(due + period, time.monotonic() - period)
                if stop.wait(max(0.0, due - time.monotonic())):
                    return
            if not repeat:
                return

    def sent(self, topic: str) -> list[float]:
        """Return when each message of the stream was sent."""
        return list(self._sent[topic])

    def end_stream(self, topic: str) -> None:
        """End a stream."""
        self._streams[topic].set()

    def state(self) -> tuple[dict[str, list[str]], ...]:
        """Return publishers and subscribers, each {topic: [nodes]}, without ourselves."""
        try:
            publishers, subscribers, _ = self._master.getSystemState()
        except (OSError, rosgraph.MasterException):
            return {}, {}  # the master has gone; see Stage.master_lives
        found = []
        for part in (publishers, subscribers):
            others = {
                topic: [node for node in nodes if not node.startswith(f"/{NAME}")]
                for topic, nodes in part
            }
            found.append({topic: others[topic] for topic in others if others[topic]})
        return tuple(found)

    def types(self) -> dict[str, str]:
        """Return {topic: type}."""
        try:
            return dict(self._master.getTopicTypes())
        except (OSError, rosgraph.MasterException):
            return {}

    def node_process(self, node: str) -> Any:
        """Return the id of a node's process, or None if it does not answer."""
        try:
            with xmlrpc.client.ServerProxy(self._master.lookupNode(node)) as proxy:
                answer: Any = proxy.getPid(f"/{NAME}")
                return answer[2]
        except (OSError, rosgraph.MasterException, xmlrpc.client.Error):
            return None

    def kill_node(self, node: str) -> None:
        """Do what rosnode kill does, without waiting for the node."""
        threading.Thread(target=self._kill, args=(node,), daemon=True).start()

    def _kill(self, node: str) -> None:
        try:
            with xmlrpc.client.ServerProxy(self._master.lookupNode(node)) as proxy:
                proxy.shutdown(f"/{NAME}", "user request")
        except (OSError, rosgraph.MasterException, xmlrpc.client.Error):
            pass  # it is gone already

    def set_parameter(self, name: str, value: Any) -> None:
        """Set it on the parameter server."""
        rospy.set_param(name, value)
