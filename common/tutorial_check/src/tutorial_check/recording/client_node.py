"""A node for any type: services, messages, parameters, transforms. Client starts it.

It has the student's rights, because it imports code that their workspace generates, and imports
nothing else of the checker. Standard input is a socket. A line of JSON, {"id", "do", "with"}, is
answered by {"id", "value"}; by {"id", "fault"} if the type is unknown or the values do not fit it;
or by {"id", "error"}. Lines do not wait for each other.
"""

from __future__ import annotations

import json
import os
import re
import socket
import threading
import time
from typing import Any

import genpy
import rosgraph
import rospy
import yaml
from std_msgs.msg import Header

from node_kit.message_types import message_class, service_class
from node_kit.ros.rospy_patches.connections import connect_once

NAME = "tutorial_check_client"
MOST_KEPT = 20_000  # messages of a topic
REFUSED = genpy.MessageException, genpy.SerializationError


class CallerError(Exception):
    """The type is unknown, or the values do not fit it."""


def class_of(kind: str, of_service: bool = False) -> type[genpy.Message]:
    """Return the generated class of a type. Raises CallerError."""
    cls = service_class(kind) if of_service else message_class(kind)
    if cls is None:
        raise CallerError(f"there is no type {kind}")
    return cls


def plain(value: object) -> object:
    """Return a message, or a value of it, as maps, lists, texts and numbers."""
    if isinstance(value, (genpy.Time, genpy.Duration)):
        return {"secs": value.secs, "nsecs": value.nsecs}
    if isinstance(value, genpy.Message):
        return {name: plain(getattr(value, name)) for name in value.__slots__}
    return list(map(plain, value)) if isinstance(value, (list, tuple, bytes)) else value


def message_of(kind: type[genpy.Message], values: object) -> genpy.Message:
    """Return a message of a class, with values as for rostopic pub. Raises CallerError."""
    message, now = kind(), rospy.Time.now()
    words = values if isinstance(values, list) else [values]
    try:
        genpy.message.fill_message_args(message, words, {"now": now, "auto": Header(stamp=now)})
        message._check_types()
    except (AttributeError, TypeError, ValueError, *REFUSED) as error:
        fields = ", ".join(message.__slots__) or "none"
        why = f"{values} does not fit: {error} (fields: {fields})"
        raise CallerError(f"{kind._type}: {why}") from None
    return message


def _fields_of(cls: Any) -> list[str]:
    return [f"{kind} {name}" for kind, name in zip(cls._slot_types, cls.__slots__)]


class ClientNode:
    """The node, whose public methods a line may call."""

    def __init__(self, line: socket.socket) -> None:
        self._line, self._sending = line, threading.Lock()
        self._publishers: dict[str, rospy.Publisher] = {}
        self._subscribers: dict[str, rospy.Subscriber] = {}
        # Messages of a topic, or requests of a service.
        self._heard: dict[str, list[tuple[float, str, object]]] = {}
        self._tf: Any = None

    def fields(self, kind: str) -> list[str]:
        try:
            return _fields_of(class_of(kind))
        except CallerError:
            cls = class_of(kind, of_service=True)
        return [*_fields_of(cls._request_class), "---", *_fields_of(cls._response_class)]

    def services(self) -> list[str]:
        names = (name for name, _ in rosgraph.Master(NAME).getSystemState()[2])
        return sorted(name for name in names if not name.endswith(("loggers", "logger_level")))

    def ask(self, service: str, kind: str, values: object) -> tuple[object, str]:
        """Call a service; return (response, "") or (None, why there is none)."""
        cls = class_of(kind, of_service=True)
        request = message_of(cls._request_class, values)
        try:
            rospy.wait_for_service(service)
            return plain(rospy.ServiceProxy(service, cls)(request)), ""
        except (rospy.ServiceException, rospy.ROSException, rospy.TransportException) as error:
            text = re.sub(r"\bb'(.*)'", r"\1", " ".join(str(error).split()))
            return None, f"{service} is of another type than {kind}" if "md5sum" in text else text

    def serve(self, service: str, kind: str, values: object) -> None:
        cls = class_of(kind, of_service=True)
        answer = message_of(cls._response_class, values)
        self._heard[service] = []

        def respond(request: Any) -> Any:
            self._keep(request, service)
            return answer

        rospy.Service(service, cls, respond)

    def listen(self, topic: str, kind: str) -> None:
        self._heard[topic] = []
        self._subscribers[topic] = rospy.Subscriber(topic, class_of(kind), self._keep, topic)

    def _keep(self, message: Any, name: str) -> None:
        if len(self._heard[name]) < MOST_KEPT:
            caller = str(message._connection_header.get("callerid", ""))
            self._heard[name].append((time.monotonic(), caller, plain(message)))

    def heard(self, name: str, since: int) -> list[tuple[float, str, object]]:
        return self._heard[name][since:]

    def count(self, name: str) -> int:
        return len(self._heard[name])

    def advertise(self, topic: str, kind: str) -> None:
        self._publishers[topic] = rospy.Publisher(topic, class_of(kind), queue_size=1000)

    def send(self, topic: str, values: object) -> float:
        publisher = self._publishers[topic]
        publisher.publish(message_of(publisher.data_class, values))
        return time.monotonic()

    def connections(self, topic: str) -> int:
        ends = [known[topic] for known in (self._publishers, self._subscribers) if topic in known]
        return min(end.get_num_connections() for end in ends)

    def parameter(self, name: str) -> object:
        return rospy.get_param(name, None)

    def lookup(self, target: str, source: str) -> list[list[float]] | None:
        """Return the values of translation and rotation, or None until there are some."""
        import tf2_ros  # noqa: PLC0415  only where it is wanted

        if self._tf is None:
            buffer = tf2_ros.Buffer()
            self._tf = buffer, tf2_ros.TransformListener(buffer)
        try:
            newest = self._tf[0].lookup_transform(target, source, rospy.Time(0)).transform
            both = (newest.translation, newest.rotation)
            return [[getattr(part, name) for name in part.__slots__] for part in both]
        except tf2_ros.TransformException:
            return None

    def transforms(self) -> list[str]:
        """Return "PARENT -> CHILD" of each transform that has arrived since the first lookup."""
        known = yaml.safe_load(self._tf[0].all_frames_as_yaml()) if self._tf else None
        return sorted(f"{about['parent']} -> {child}" for child, about in (known or {}).items())

    def answer(self, text: str) -> None:
        asked = json.loads(text)
        answer = {"id": asked["id"]}
        try:
            answer["value"] = getattr(self, asked["do"])(*asked["with"])
        except CallerError as fault:
            answer["fault"] = " ".join(str(fault).split())
        except Exception as error:
            answer["error"] = f"{type(error).__name__}: {error}"
        with self._sending:
            self._line.sendall(json.dumps(answer).encode() + b"\n")


def main() -> None:
    """Reply until the other end of the socket is closed."""
    line = socket.socket(fileno=os.dup(0))
    connect_once()
    rospy.init_node(NAME, disable_signals=True, disable_rosout=True)
    node = ClientNode(line)
    for text in line.makefile():
        threading.Thread(target=node.answer, args=[text], daemon=True).start()
    os._exit(0)  # even if calls still wait


if __name__ == "__main__":
    main()
