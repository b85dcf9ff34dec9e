"""Messages that a driver publishes, and services that one calls, from a form of the page."""

from __future__ import annotations

import json
import threading
import time
from io import BytesIO
from typing import Any, Callable, ClassVar, Mapping, Sequence, Tuple

import rosgraph
import rospy
import rosservice
from genpy.message import fill_message_args
from rosgraph.names import is_legal_name

from cockpit_server.clients import Client, RefusedError, Soon, Source
from cockpit_server.driving.who_drives import Driving
from cockpit_server.feeds import later
from cockpit_server.fields import definition, form_fields
from cockpit_server.graph import JOY
from cockpit_server.graph_watch import GraphWatch
from cockpit_server.schema import full_name, one_of, require, text
from cockpit_server.sources.logs import without_folders
from cockpit_server.sources.plots import class_of, fields_of
from node_kit.ros_api import Answer
from node_kit.ros_api import call as ask_node

MOST_FIELDS = 60  # A form has no more.
LONGEST_VALUE = 2000  # characters
LONGEST_ANSWER, LONGEST_LINE = 4000, 200  # characters
MOST_PUBLISHERS = 20
UNUSED_S = 5.0  # after which a publisher ends
CONNECT_S = 1.0  # A new publisher waits so long for its subscribers.
LOOK_S = 0.02
VELOCITY = "geometry_msgs/Twist"
Key = Tuple[str, str]  # topic, type

TEXTS = require(
    lambda v: isinstance(v, dict) and len(v) <= MOST_FIELDS
    and all(isinstance(one, str) and len(one) <= LONGEST_VALUE for one in v.values()),
    f"be at most {MOST_FIELDS} texts of at most {LONGEST_VALUE} characters",
)  # fmt: skip


def form_of(kind: Any) -> dict[str, Any]:
    """Return what a page needs for a form of a message class."""
    asked = list(form_fields(kind, class_of))[:MOST_FIELDS]
    return {"definition": "\n".join(definition(kind, class_of)), "fields": asked}


def one_line(error: Exception) -> str:
    return " ".join(str(error).split())[:LONGEST_LINE] or type(error).__name__


def filled(kind: Any, texts: Mapping[str, str]) -> Any:
    """Return a message with what a form has; a field without a text is zero or empty.

    Raises ValueError, one line.
    """
    types, message = dict(form_fields(kind, class_of)), kind()
    tree: dict[str, Any] = {}
    for name, written in texts.items():
        if name not in types:
            raise ValueError(f"{kind._type} has no field {name[:60]!r}")
        part = tree
        *above, last = name.split("/")
        for step in above:
            part = part.setdefault(step, {})
        part[last] = read(name, types[name], written)
    try:
        fill_message_args(message, [tree], {"now": rospy.Time.now()})
        message.serialize(BytesIO())
    except Exception as error:  # whatever genpy makes of it
        raise ValueError(one_line(error)) from None
    return message


def read(name: str, slot_type: str, written: str) -> Any:
    """Return the text of a field as fill_message_args() takes it. Raises ValueError, one line."""
    if slot_type == "string" or written == "now":
        return written
    try:
        return json.loads(written)
    except (ValueError, RecursionError):
        raise ValueError(f"{name}: {slot_type} must be as 0.5, true or [1, 2]") from None


class Forms(Source):
    """Publishes and calls for pages that may drive, unless another page does."""

    messages: ClassVar = {
        "describe": {"what": one_of("message", "service", "parameter"), "name": text},
        "publish": {"topic": full_name, "type": text, "values": TEXTS},
        "call": {"service": full_name, "values": TEXTS},
        "set": {"parameter": full_name, "values": TEXTS},
    }

    def __init__(self, driving: Driving, soon: Soon, graph_watch: GraphWatch) -> None:
        self._driving, self._soon, self._graphs = driving, soon, graph_watch
        self._asked: set[str] = set()  # services that have not answered yet
        self._publishers: dict[Key, Any] = {}  # Publisher, or None until it is connected
        self._first: dict[Key, Any] = {}  # the message that a new one then publishes
        self._used: dict[Key, float] = {}  # when [s]
        self._lock = threading.Lock()  # It guards _first and _publishers.

    def collect(self, clients: Sequence[Client], now: float) -> None:
        for key, publisher in list(self._publishers.items()):
            if publisher and now - self._used[key] > UNUSED_S:
                del self._publishers[key]
                later(publisher.unregister)

    def on_describe(self, client: Client, _now: float, what: str, name: str) -> None:
        if what == "service":
            self._call(client, name, lambda: describe_service(name))
            return
        if what == "parameter":
            self._ask_master(client, lambda: describe_parameter(name))
            return
        # Of what is there: class_of() remembers each name.
        kind = class_of(name) if name in self._graphs.graph.types.values() else None
        if kind is None:
            raise RefusedError(f"the package of {name} is not installed here")
        client.send("form", what=what, name=name, numbers=fields_of(name), **form_of(kind))

    def on_publish(
        self, client: Client, now: float, *, topic: str, type: str, values: Mapping[str, str]
    ) -> None:
        self._driving.must_be_free(client)
        kind, known = class_of(type), self._graphs.graph.types.get(topic, type)
        if kind is None or known != type or not is_legal_name(topic):
            raise RefusedError(f"{topic}: no topic of the type {type}")
        if type == JOY and topic.endswith("/joy"):
            raise RefusedError("a joystick is moved in the tab Robot, where a loss stops the robot")
        key, message = (topic, type), filled(kind, values)
        if key not in self._publishers:
            if len(self._publishers) >= MOST_PUBLISHERS:
                raise RefusedError(f"at most {MOST_PUBLISHERS} topics in {UNUSED_S:g} s")
            self._publishers[key] = None
            threading.Thread(target=self._begin, args=(key, kind), daemon=True).start()
        self._send_out(key, message)
        self._used[key] = now

    def rest(self, topic: str, type: str) -> None:
        """Publish a zero velocity, where velocities were published."""
        if type == VELOCITY and (topic, type) in self._publishers:
            self._send_out((topic, type), class_of(type)())

    def _send_out(self, key: Key, message: Any) -> None:
        with self._lock:
            if self._publishers.get(key):
                self._publishers[key].publish(message)
            else:
                self._first[key] = message

    def on_call(self, client: Client, _now: float, service: str, values: Mapping[str, str]) -> None:
        self._call(client, service, lambda: call(service, values))

    def on_set(
        self, client: Client, _now: float, parameter: str, values: Mapping[str, str]
    ) -> None:
        self._driving.must_be_free(client)
        if "value" not in values:
            raise RefusedError('write a value, such as 0.5, [1, 2], a text, or "" for an empty one')
        self._ask_master(client, lambda: set_parameter(parameter, values["value"]))

    def _ask_master(self, client: Client, ask: Callable[[], dict[str, Any]]) -> None:
        self.ask(client, f"the master, for page {client.number},", ask)

    def _begin(self, key: Key, kind: Any) -> None:
        """Publish a first message once the subscribers are connected."""
        try:
            publisher = rospy.Publisher(key[0], kind, queue_size=10)
        except Exception as error:  # whatever rospy or the master answers
            del self._publishers[key]
            rospy.logwarn("cockpit: %s: %s", key[0], one_line(error))
            return
        answer, state = ask_node(rosgraph.get_master_uri(), "getSystemState")
        subscribers = dict(state[1]) if answer is Answer.WELL else {}
        wanted, end = len(subscribers.get(key[0], ())), time.monotonic() + CONNECT_S
        while publisher.get_num_connections() < wanted and time.monotonic() < end:
            time.sleep(LOOK_S)
        with self._lock:
            publisher.publish(self._first.pop(key))
            self._publishers[key] = publisher

    def _call(self, client: Client, service: str, ask: Callable[[], dict[str, Any]]) -> None:
        self._driving.must_be_free(client)
        if service not in self._graphs.graph.services:
            raise RefusedError(f"there is no service {service}")
        self.ask(client, service, ask)

    def ask(self, client: Client, asked: str, ask: Callable[[], dict[str, Any]]) -> None:
        """Send a client what a service or the master answers. Raises RefusedError."""
        if asked in self._asked:
            raise RefusedError(f"{asked} was called and has not answered yet")
        self._asked.add(asked)
        # A thread of its own: a service may take its time.
        arguments = (client, asked, ask)
        threading.Thread(target=self._answer, args=arguments, daemon=True).start()

    def _answer(self, client: Client, asked: str, ask: Callable[[], dict[str, Any]]) -> None:
        try:
            answer = ask()
        except Exception as error:  # whatever the service, its package or the master brings about
            why = without_folders(one_line(error))
            answer = {"kind": "refused", "what": "call", "why": why}
        finally:
            self._asked.discard(asked)
        self._soon(lambda: client.send(**answer))


def describe_service(name: str) -> dict[str, Any]:
    kind = rosservice.get_service_class_by_name(name)
    form = form_of(kind._request_class)
    answer = definition(kind._response_class, class_of)
    form["definition"] = "\n".join([form["definition"], "---", *answer])
    return {"kind": "form", "what": "service", "name": name, "numbers": [], **form}


def call(name: str, values: Mapping[str, str]) -> dict[str, Any]:
    kind = rosservice.get_service_class_by_name(name)
    answer = str(rospy.ServiceProxy(name, kind)(filled(kind._request_class, values)))
    return {"kind": "answer", "name": name, "text": answer[:LONGEST_ANSWER]}


def describe_parameter(name: str) -> dict[str, Any]:
    value = json.dumps(rospy.get_param(name, None), default=str)[:LONGEST_ANSWER]
    form = {"definition": value, "fields": [("value", "JSON, or a text")], "numbers": []}
    return {"kind": "form", "what": "parameter", "name": name, **form}


def set_parameter(name: str, written: str) -> dict[str, Any]:
    """Set what is JSON as that, as rosparam does, and another text as it is."""
    try:
        value = json.loads(written)
    except ValueError:
        value = written
    rospy.set_param(name, value)
    return describe_parameter(name)
