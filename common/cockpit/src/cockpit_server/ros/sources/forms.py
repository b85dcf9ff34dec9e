"""Services that a driver calls, and parameters that one sets, from a form; resets of robots."""

from __future__ import annotations

import json
import re
import threading
from io import BytesIO
from typing import Any, Callable, ClassVar, Iterable, Mapping, Sequence

import rospy
from genpy.message import fill_message_args

from cockpit_server.clients import Client, RefusedError, Soon, Source
from cockpit_server.driving.who_drives import Driving
from cockpit_server.fields import definition, form_fields, numbers_of
from cockpit_server.ros.graph_watch import GraphWatch
from cockpit_server.ros.sources.logs import without_folders
from cockpit_server.schema import full_name, one_of, text
from node_kit.message_types import message_class
from node_kit.parameters.declaration import Allowed
from node_kit.ros.graph.services import call_service, kind_of

MOST_VALUES, SHORT = 1000, 60  # parameters in a list, and characters of the value of each
MOST_FIELDS = 60  # A form has no more.
LONGEST_VALUE = 2000  # characters
LONGEST_ANSWER, LONGEST_LINE = 4000, 200  # characters
CALL_S, RESET_S = 30.0, 5.0  # A service that does not answer for so long is given up.
MOST_ASKED = 100  # calls that wait at a time, each in a thread

TEXTS = Allowed(
    f"at most {MOST_FIELDS} texts of at most {LONGEST_VALUE} characters",
    lambda v: isinstance(v, dict) and len(v) <= MOST_FIELDS
    and all(isinstance(one, str) and len(one) <= LONGEST_VALUE for one in v.values()),
)  # fmt: skip


def one_line(error: Exception) -> str:
    return " ".join(str(error).split())[:LONGEST_LINE] or type(error).__name__


def filled(kind: Any, texts: Mapping[str, str]) -> Any:
    """Return a message with what a form has; a field without a text is zero or empty.

    Raises ValueError, one line.
    """
    types, message = dict(form_fields(kind)), kind()
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
        is_number = re.fullmatch(r"(u?int|float)\d+|byte|char", slot_type)
        wanted = "a number" if is_number else "as 0.5, true or [1, 2]"
        raise ValueError(f"{name}: {slot_type} must be {wanted}") from None


class Forms(Source):
    """Calls services and sets parameters for pages that may drive, unless another page does."""

    messages: ClassVar = {
        "describe": {"what": one_of("message", "service", "parameter", "values"), "name": text},
        "call": {"service": full_name, "values": TEXTS},
        "set": {"parameter": full_name, "values": TEXTS},
        "reset": {"robot": text},
    }

    def __init__(self, driving: Driving, soon: Soon, graph_watch: GraphWatch) -> None:
        self._driving, self._soon, self._graphs = driving, soon, graph_watch
        self._asked: set[tuple[int, str]] = set()  # by page: what has not answered yet

    def on_describe(self, client: Client, _now: float, what: str, name: str) -> None:
        if what == "service":
            self._call(client, name, lambda: describe_service(name))
        elif what == "parameter":
            self._ask_master(client, lambda: describe_parameter(name))
        elif what == "values":
            self._ask_master(client, describe_values)
        # Only names of the graph: message_class() remembers each one.
        elif name in self._graphs.graph.types.values() and message_class(name):
            kind = message_class(name)
            client.send(**form(name, definition(kind), form_fields(kind), numbers_of(name)))
        else:
            raise RefusedError(f"the package of {name} is not installed here")

    def on_call(self, client: Client, _now: float, service: str, values: Mapping[str, str]) -> None:
        self._call(client, service, lambda: answer_of(service, values, CALL_S))

    def on_set(
        self, client: Client, _now: float, parameter: str, values: Mapping[str, str]
    ) -> None:
        self._driving.must_be_free(client)
        if "value" not in values:
            raise RefusedError('write a value, such as 0.5, [1, 2], a text, or "" for an empty one')
        self._ask_master(client, lambda: set_parameter(parameter, values["value"]))

    def on_reset(self, client: Client, _now: float, robot: str) -> None:
        self._driving.must_rest(client, robot)
        service = self._graphs.graph.reset_service(robot)
        self._ask(client, service, lambda: answer_of(service, {}, RESET_S))

    def _ask_master(self, client: Client, ask: Callable[[], dict[str, Any]]) -> None:
        self._ask(client, "the master", ask)

    def _call(self, client: Client, service: str, ask: Callable[[], dict[str, Any]]) -> None:
        self._driving.must_be_free(client)
        if service not in self._graphs.graph.services:
            raise RefusedError(f"there is no service {service}")
        self._ask(client, service, ask)

    def _ask(self, client: Client, asked: str, ask: Callable[[], dict[str, Any]]) -> None:
        """Send a client what a service or the master answers. Raises RefusedError."""
        key = client.number, asked
        if key in self._asked:
            raise RefusedError(f"{asked} was called from this page and has not answered yet")
        if len(self._asked) >= MOST_ASKED:
            raise RefusedError(f"{MOST_ASKED} calls wait for an answer: try again later")
        self._asked.add(key)

        def answer() -> None:
            try:
                found = ask()
            except Exception as error:  # whatever the service, its package or the master does
                why = without_folders(one_line(error))
                found = {"kind": "refused", "what": "call", "why": why}
            self._asked.discard(key)
            self._soon(lambda: client.send(**found))

        # A thread of its own: a service may take its time.
        threading.Thread(target=answer, daemon=True).start()


def form(
    name: str, lines: Iterable[str], fields: Iterable[tuple[str, str]], numbers: Sequence[str] = ()
) -> dict[str, Any]:
    """Return the message with a form. lines: of the definition. fields: (name, type)."""
    about = {"definition": "\n".join(lines), "fields": list(fields)[:MOST_FIELDS]}
    return {"kind": "form", "name": name, "numbers": numbers, **about}


def describe_service(name: str) -> dict[str, Any]:
    kind = kind_of(name)
    asked, answer = kind._request_class, kind._response_class
    return form(name, [*definition(asked), "---", *definition(answer)], form_fields(asked))


def answer_of(name: str, values: Mapping[str, str], timeout_s: float) -> dict[str, Any]:
    kind = kind_of(name)
    answer = str(call_service(name, filled(kind._request_class, values), kind, timeout_s))
    return {"kind": "answer", "name": name, "text": answer[:LONGEST_ANSWER]}


def describe_parameter(name: str) -> dict[str, Any]:
    value = json.dumps(rospy.get_param(name, None), default=str)[:LONGEST_ANSWER]
    return form(name, [value], [("value", "JSON, or a text")])


def describe_values() -> dict[str, Any]:
    """Return the values of all parameters, each in short."""
    values = {name: _short(value) for name, value in _leaves("", rospy.get_param("/", {}))}
    return {"kind": "values", "values": dict(list(values.items())[:MOST_VALUES])}


def _leaves(above: str, value: Any) -> Iterable[tuple[str, Any]]:
    """Yield (name, value) of the parameters in a tree of them, as rosparam list has them."""
    if not isinstance(value, dict) or not value:
        yield above or "/", value
        return
    for name, inner in value.items():
        yield from _leaves(f"{above}/{name}", inner)


def _short(value: Any) -> str:
    written = json.dumps(value, default=str)
    return written if len(written) <= SHORT else f"{written[: SHORT - 4]} ..."


def set_parameter(name: str, written: str) -> dict[str, Any]:
    """Set what is JSON as that, as rosparam does, and another text as it is."""
    try:
        value = json.loads(written)
    except ValueError:
        value = written
    rospy.set_param(name, value)
    return describe_parameter(name)
