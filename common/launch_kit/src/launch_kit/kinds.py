"""Kinds of values of launch arguments, which are texts: true or false, numbers, files, names."""

from __future__ import annotations

import os
import re
from importlib import import_module
from pathlib import Path
from typing import Any, Callable

import yaml

from node_kit.parameters.declaration import Allowed, declared

Rule = Callable[..., object]  # takes a text; raises ValueError if it is not allowed

NAME = r"[A-Za-z]\w*"


def matching(allowed: str, pattern: str) -> Allowed:
    """Allow what matches a pattern of ASCII. allowed: the words for it."""
    return Allowed(allowed, re.compile(pattern, re.ASCII).fullmatch)


def choice(*words: str) -> Allowed:
    """Allow some words."""
    *others, last = words
    return Allowed(f"{', '.join(others)} or {last}", words.__contains__)


def as_number(value: str) -> Any:
    """Return the number that roslaunch makes of a text, or the text."""
    if re.fullmatch(r"[-+]?\d+", value, re.ASCII):
        return int(value)
    is_float = re.fullmatch(r"[-+]?(\d+\.\d*|\.?\d+)(e[-+]?\d+)?", value, re.ASCII | re.I)
    return float(value) if is_float else value


def of_number(check: Allowed, allowed: str = "") -> Allowed:
    """Allow the text of a number that another rule allows. allowed: other words for it."""
    return Allowed(allowed or check.allowed, lambda value: check.fits(as_number(value)))


def whole_path(value: str) -> Path:
    """Return a path of the folder in which the user typed it; nodes run in another folder."""
    folder = os.environ.get("PWD", "")
    if not value.startswith("/") and not folder:
        raise ValueError("must be a whole path, as $PWD is not set")
    return Path(folder, value)


def file(value: str) -> str:
    """Return the text of a file."""
    try:
        if not whole_path(value).is_file():  # nothing may ever come from a FIFO
            raise ValueError("there is no such file")
        return whole_path(value).read_text(encoding="utf-8")
    except OSError as error:
        raise ValueError(f"cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise ValueError("is not a text file") from None


def yaml_file(value: str) -> None:
    """Check for a file of YAML that holds a map, such as parameters, or nothing."""
    try:
        content = yaml.compose(file(value), yaml.SafeLoader)  # rosparam knows more tags
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        line = f"line {mark.line + 1} " if mark else ""
        raise ValueError(f"{line}is not YAML: {getattr(error, 'problem', error)}") from None
    if content and not isinstance(content, yaml.MappingNode):  # roslaunch takes an empty file
        raise ValueError("must be a YAML file with a map, such as rate: 50")


def model_file(value: str) -> None:
    """Check for a file with the URDF of a robot."""
    from xml.etree import ElementTree  # noqa: PLC0415  each launch file waits for this module

    try:
        root = ElementTree.fromstring(file(value))
    except ElementTree.ParseError as error:
        raise ValueError(f"is not XML: {error}") from None
    if root.tag != "robot":
        raise ValueError(f"must be a URDF, whose first tag is <robot>; this one's is <{root.tag}>")


def elsewhere(rule: Rule) -> Rule:
    """Allow by another rule, for the path of a file that a node reads, in its own folder."""

    def check(value: str) -> None:
        if not value.startswith("/"):
            raise ValueError(f"must be a whole path, such as {whole_path(value)}")
        rule(value)

    return check


def robot(value: str) -> None:
    """Check for the name of a robot of classroom.launch, which begins its topics."""
    if not value:
        raise ValueError("is missing: which robot of the classroom, such as name:=robot_7")
    if not re.fullmatch(NAME, value, re.ASCII):
        near = re.sub(r"\W+", "_", value, flags=re.ASCII).strip("_")
        near = f"robot_{near}" if near[:1].isdigit() else near
        meant = f"; did you mean {near}?" if near else ""
        raise ValueError(f"must be a letter followed by letters, digits and underscores{meant}")


def imported(function: str) -> Rule:
    """Allow by MODULE:FUNCTION, which is loaded once there is a value to check.

    Its package knows more about the value, and is there, as the launch file needs it, too.
    """

    def check(*values: str) -> None:
        _imported(function)(*values)

    return check


def _imported(name: str) -> Any:
    module, _, part = name.partition(":")
    return getattr(import_module(module), part)


def of_parameter(kind: str, name: str, read: Callable[[str], Any] = str) -> Rule:
    """Allow what a parameter of a node allows. kind: MODULE:CLASS; read: the value of a text."""

    def check(value: str) -> None:
        rule = declared(_imported(kind))[name].metadata["check"]
        try:
            rule(read(value))
        except yaml.YAMLError:
            raise ValueError("is not YAML") from None

    return check
