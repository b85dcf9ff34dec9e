"""Launch files with all that they include, as roslaunch reads them: arguments and nodes.

No command of them runs, and no file of parameters is read.
"""

from __future__ import annotations

import contextlib
import os
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple
from xml.dom.minidom import Element

import roslaunch.xmlloader

from launch_kit.arguments import Argument, assignment, check_all, no_argument

CALL = "$(find launch_kit)/check"  # how launch files call the check


class LaunchedNode(NamedTuple):
    """A node as a launch file has it."""

    file: str
    name: str  # with its namespace
    type: str


@dataclass
class LaunchTree:
    """What launch files have, as far as they can be read: roslaunch reports what is wrong."""

    files: list[str]
    arguments: list[Argument] = field(default_factory=list)
    nodes: list[LaunchedNode] = field(default_factory=list)
    checking: set[str] = field(default_factory=set)  # files that call the check
    known: list[str] = field(default_factory=list)  # names of arguments of the files themselves
    is_whole: bool = False

    def checked_arguments(self) -> list[Argument]:
        """Return the arguments of those files that call the check."""
        return [argument for argument in self.arguments if argument.file in self.checking]

    def checked_nodes(self) -> list[str]:
        """Return the names of nodes of those files that call the check.

        An RViz of the same name may be replaced, as nothing drives by it.
        """
        nodes = (node for node in self.nodes if node.file in self.checking)
        return [node.name for node in nodes if node.type != "rviz"]

    def values(self) -> dict[str, str]:
        """Return the values of the arguments of the files themselves."""
        return {a.name: a.value for a in self.arguments if a.file in self.files}


class _Nothing:
    """Take what a launch file configures, and keep only the nodes."""

    def __init__(self, tree: LaunchTree) -> None:
        self._tree = tree

    def add_node(self, node: Any, **_: Any) -> None:
        """Note a node, unless $(anon) makes up its name, which is another one each time."""
        if f"_{os.getpid()}_" not in node.name:
            name = f"{node.namespace}{node.name}"
            self._tree.nodes.append(LaunchedNode(node.filename, name, node.type))

    def __getattr__(self, name: str) -> Any:
        return lambda *_, **__: None


class _Reader(roslaunch.xmlloader.XmlLoader):
    def __init__(self, tree: LaunchTree) -> None:
        super().__init__(resolve_anon=False)
        self._tree = tree

    def _arg_tag(self, tag: Element, context: Any, ros_config: Any, verbose: bool = True) -> None:
        super()._arg_tag(tag, context, ros_config, verbose=verbose)
        values, name = context.resolve_dict.get("arg", {}), tag.getAttribute("name")
        is_for_included = context.include_resolve_dict is not None
        is_fixed = tag.hasAttribute("value")
        if is_for_included or is_fixed or name not in context.arg_names:
            return
        if context.parent is None:
            self._tree.known.append(name)
        if name in values:
            (default,) = self.opt_attrs(tag, context, ("default",))
            self._tree.arguments.append(Argument(context.filename, name, values[name], default))

    def _param_tag(self, tag: Element, context: Any, *args: Any, **options: Any) -> None:
        if CALL in tag.getAttribute("command"):
            self._tree.checking.add(context.filename)

    def load_rosparam(self, *_: Any, **__: Any) -> None:
        """Read no parameters."""


def checked(file: str, arguments: Sequence[str]) -> LaunchTree:
    """Return the LaunchTree of a file and its arguments.

    Raises ValueError with one line for an argument that is not NAME:=VALUE, is unknown, or has a
    value that is not allowed.
    """
    tree = read([file], arguments)
    for argument in arguments:
        if "=" in argument and re.split(":?=", argument)[0] not in tree.known:
            raise ValueError(no_argument(argument, file, tree.known))
        assignment(argument)
    check_all(tree.checked_arguments())
    return tree


def read(files: list[str], words: Sequence[str]) -> LaunchTree:
    """Return the LaunchTree of files. words: of the command line, with NAME:=VALUE ..."""
    tree = LaunchTree(files)
    with contextlib.suppress(Exception):  # whatever it is, roslaunch meets it, too
        for file in files:
            _Reader(tree).load(file, _Nothing(tree), argv=list(words), verbose=False)
        tree.is_whole = bool(files)
    return tree
