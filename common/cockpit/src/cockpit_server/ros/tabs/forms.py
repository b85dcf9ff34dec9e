"""Forms by which a driver calls services, sets parameters and resets robots."""

from __future__ import annotations

import json
import threading
from io import BytesIO
from typing import Any, Callable, ClassVar, Mapping

import rospy
from genpy.message import fill_message_args

from cockpit_server.driving.who_drives import Driving
from cockpit_server.errors import RefusedError
from cockpit_server.fields import definition, form_fields, installed_types, numbers_of
from cockpit_server.graph import GraphWatcher
from cockpit_server.pages import Page, Soon, TabSource
from cockpit_server.schema import full_name, one_of, text
from cockpit_server.tabs import form_values
from cockpit_server.tabs.form_values import TEXTS, form, one_line, parameter_values
from cockpit_server.tabs.logs import without_folders
from node_kit.message_types import message_class
from node_kit.ros.graph.services import call_service, kind_of

CALL_S, RESET_S = 30.0, 5.0  # timeouts of services
MOST_CALLS = 100  # calls that wait for an answer, with a thread each
MASTER, VALUES, TYPES = "the master", "the list of values", "the list of types"  # not answered yet
DESCRIBED = "message", "service", "parameter", "values", "types"


def filled(kind: Any, texts: Mapping[str, str], i: int = 1) -> Any:
    """Return the message of a form; a field without a text is zero or empty.

    i: its number. Raises ValueError, one line.
    """
    now = rospy.Time.now()
    message, values = kind(), form_values.field_values(kind, texts, i, now.to_sec())
    try:
        fill_message_args(message, [values], {"now": now})
        message.serialize(BytesIO())
    except Exception as error:  # genpy raises many kinds
        raise ValueError(one_line(error)) from None
    return message


class Forms(TabSource):
    """Services and parameters for pages that may drive, unless another page does."""

    messages: ClassVar = {
        "describe": {"what": one_of(*DESCRIBED), "name": text},
        "call": {"service": full_name, "values": TEXTS},
        "set": {"parameter": full_name, "values": TEXTS},
        "reset": {"robot": text},
    }

    def __init__(self, driving: Driving, soon: Soon, graphs: GraphWatcher) -> None:
        self._driving, self._soon, self._graphs = driving, soon, graphs
        self._waiting: set[tuple[int, str]] = set()  # page's number, and what has not answered yet

    def on_describe(self, page: Page, _now: float, what: str, name: str) -> None:
        if what == "service":
            self._call(page, name, lambda: describe_service(name))
        elif what == "parameter":
            self._ask(page, MASTER, lambda: describe_parameter(name))
        elif what == "values":
            self._ask(page, VALUES, lambda: parameter_values(rospy.get_param("/", {})))
        elif what == "types":
            page.must_drive()
            self._ask(page, TYPES, lambda: {"kind": what, "types": installed_types()})
        # For viewers only names in the graph, as message_class() keeps names in memory.
        elif (page.drives or name in self._graphs.graph.types.values()) and message_class(name):
            kind = message_class(name)
            page.send(**form(name, definition(kind), form_fields(kind), numbers_of(name)))
        else:
            raise RefusedError(f"the package of {name} is not installed here")

    def on_call(self, page: Page, _now: float, service: str, values: Mapping[str, str]) -> None:
        self._call(page, service, lambda: answer_of(service, values, CALL_S))

    def on_set(self, page: Page, _now: float, parameter: str, values: Mapping[str, str]) -> None:
        self._driving.must_be_free(page)
        if "value" not in values:
            raise RefusedError('write a value, such as 0.5, [1, 2], a text, or "" for an empty one')
        self._ask(page, MASTER, lambda: set_parameter(parameter, values["value"]))

    def on_reset(self, page: Page, _now: float, robot: str) -> None:
        self._driving.must_rest(page, robot)
        service = self._graphs.graph.reset_service(robot)
        self._ask(page, service, lambda: answer_of(service, {}, RESET_S))

    def _call(self, page: Page, service: str, ask: Callable[[], dict[str, Any]]) -> None:
        self._driving.must_be_free(page)
        if service not in self._graphs.graph.services:
            raise RefusedError(f"there is no service {service}")
        self._ask(page, service, ask)

    def _ask(self, page: Page, name: str, ask: Callable[[], dict[str, Any]]) -> None:
        """Send a page the answer of a service or of the master. Raises RefusedError."""
        key = page.number, name
        if key in self._waiting:
            raise RefusedError(f"{name} was called from this page and has not answered yet")
        if len(self._waiting) >= MOST_CALLS:
            raise RefusedError(f"{MOST_CALLS} calls wait for an answer: try again later")
        self._waiting.add(key)

        def answer() -> None:
            try:
                message = ask()
            except Exception as error:  # whatever the service, its package or the master does
                why = without_folders(one_line(error))
                message = {"kind": "refused", "what": "call", "why": why}
            self._waiting.discard(key)
            self._soon(lambda: page.send(**message))

        # A thread of its own, as a service may take long.
        threading.Thread(target=answer, daemon=True).start()


def describe_service(name: str) -> dict[str, Any]:
    kind = kind_of(name)
    request, answer = kind._request_class, kind._response_class
    return form(name, [*definition(request), "---", *definition(answer)], form_fields(request))


def answer_of(name: str, values: Mapping[str, str], timeout_s: float) -> dict[str, Any]:
    kind = kind_of(name)
    answer = str(call_service(name, filled(kind._request_class, values), kind, timeout_s))
    return {"kind": "answer", "name": name, "text": answer[: form_values.LONGEST_ANSWER]}


def describe_parameter(name: str) -> dict[str, Any]:
    value = json.dumps(rospy.get_param(name, None), default=str)[: form_values.LONGEST_ANSWER]
    return form(name, [value], [("value", "JSON, or a text")])


def set_parameter(name: str, written: str) -> dict[str, Any]:
    rospy.set_param(name, form_values.parameter_value(written))
    return describe_parameter(name)
