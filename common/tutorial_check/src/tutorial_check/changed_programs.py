"""A program's text with one thing changed, to see what it does then. Pure."""

from __future__ import annotations

import ast

from tutorial_check.python_text import last_name, python_lines, text_of


def unmasked(text: str) -> str | None:
    """Return the program with every except: that hides all made to catch nothing; None if there is none.

    Every line keeps its number, and its margin of blanks or tabs.
    """
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError):
        return None
    lines = python_lines(text)
    hidden = [
        node
        for node in ast.walk(tree)
        if isinstance(node, ast.ExceptHandler)
        and (node.type is None or text_of(node.type) in ("Exception", "BaseException"))
    ]
    if not hidden:
        return None
    for handler in hidden:
        if handler.type:
            _put(lines, handler.type, handler.type.end_col_offset or 0, "()")
        else:
            _put(lines, handler, handler.col_offset + len("except"), "except ()")
    return "\n".join(lines) + "\n"


def without_name(text: str, name: str) -> str | None:
    """Return the program without something that it imports; None if it does not import it by name."""
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError):
        return None
    lines = python_lines(text)
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and name in {
            each.asname or each.name for each in node.names
        }:
            line = lines[node.lineno - 1]
            margin = line[: len(line) - len(line.lstrip())]
            lines.insert(node.end_lineno or node.lineno, f"{margin}del {name}")
            return "\n".join(lines) + "\n"
    return None


def flipped_anonymous(text: str, wanted: bool) -> str | None:
    """Return the program with anonymous=wanted in its init_node; None if it has none that is plain."""
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError):
        return None
    for node in ast.walk(tree):
        if not (isinstance(node, ast.Call) and last_name(node) == "init_node"):
            continue
        lines = python_lines(text)
        for word in node.keywords:
            if word.arg == "anonymous" and isinstance(word.value, ast.Constant):
                return _replaced(lines, word.value, str(wanted))
            if word.arg == "anonymous":
                return None
        if node.args:
            last = node.args[-1]
            segment = ast.get_source_segment(text, last)
            return _replaced(lines, last, f"{segment}, anonymous={wanted}") if segment else None
    return None


def _replaced(lines: list[str], node: ast.expr, new: str) -> str | None:
    if node.lineno != node.end_lineno:
        return None
    _put(lines, node, node.end_col_offset or 0, new)
    return "\n".join(lines) + "\n"


def _put(lines: list[str], node: ast.expr | ast.ExceptHandler, end: int, new: str) -> None:
    """Put a text in the place of a node, up to a column of its first line, in bytes as ast counts."""
    line = lines[node.lineno - 1].encode()
    lines[node.lineno - 1] = (line[: node.col_offset] + new.encode() + line[end:]).decode()
