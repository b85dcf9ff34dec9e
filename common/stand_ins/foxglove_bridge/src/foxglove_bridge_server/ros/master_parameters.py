"""The parameters of the master, for the SDK."""

from __future__ import annotations

from contextlib import suppress
from typing import Any, Callable, Iterable, Iterator, Pattern

import rosgraph
import rospy
from foxglove import Parameter

from foxglove_bridge_server.parameters import is_allowed
from node_kit.ros.graph.ros_api import call


class MasterParameters:
    """Reads, sets and watches the parameters that a whitelist allows."""

    def __init__(self, whitelist: Iterable[Pattern[str]], warn: Callable[[str], object]) -> None:
        self._whitelist, self._warn = whitelist, warn
        self._watched: dict[str, Any] = {}  # with the last value

    def on_get_parameters(
        self, _client: Any, names: list[str], request_id: str | None = None
    ) -> list[Parameter]:
        return _as_parameters(self._read(names))

    def on_set_parameters(
        self, _client: Any, parameters: list[Parameter], request_id: str | None = None
    ) -> list[Parameter]:
        for parameter in parameters:
            value = parameter.get_value()
            if not is_allowed(parameter.name, self._whitelist):
                self._warn(f"{parameter.name} is not set: param_whitelist does not have it")
            elif value is None:
                _call_master("deleteParam", parameter.name)
            else:
                _call_master("setParam", parameter.name, value)
        return _as_parameters(self._read([parameter.name for parameter in parameters]))

    def on_parameters_subscribe(self, names: list[str]) -> None:
        self._watched.update(self._read(names))

    def on_parameters_unsubscribe(self, names: list[str]) -> None:
        for name in names:
            self._watched.pop(name, None)

    def changes(self) -> list[Parameter]:
        """Return the subscribed parameters that have changed since the last call."""
        before = dict(self._watched)
        now = self._read(list(before)) if before else {}
        changed = {name: value for name, value in now.items() if value != before[name]}
        self._watched.update(changed)
        return _as_parameters(changed)

    def _read(self, names: list[str]) -> dict[str, Any]:
        """Return {name: value} of these parameters, or of all without names."""
        tree = _call_master("getParam", "/") or {}
        pairs = [(name, _at(tree, name)) for name in names] if names else _leaves("", tree)
        return {n: v for n, v in pairs if v is not None and is_allowed(n, self._whitelist)}


def _call_master(method: str, *arguments: Any) -> Any:
    return call(rosgraph.get_master_uri(), method, *arguments, caller=rospy.get_name())[1]


def _as_parameters(values: dict[str, Any]) -> list[Parameter]:
    parameters = []
    for name, value in values.items():
        with suppress(TypeError, ValueError, OverflowError):  # XML-RPC has more kinds of values
            parameters.append(Parameter(name, value=value))
    return parameters


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
