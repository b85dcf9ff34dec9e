"""The checker's end of the topics, in a Helper's process; each method returns at once."""

from __future__ import annotations

import contextlib
import itertools
import logging
import threading
import time
import xmlrpc.client
from typing import Any, Callable, Sequence

import rosgraph
import rospy
from geometry_msgs.msg import Twist, Vector3
from kobuki_msgs.msg import BumperEvent
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Joy, LaserScan
from std_msgs.msg import String

from node_kit.ros.rospy_patches.connections import connect_once
from tutorial_check.data.recordings import Heard, HeardText, Topics

NAME = "tutorial_check"
JOY = "/joy"  # that the Echo answers
ECHO = f"/{NAME}/echo"  # topic of the Echo
KINDS = {kind.__name__: kind for kind in (BumperEvent, Joy, LaserScan, Odometry, String, Twist)}
MOST_KEPT = 20_000  # messages of a topic


def _joy(values: tuple[Sequence[float], Sequence[int]]) -> Joy:
    axes, buttons = values
    joy = Joy(axes=axes, buttons=buttons)
    joy.header.stamp = rospy.Time.now()
    return joy


def _plain(message: Any) -> Any:
    if isinstance(message, Twist):
        return tuple(getattr(v, axis) for v in (message.linear, message.angular) for axis in "xyz")
    if isinstance(message, Joy):
        return (tuple(message.axes), tuple(message.buttons))
    if isinstance(message, Odometry):
        pose, twist = message.pose.pose, message.twist.twist
        place, turn = pose.position, pose.orientation
        velocity = (twist.linear.x, twist.angular.z)
        return (message.header.stamp.to_sec(), place.x, place.y, turn.z, turn.w, *velocity)
    if isinstance(message, LaserScan):
        return tuple(message.ranges)
    if isinstance(message, BumperEvent):
        return (message.bumper, message.state)
    return message.data


class _Warnings(logging.Handler):
    """Keeps rospy's warnings, which name topics whose types do not match."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.lines: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        if len(self.lines) < 100:
            self.lines.append(record.getMessage())


class Echo:
    """A correct joy2twist of ours: on this machine, the student's need not be faster."""

    def __init__(self, joy: str, axis: int) -> None:
        connect_once()
        self._axis = axis
        rospy.init_node(f"{NAME}_echo", disable_signals=True, disable_rosout=True)
        self._publisher = rospy.Publisher(ECHO, Twist, queue_size=1, tcp_nodelay=True)
        rospy.Subscriber(joy, Joy, self._answer)

    def _answer(self, joy: Joy) -> None:
        twist = Twist()
        twist.linear.x = joy.axes[self._axis]
        self._publisher.publish(twist)

    def ready(self) -> bool:
        """Return whether its publisher is connected."""
        return bool(self._publisher.get_num_connections() > 0)


class Peer:
    """A node that exchanges messages with the student's nodes."""

    def __init__(self) -> None:
        connect_once()
        rospy.init_node(NAME, anonymous=False, disable_signals=True, disable_rosout=True)
        self._master = rosgraph.Master(f"/{NAME}")
        self._publishers: dict[str, rospy.Publisher] = {}
        self._subscribers: dict[str, rospy.Subscriber] = {}
        self._received: dict[str, list[tuple[float, str, Any]]] = {}
        self._sent: dict[str, list[float]] = {}
        self._streams: dict[str, threading.Event] = {}
        self._warnings = _Warnings()
        for name in ("rospy", "rosout"):
            logging.getLogger(name).addHandler(self._warnings)

    def warnings(self) -> list[str]:
        return self._warnings.lines

    def advertise(self, topic: str, kind: str) -> None:
        about = {"queue_size": 1000, "tcp_nodelay": True}
        self._publishers[topic] = rospy.Publisher(topic, KINDS[kind], **about)

    def listen(self, topic: str, kind: str) -> None:
        self._received[topic] = []
        about = topic, KINDS[kind], self._keep, topic
        self._subscribers[topic] = rospy.Subscriber(*about, tcp_nodelay=True)

    def _keep(self, message: Any, topic: str) -> None:
        if len(self._received[topic]) < MOST_KEPT:
            caller = str(message._connection_header.get("callerid", ""))
            self._received[topic].append((time.monotonic(), caller, _plain(message)))

    def listeners(self, topic: str) -> int:
        return int(self._publishers[topic].get_num_connections())

    def publishers(self, topic: str) -> int:
        """Return to how many publishers our subscriber is connected."""
        return int(self._subscribers[topic].get_num_connections())

    def has_met(self, topic: str) -> bool:
        """Return whether our publisher and subscriber of a topic are connected."""
        ours = (self._publishers.get(topic), self._subscribers.get(topic))
        return all(end.get_num_connections() for end in ours if end)

    def received(self, topic: str, since: int = 0) -> list[Heard]:
        """Return the messages of a topic of numbers."""
        return self._received[topic][since:]

    def texts(self, topic: str) -> list[HeardText]:
        """Return the messages of a topic of std_msgs/String."""
        return self._received[topic]

    def count(self, topic: str) -> int:
        return len(self._received[topic])

    def send(self, topic: str, values: object) -> float:
        """Publish (axes, buttons), (bumper, state), 6 velocities or a text; return the time [s]."""
        publisher = self._publishers[topic]
        make = {
            Joy: _joy,
            BumperEvent: lambda both: BumperEvent(*both),
            Twist: lambda six: Twist(Vector3(*six[:3]), Vector3(*six[3:])),
        }
        publisher.publish(make.get(publisher.data_class, publisher.data_class)(values))
        return time.monotonic()

    def stream(self, topic: str, joys: Sequence[object], rate: float, repeat: bool) -> None:
        """Publish these in turn at a rate [Hz], in a thread; see sent()."""
        self._sent[topic], self._streams[topic] = [], threading.Event()
        _in_thread(self._stream, topic, joys, 1.0 / rate, repeat, self._streams[topic])

    def _stream(
        self, topic: str, joys: Sequence[object], period: float, repeat: bool, stop: threading.Event
    ) -> None:
        due = time.monotonic()
        for joy in itertools.cycle(joys) if repeat else joys:
            self._sent[topic].append(self.send(topic, joy))
            due = max(due + period, time.monotonic() - period)
            if stop.wait(max(0.0, due - time.monotonic())):
                return

    def sent(self, topic: str) -> list[float]:
        return list(self._sent[topic])

    def end_stream(self, topic: str) -> None:
        self._streams[topic].set()

    def state(self) -> tuple[Topics, ...]:
        """Return publishers and subscribers, without the checker's nodes."""
        with contextlib.suppress(OSError, rosgraph.MasterException):
            return tuple(map(_others, self._master.getSystemState()[:2]))
        return {}, {}  # the master has ended; see RosSession.master_lives

    def types(self) -> dict[str, str]:
        with contextlib.suppress(OSError, rosgraph.MasterException):
            return dict(self._master.getTopicTypes())
        return {}

    def node_process(self, node: str) -> int | None:
        """Return the id of a node's process, or None if it does not answer."""
        answer = self._ask(node, "getPid")
        return int(answer[2]) if answer else None

    def kill_node(self, node: str) -> None:
        """Act like rosnode kill, but do not wait for the node."""
        _in_thread(self._ask, node, "shutdown", "user request")

    def _ask(self, node: str, method: str, *arguments: str) -> Any:
        """Call a method of a node's XML-RPC API; return its answer, or None."""
        gone = contextlib.suppress(OSError, rosgraph.MasterException, xmlrpc.client.Error)
        with gone, xmlrpc.client.ServerProxy(self._master.lookupNode(node)) as proxy:
            return getattr(proxy, method)(f"/{NAME}", *arguments)

    def set_parameter(self, name: str, value: object) -> None:
        rospy.set_param(name, value)


def _others(topics: Sequence[tuple[str, list[str]]]) -> Topics:
    ours = f"/{NAME}"
    others = ((topic, tuple(n for n in nodes if not n.startswith(ours))) for topic, nodes in topics)
    return {topic: nodes for topic, nodes in others if nodes}


def _in_thread(function: Callable[..., Any], *arguments: Any) -> None:
    threading.Thread(target=function, args=arguments, daemon=True).start()
