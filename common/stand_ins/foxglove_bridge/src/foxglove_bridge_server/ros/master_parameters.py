"""The parameters of the master, for the SDK."""

from __future__ import annotations

from contextlib import suppress
from typing import Any, Callable, Iterable, Iterator

import rospy
from foxglove import Parameter
from rosgraph.names import is_legal_name

from foxglove_bridge_server.parameters import Patterns, is_allowed
from foxglove_bridge_server.ros.master import ask
from node_kit.rules.answer import Answer


class MasterParameters:
    """Reads, sets and watches the parameters that a whitelist allows."""

    def __init__(self, whitelist: Patterns, warn: Callable[[str], object]) -> None:
        self._whitelist, self._warn = whitelist, warn
        self._watched: dict[str, Any] = {}  # with the last value

    def on_get_parameters(
        self, _client: Any, names: list[str], request_id: str | None = None
    ) -> list[Parameter]:
        values = self._values()
        names = [rospy.resolve_name(name) for name in names] or list(values)
        return list(_for_sdk((name, values.get(name)) for name in names))

    def on_set_parameters(
        self, client: Any, parameters: list[Parameter], request_id: str | None = None
    ) -> list[Parameter]:
        for parameter in parameters:
            refusal = self._set(parameter.name, parameter.get_value())
            if refusal:
                self._warn(f"{parameter.name!r} is not set: {refusal}")
        return self.on_get_parameters(client, [parameter.name for parameter in parameters])

    def _set(self, name: str, value: Any) -> str:
        """Set a parameter, or delete it for None; return why not, or ""."""
        if not is_legal_name(name):
            return "not a name of ROS"
        name = rospy.resolve_name(name)
        if not is_allowed(name, self._whitelist):
            return "param_whitelist does not have it"
        if value is None:
            return "" if ask("deleteParam", name)[0] is Answer.WELL else "there is none to delete"
        if not _is_settable(value):
            return "must be a number, a text, true, false, or a list of them"
        return "" if ask("setParam", name, value)[0] is Answer.WELL else "the master refuses it"

    def on_parameters_subscribe(self, names: list[str]) -> None:
        values = self._values()
        self._watched.update({name: values.get(name) for name in map(rospy.resolve_name, names)})

    def on_parameters_unsubscribe(self, names: list[str]) -> None:
        for name in names:
            self._watched.pop(rospy.resolve_name(name), None)

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
        leaves = _leaves("", ask("getParam", "/")[1] or {})
        return {name: value for name, value in leaves if is_allowed(name, self._whitelist)}


def _is_settable(value: Any) -> bool:
    """Return whether a parameter can have a value, and a client gets it back as it was."""
    if isinstance(value, list):
        return all(map(_is_settable, value))
    return isinstance(value, (bool, int, float, str))


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
