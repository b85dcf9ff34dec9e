"""A program's text with one thing changed, to see what it does then. Pure."""

from __future__ import annotations

import ast
from typing import Iterable

from tutorial_check.source.python_text import is_broad, last_name, python_lines


def _nodes(text: str) -> list[ast.AST]:
    try:
        return list(ast.walk(ast.parse(text)))
    except (SyntaxError, ValueError):
        return []


def _joined(lines: Iterable[str]) -> str:
    return "".join(f"{line}\n" for line in lines)


def unmasked(text: str) -> str | None:
    """Return the program with every except: that hides all made to catch nothing; None if there is none.

    Every line keeps its number, and its margin of blanks or tabs.
    """
    lines = python_lines(text)
    every = [node for node in _nodes(text) if isinstance(node, ast.ExceptHandler)]
    hidden = [handler for handler in every if is_broad(handler)]
    for handler in hidden:
        if handler.type:
            _put(lines, handler.type, handler.type.end_col_offset or 0, "()")
        else:
            _put(lines, handler, handler.col_offset + len("except"), "except ()")
    return _joined(lines) if hidden else None


def without_name(text: str, name: str) -> str | None:
    """Return the program without something that it imports; None if it does not import it by name."""
    lines = python_lines(text)
    for node in _nodes(text):
        if not isinstance(node, ast.ImportFrom):
            continue
        if name in {each.asname or each.name for each in node.names}:
            line = lines[node.lineno - 1]
            margin = line[: len(line) - len(line.lstrip())]
            lines.insert(node.end_lineno or node.lineno, f"{margin}del {name}")
            return _joined(lines)
    return None


def flipped_anonymous(text: str, wanted: bool) -> str | None:
    """Return the program with anonymous=wanted in its init_node; None if it has none that is plain."""
    for node in _nodes(text):
        if not (isinstance(node, ast.Call) and last_name(node) == "init_node"):
            continue
        given = [word.value for word in node.keywords if word.arg == "anonymous"]
        if given:
            old, new = given[0], str(wanted)
        elif node.args:
            old = node.args[-1]
            new = f"{ast.get_source_segment(text, old)}, anonymous={wanted}"
        else:
            continue
        if old.lineno != old.end_lineno or (given and not isinstance(old, ast.Constant)):
            return None
        lines = python_lines(text)
        _put(lines, old, old.end_col_offset or 0, new)
        return _joined(lines)
    return None


def _put(lines: list[str], node: ast.expr | ast.ExceptHandler, end: int, new: str) -> None:
    """Put a text in the place of a node, up to a column of its first line, in bytes as ast counts."""
    line = lines[node.lineno - 1].encode()
    lines[node.lineno - 1] = (line[: node.col_offset] + new.encode() + line[end:]).decode()
