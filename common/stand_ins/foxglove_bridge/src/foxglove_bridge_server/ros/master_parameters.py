"""The parameters of the master, for the SDK."""

from __future__ import annotations

from contextlib import suppress
from typing import Any, Callable, Iterable, Iterator

import rosgraph
import rospy
from foxglove import Parameter

from foxglove_bridge_server.parameters import Patterns, is_allowed
from node_kit.ros.graph.ros_api import call


class MasterParameters:
    """Reads, sets and watches the parameters that a whitelist allows."""

    def __init__(self, whitelist: Patterns, warn: Callable[[str], object]) -> None:
        self._whitelist, self._warn = whitelist, warn
        self._watched: dict[str, Any] = {}  # with the last value

    def on_get_parameters(
        self, _client: Any, names: list[str], request_id: str | None = None
    ) -> list[Parameter]:
        values = self._values()
        return list(_for_sdk((name, values.get(name)) for name in names or values))

    def on_set_parameters(
        self, client: Any, parameters: list[Parameter], request_id: str | None = None
    ) -> list[Parameter]:
        for parameter in parameters:
            value = parameter.get_value()
            if not is_allowed(parameter.name, self._whitelist):
                self._warn(f"{parameter.name!r} is not set: param_whitelist does not have it")
            elif value is None:
                _call_master("deleteParam", parameter.name)
            else:
                _call_master("setParam", parameter.name, value)
        return self.on_get_parameters(client, [parameter.name for parameter in parameters])

    def on_parameters_subscribe(self, names: list[str]) -> None:
        values = self._values()
        self._watched.update({name: values.get(name) for name in names})

    def on_parameters_unsubscribe(self, names: list[str]) -> None:
        for name in names:
            self._watched.pop(name, None)

    def changes(self) -> list[Parameter]:
        """Return the subscribed parameters that have changed since the last call."""
        before = dict(self._watched)
        now = self._values() if before else {}
        changed = {
            name: now[name] for name in before if now.get(name, before[name]) != before[name]
        }
        self._watched.update(changed)
        return list(_for_sdk(changed.items()))

    def _values(self) -> dict[str, Any]:
        """Return {name: value} of all parameters that are allowed."""
        leaves = _leaves("", _call_master("getParam", "/") or {})
        return {name: value for name, value in leaves if is_allowed(name, self._whitelist)}


def _call_master(method: str, *arguments: Any) -> Any:
    return call(rosgraph.get_master_uri(), method, *arguments, caller=rospy.get_name())[1]


def _for_sdk(values: Iterable[tuple[str, Any]]) -> Iterator[Parameter]:
    for name, value in values:
        if value is not None:
            with suppress(TypeError, ValueError, OverflowError):  # XML-RPC has more kinds of values
                yield Parameter(name, value=value)


def _leaves(name: str, value: Any) -> Iterator[tuple[str, Any]]:
    if not isinstance(value, dict):
        yield name, value
        return
    for part, inner in value.items():
        yield from _leaves(f"{name}/{part}", inner)
