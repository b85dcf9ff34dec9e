"""A program's text with one thing changed, to see what it does then. Pure."""

from __future__ import annotations

import ast
import re
from typing import Iterable

from tutorial_check.source.python_text import last_name, python_lines

# The start of an except that hides every kind of error.
MASK = re.compile(r"^([ \t]*except)\b[ \t(]*(?:(?:Base)?Exception)?\)?(?=[ \t]*(?:as\b.*)?:)", re.M)


def _nodes(text: str) -> list[ast.AST]:
    try:
        return list(ast.walk(ast.parse(text)))
    except (SyntaxError, ValueError):
        return []


def _joined(lines: Iterable[str]) -> str:
    return "".join(f"{line}\n" for line in lines)


def unmasked(text: str) -> str | None:
    """Return the program with every except: that hides all made to catch nothing; None if there is none."""
    changed, count = MASK.subn(r"\1 ()", _joined(python_lines(text)))
    return changed if count else None


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
        if not given and not node.args:
            continue
        old = (given or node.args)[-1]
        if old.lineno != old.end_lineno or (given and not isinstance(old, ast.Constant)):
            return None
        new = str(wanted)
        if not given:
            new = f"{ast.get_source_segment(text, old)}, anonymous={wanted}"
        lines = python_lines(text)
        line = lines[old.lineno - 1].encode()  # ast counts bytes
        changed = line[: old.col_offset] + new.encode() + line[old.end_col_offset :]
        lines[old.lineno - 1] = changed.decode()
        return _joined(lines)
    return None
