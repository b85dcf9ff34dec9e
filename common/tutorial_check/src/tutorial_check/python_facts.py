"""What a Python file says of itself, read as Python reads it and never run. Pure."""

from __future__ import annotations

import ast
import re
import warnings
from dataclasses import dataclass, field
from typing import Iterator

from tutorial_check.class_facts import ClassFacts, class_facts
from tutorial_check.python_text import last_name, python_lines, text_of


@dataclass
class Call:
    """rospy.Publisher(...), rospy.Subscriber(...) and their like."""

    line: int
    words: list[str]  # the arguments as text, strings without quotes
    names: dict[str, str]  # the same of keyword arguments


@dataclass
class PythonFacts:
    """What a file contains."""

    error: str = ""
    error_line: int = 0
    error_text: str = ""
    calls: dict[str, list[Call]] = field(default_factory=dict)  # last part of the name -> [Call]
    classes: list[ClassFacts] = field(default_factory=list)  # [ClassFacts]
    globals: list[int] = field(default_factory=list)  # lines of `global`
    broad_excepts: list[int] = field(default_factory=list)  # lines of except: and except Exception:
    imports: set[str] = field(default_factory=set)
    has_main: bool = False
    sunken_main: (
        tuple[int, str] | tuple[()]
    ) = ()  # (line, function) of one that stands within a function
    odd_main: (
        tuple[int, str] | tuple[()]
    ) = ()  # (line, text) of an `if` that is meant to be that of __main__, and is not
    names: dict[str, int] = field(
        default_factory=dict
    )  # what the program makes, or is given -> first line
    inner_names: set[str] = field(
        default_factory=set
    )  # those of them that functions make, or are given
    attributes: dict[str, tuple[int, str]] = field(
        default_factory=dict
    )  # "self.pub" -> (first line, what it is set to)
    loose: dict[int, str] = field(
        default_factory=dict
    )  # line beside functions, not in one -> the one above
    functions: dict[str, int] = field(default_factory=dict)  # of those the functions and methods
    called_back: dict[str, list[int]] = field(
        default_factory=dict
    )  # what callbacks call, also by others -> lines
    at_end: dict[str, list[int]] = field(
        default_factory=dict
    )  # the same of what on_shutdown is given
    odd_node: (
        tuple[int, str] | tuple[()]
    ) = ()  # (line, name) of an init_node of whose name ROS warns
    loops: list[int] = field(default_factory=list)  # lines of `while`
    bare_names: list[tuple[int, str]] = field(
        default_factory=list
    )  # (line, text) of statements that do nothing

    def first(self, name: str) -> Call | None:
        """The first call of that name, or None."""
        return next(iter(self.calls.get(name, [])), None)

    @property
    def deaf(self) -> Call | None:
        """The first Subscriber that is given no callback, or None."""
        return next(
            (
                call
                for call in self.calls.get("Subscriber", [])
                if len(call.words) == 2 and "callback" not in call.names
            ),
            None,
        )

    @property
    def publishing_loops(self) -> list[int]:
        """The lines that publish within a loop, and not in a callback."""
        inside = self.called_back.get("publish", [])
        outside = (call.line for call in self.calls.get("publish", []) if call.line not in inside)
        return [line for line in outside if any(loop <= line for loop in self.loops)]

    @property
    def keeps_newest(self) -> bool:
        """Whether a Publisher or Subscriber has a queue of one message."""
        made = self.calls.get("Publisher", []) + self.calls.get("Subscriber", [])
        return any(call.names.get("queue_size") == "1" for call in made)

    @property
    def is_class_program(self) -> bool:
        """Whether it has a class that deals with ROS, or is meant to."""
        return any(one.is_node for one in self.classes)


def read_python(text: str) -> PythonFacts:
    """The PythonFacts of a file's text."""
    facts = PythonFacts()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tree = ast.parse(text)
            compile(tree, "program", "exec")  # which refuses more: a late `global`, a lone `return`
    except (SyntaxError, ValueError, RecursionError) as error:
        facts.error = getattr(error, "msg", None) or str(error)
        facts.error_line = getattr(error, "lineno", 0) or 0
        lines = python_lines(text)
        if 0 < facts.error_line <= len(lines):
            facts.error_text = lines[facts.error_line - 1].strip(" \t")
        return facts
    for node in ast.walk(tree):
        _note(facts, node)
    facts.names = _names(tree)
    functions = [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)]
    facts.inner_names = {name for function in functions for _, name in _made(function)}
    facts.attributes = _attributes(tree)
    facts.loose = _loose(tree)
    facts.sunken_main = _sunken_main(tree)
    facts.functions = {node.name: node.lineno for node in functions}
    subscribers = facts.calls.get("Subscriber", [])
    given = [(one.words[2:3] or [one.names.get("callback", "")])[0] for one in subscribers]
    facts.called_back = _called_by(tree, given)
    given = [word for call in facts.calls.get("on_shutdown", []) for word in call.words[:1]]
    facts.at_end = _called_by(tree, given)
    facts.odd_main = _odd_main(tree, text, facts.names)
    facts.odd_node = _odd_node(tree)
    for calls in facts.calls.values():
        calls.sort(key=lambda call: call.line)
    classes = [node for node in ast.walk(tree) if isinstance(node, ast.ClassDef)]
    facts.classes = [class_facts(node, set(facts.calls)) for node in classes]
    return facts


def _note(facts: PythonFacts, node: ast.AST) -> None:
    """Add what a node of the tree says by itself."""
    if isinstance(node, ast.Call):
        words = [text_of(word) for word in node.args]
        names = {word.arg: text_of(word.value) for word in node.keywords if word.arg}
        facts.calls.setdefault(last_name(node), []).append(Call(node.lineno, words, names))
    elif isinstance(node, ast.Global):
        facts.globals.append(node.lineno)
    elif isinstance(node, ast.ExceptHandler):
        if node.type is None or text_of(node.type) in ("Exception", "BaseException"):
            facts.broad_excepts.append(node.lineno)
    elif isinstance(node, ast.Import):
        facts.imports.update(alias.name for alias in node.names)
    elif isinstance(node, ast.ImportFrom):
        facts.imports.update(f"{node.module}.{alias.name}" for alias in node.names)
    elif isinstance(node, ast.While):
        facts.loops.append(node.lineno)
    elif _is_main(node):
        facts.has_main = True
    elif isinstance(node, ast.Expr) and isinstance(node.value, (ast.Attribute, ast.Name)):
        facts.bare_names.append((node.lineno, text_of(node.value)))


def _names(tree: ast.Module) -> dict[str, int]:
    """{name: first line} of variables, parameters, functions, classes and imports."""
    found = list(_made(tree))
    for node in ast.walk(tree):
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            found.append((node.lineno, node.name))
        elif isinstance(node, (ast.Import, ast.ImportFrom)):
            found += [(node.lineno, each.asname or each.name) for each in node.names]
    return {name: line for line, name in sorted(found, reverse=True)}


def _made(tree: ast.AST) -> Iterator[tuple[int, str]]:
    """(line, name) of each variable and parameter."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.lineno, node.id
        elif isinstance(node, ast.arg):
            yield node.lineno, node.arg


def _attributes(tree: ast.Module) -> dict[str, tuple[int, str]]:
    """{"msg.linear.x": (first line, what it is set to)}."""
    found = [
        (node.lineno, text_of(target), text_of(node.value))
        for node in ast.walk(tree)
        if isinstance(node, ast.Assign)
        for target in node.targets
        if isinstance(target, ast.Attribute)
    ]
    return {name: (line, value) for line, name, value in sorted(found, reverse=True)}


def _loose(tree: ast.Module) -> dict[int, str]:
    """{line: the function above it} of what stands beside functions and may have fallen out of one."""
    found: dict[int, str] = {}
    for block in ast.walk(tree):
        above = ""
        for node in block.body if isinstance(block, (ast.Module, ast.ClassDef)) else ():
            functions = [each.name for each in ast.walk(node) if isinstance(each, ast.FunctionDef)]
            if functions:
                above = functions[-1]
            elif above and not _is_main(node):
                found.update(
                    dict.fromkeys(range(node.lineno, (node.end_lineno or node.lineno) + 1), above)
                )
    return found


def _called_by(tree: ast.Module, given: list[str]) -> dict[str, list[int]]:
    """{name: [lines]} of calls in functions that are given to ROS by name, and in those they call."""
    functions = {node.name: node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)}
    waiting = [name.rsplit(".", 1)[-1] for name in given]
    lines: dict[str, set[int]] = {}
    while waiting:
        function = functions.pop(waiting.pop(), None)
        for node in ast.walk(function) if function else ():
            if isinstance(node, ast.Call):
                lines.setdefault(last_name(node), set()).add(node.lineno)
                waiting.append(last_name(node))
    return {name: sorted(found) for name, found in lines.items()}


def _is_main(node: ast.AST) -> bool:
    return isinstance(node, ast.If) and "__name__" in ast.dump(node.test)


def _sunken_main(tree: ast.Module) -> tuple[int, str] | tuple[()]:
    """(line, function) of `if __name__ == '__main__':` within a function; empty if there is none."""
    for function in ast.walk(tree):
        if isinstance(function, ast.FunctionDef):
            for node in ast.walk(function):
                if isinstance(node, ast.If) and _is_main(node):
                    return node.lineno, function.name
    return ()


def _odd_main(tree: ast.Module, text: str, names: dict[str, int]) -> tuple[int, str] | tuple[()]:
    """(line, text) of `if __name__ == ' main ':` and its like; empty if there is none."""
    for node in tree.body:
        if not (isinstance(node, ast.If) and isinstance(node.test, ast.Compare)):
            continue
        left, right = text_of(node.test.left), text_of(node.test.comparators[0])
        if left in names or left.strip("_") != "name" or right.strip(" _") != "main":
            continue
        if (left, right) != ("__name__", "__main__"):
            return node.lineno, python_lines(text)[node.lineno - 1].strip()
    return ()


def _odd_node(tree: ast.Module) -> tuple[int, str] | tuple[()]:
    """(line, name) of rospy.init_node('joy2twist.py') and its like; empty if there is none."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and last_name(node) == "init_node" and node.args:
            name = getattr(node.args[0], "value", None)
            # With a / it comes to no warning: rospy refuses it.
            if isinstance(name, str) and not re.fullmatch(r"[A-Za-z]\w*|.*/.*|", name):
                return node.lineno, name
    return ()
