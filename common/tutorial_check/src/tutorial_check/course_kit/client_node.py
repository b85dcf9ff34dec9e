"""A node for any type: services, messages, parameters, transforms. See Client, which starts it.

It runs as a program with the student's rights, as it imports what their workspace generates. Standard
input is a socket: a line of JSON, {"id", "do", "with"}, is answered by {"id", "value"}, or by
{"id", "fault": {"kind", "text"}}; kind: see Fault. A line that waits keeps no other from its answer.
"""

from __future__ import annotations

import json
import os
import socket
import threading
import time
from typing import Any

import genpy
import rosgraph
import roslib.message
import rospy

from node_kit.rospy_patches.connections import connect_once

NAME = "tutorial_check_client"
MOST_KEPT = 20_000  # messages of a topic
TIMES: dict[str, Any] = {"time": genpy.Time, "duration": genpy.Duration}
OF_TYPE, OF_PROGRAM = "type", "program"


class Fault(Exception):
    """Why there is no value. kind: OF_TYPE, no such type or a value that does not fit; OF_PROGRAM."""

    def __init__(self, kind: str, text: str) -> None:
        super().__init__(text)
        self.kind = kind


def class_of(kind: str, of_service: bool = False) -> Any:
    """Return the class of a type, as it was generated. Raises Fault."""
    find = roslib.message.get_service_class if of_service else roslib.message.get_message_class
    try:
        found = find(kind)
    except Exception:  # also of what stands in the student's package
        found = None
    if found is None:
        raise Fault(OF_TYPE, f"there is no {'service' if of_service else 'message'} {kind}")
    return found


def plain(value: Any) -> Any:
    """Return a message, or a value of it, in maps, lists, texts and numbers; times in seconds."""
    if isinstance(value, genpy.Message):
        return {name: plain(getattr(value, name)) for name in value.__slots__}
    if isinstance(value, (genpy.Time, genpy.Duration)):
        return value.to_sec()
    return list(map(plain, value)) if isinstance(value, (list, tuple, bytes)) else value


def filled(message: Any, values: Any) -> Any:
    """Set fields of a message, from a map or from a list in their order; return it. Raises Fault."""
    fields = message.__slots__
    given = values if isinstance(values, dict) else dict(zip(fields, values))
    odd = [name for name in given if name not in fields]
    if odd or len(given) < len(values):
        known = ", ".join(fields) or "none"
        raise Fault(OF_TYPE, f"{message._type} has no field for {odd or values}; fields: {known}")
    for name, value in given.items():
        setattr(message, name, _made(message._slot_types[fields.index(name)], value))
    return message


def _made(kind: str, value: Any) -> Any:
    element, is_list, _ = kind.partition("[")
    if is_list:
        return [_made(element, each) for each in value]
    if element in TIMES:
        return TIMES[element].from_sec(value)
    return filled(class_of(kind)(), value) if "/" in kind else value


def _fields_of(found: Any) -> list[str]:
    return [f"{kind} {name}" for kind, name in zip(found._slot_types, found.__slots__)]


def message_of(kind: Any, values: Any) -> Any:
    """Return a message of a class with these values. Raises Fault."""
    try:
        message = filled(kind(), values)
        message._check_types()
    except (TypeError, ValueError, genpy.SerializationError) as error:
        raise Fault(OF_TYPE, f"{kind._type}: {values} does not fit: {error}") from None
    return message


class Node:
    """Its methods are what a line may ask for."""

    def __init__(self) -> None:
        self._ends: dict[str, Any] = {}  # of topics
        self._heard: dict[str, list[Any]] = {}  # messages of a topic, or requests of a service
        self._tf: Any = None

    def fields(self, kind: str) -> list[str]:
        """Return "TYPE NAME" of each field; of a service with "---" in between."""
        try:
            return _fields_of(class_of(kind))
        except Fault:
            found = class_of(kind, of_service=True)
        return [*_fields_of(found._request_class), "---", *_fields_of(found._response_class)]

    def ask(self, service: str, kind: str, values: Any) -> Any:
        found = class_of(kind, of_service=True)
        request = message_of(found._request_class, values)
        try:
            rospy.wait_for_service(service)
            return plain(rospy.ServiceProxy(service, found)(request))
        except (rospy.ServiceException, rospy.ROSException, rospy.TransportException) as error:
            text = " ".join(str(error).split())
            text = f"it is of another type than {kind}" if "md5sum" in text else text
            raise Fault(OF_PROGRAM, text) from None

    def services(self) -> list[str]:
        found = rosgraph.Master(rospy.get_name()).getSystemState()[2]
        return sorted(name for name, nodes in found if nodes != [rospy.get_name()])

    def serve(self, service: str, kind: str, values: Any) -> None:
        found = class_of(kind, of_service=True)
        answer = message_of(found._response_class, values)
        self._heard[service] = []

        def handle(request: Any) -> Any:
            self._keep(request, service)
            return answer

        rospy.Service(service, found, handle)

    def listen(self, topic: str, kind: str) -> None:
        self._heard[topic] = []
        about = topic, class_of(kind), self._keep, topic
        self._ends[topic] = rospy.Subscriber(*about, tcp_nodelay=True)

    def _keep(self, message: Any, name: str) -> None:
        if len(self._heard[name]) < MOST_KEPT:
            caller = str(message._connection_header.get("callerid", ""))
            self._heard[name].append((time.monotonic(), caller, plain(message)))

    def heard(self, name: str, since: int) -> list[Any]:
        return self._heard[name][since:]

    def count(self, name: str) -> int:
        return len(self._heard[name])

    def advertise(self, topic: str, kind: str) -> None:
        self._ends[topic] = rospy.Publisher(topic, class_of(kind), queue_size=1000)

    def send(self, topic: str, values: Any) -> float:
        """Publish; return when [s]."""
        self._ends[topic].publish(message_of(self._ends[topic].data_class, values))
        return time.monotonic()

    def connections(self, topic: str) -> int:
        return int(self._ends[topic].get_num_connections())

    def parameter(self, name: str) -> Any:
        return rospy.get_param(name, None)

    def lookup(self, target: str, source: str) -> Any:
        """Return (translation, rotation, stamp) of a transform, or None as long as there is none."""
        import tf2_ros  # noqa: PLC0415  only where it is wanted

        if self._tf is None:
            buffer = tf2_ros.Buffer()
            self._tf = buffer, tf2_ros.TransformListener(buffer)
        try:
            found = plain(self._tf[0].lookup_transform(target, source, rospy.Time(0)))
        except tf2_ros.TransformException:
            return None
        parts = found["transform"]["translation"], found["transform"]["rotation"]
        return *(list(part.values()) for part in parts), found["header"]["stamp"]


def _answer(node: Node, line: socket.socket, sending: threading.Lock, asked: Any) -> None:
    answer = {"id": asked["id"]}
    try:
        answer["value"] = getattr(node, asked["do"])(*asked["with"])
    except Fault as fault:
        answer["fault"] = {"kind": fault.kind, "text": str(fault)}
    except Exception as error:
        answer["fault"] = {"kind": "", "text": f"{type(error).__name__}: {error}"}
    with sending:
        line.sendall(json.dumps(answer).encode() + b"\n")


def main() -> None:
    """Answer until the other end of the socket is closed."""
    line, sending = socket.socket(fileno=os.dup(0)), threading.Lock()
    connect_once()
    rospy.init_node(NAME, disable_signals=True, disable_rosout=True)
    node = Node()
    for text in line.makefile():
        about = node, line, sending, json.loads(text)
        threading.Thread(target=_answer, args=about, daemon=True).start()
    os._exit(0)  # whatever still waits


if __name__ == "__main__":
    main()
