"""The exercises of the handout, and the decorator that makes a function one of their checks."""

from __future__ import annotations

import importlib
import pkgutil
from typing import Any, Callable, TypeVar

from tutorial_check.model import Check

# What the student reads: the number in the handout, and what it is about.
EXERCISES = {
    "2": "a package",
    "3": "talker and listener",
    "4.2": "the topic /joy",
    "4.3": "joy2twist",
    "4.4": "the simulated robot",
    "4.5": "a joystick",
    "5": "launch files",
    "6.1": "remapping",
    "6.2": "a class",
    "7": "a world to drive in",
}
HANDOUT = [name for name in EXERCISES if name != "7"]  # that one is ours, and checked when named

_Function = TypeVar("_Function", bound=Callable[..., Any])
_checks: dict[str, Check] = {}  # by id


def check(
    name: str, title: str, section: str, needs: str = "", *, look: str = "", timeless: bool = False
) -> Callable[[_Function], _Function]:
    """Make a function of a session a check: one line of the report. See model.Check."""
    exercise = section if section in EXERCISES else section.split(".", maxsplit=1)[0]

    def keep(function: _Function) -> _Function:
        about = (name, exercise, title, section, tuple(needs.split()), look, timeless)
        _checks[name] = Check(*about, function)
        return function

    return keep


def all_checks() -> list[Check]:
    """Return the checks of the files of this folder, in the handout's order. Loads ROS."""
    for module in pkgutil.iter_modules(__path__, f"{__name__}."):
        importlib.import_module(module.name)
    order = list(EXERCISES)
    return sorted(_checks.values(), key=lambda one: (order.index(one.exercise), int(one.id[1:])))
