"""The parameters of the master, for the SDK."""

from __future__ import annotations

from contextlib import suppress
from typing import Any, Iterable, Iterator, Mapping, Pattern

import rosgraph
import rospy
from foxglove import Parameter

from foxglove_bridge_server.parameters import is_allowed
from node_kit.ros.graph.ros_api import call
from node_kit.rules.answer import Answer


class MasterParameters:
    """Reads, sets and watches the parameters that a whitelist allows."""

    def __init__(self, whitelist: Iterable[Pattern[str]]) -> None:
        self._whitelist = whitelist
        self._watched: dict[str, Any] = {}  # with the last value

    def read(self, names: Iterable[str] = ()) -> dict[str, Any]:
        """Return {name: value} of these parameters, or of all."""
        answer, tree = _call("getParam", "/")
        if answer is not Answer.WELL:
            return {}
        values = {name: _at(tree, name) for name in names} if names else dict(_leaves("", tree))
        allowed = {name for name in values if is_allowed(name, self._whitelist)}
        return {name: values[name] for name in allowed if values[name] is not None}

    def write(self, parameters: Iterable[Parameter]) -> list[str]:
        """Set parameters, or delete those without a value; return the names that are refused."""
        refused = []
        for parameter in parameters:
            value = parameter.get_value()
            if not is_allowed(parameter.name, self._whitelist):
                refused.append(parameter.name)
            elif value is None:
                _call("deleteParam", parameter.name)
            else:
                _call("setParam", parameter.name, value)
        return refused

    def watch(self, names: Iterable[str]) -> None:
        self._watched.update(self.read(names))

    def unwatch(self, names: Iterable[str]) -> None:
        for name in names:
            self._watched.pop(name, None)

    def changes(self) -> dict[str, Any]:
        """Return the watched parameters that have changed since the last call."""
        now = self.read(list(self._watched)) if self._watched else {}
        changed = {name: value for name, value in now.items() if value != self._watched[name]}
        self._watched.update(changed)
        return changed


def as_parameters(values: Mapping[str, Any]) -> list[Parameter]:
    """Return them for the SDK, without the few kinds of XML-RPC that it lacks."""
    parameters = []
    for name, value in values.items():
        with suppress(TypeError, ValueError, OverflowError):
            parameters.append(Parameter(name, value=value))
    return parameters


def _call(method: str, *arguments: Any) -> tuple[Answer, Any]:
    return call(rosgraph.get_master_uri(), method, *arguments, caller=rospy.get_name())


def _leaves(name: str, value: Any) -> Iterator[tuple[str, Any]]:
    if not isinstance(value, dict):
        yield name, value
        return
    for part, inner in value.items():
        yield from _leaves(f"{name}/{part}", inner)


def _at(tree: Any, name: str) -> Any:
    for part in name.strip("/").split("/"):
        tree = tree.get(part) if isinstance(tree, dict) else None
    return tree
