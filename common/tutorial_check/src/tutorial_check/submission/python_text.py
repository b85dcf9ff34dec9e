"""The text of a Python file: encoding, lines, expressions, and changed copies."""

from __future__ import annotations

import ast
import io
import re
from typing import Iterable

# The encoding in a comment in the first or second line (PEP 263).
CODING = re.compile(rb"(?:[ \t\f]*(?:#[^\n]*)?\n)??[ \t\f]*#[^\n]*?coding[:=][ \t]*([-\w.]+)")
# The start of an except that hides every error.
MASK = re.compile(
    r"^([ \t]*except)\b[ \t(]{0,99}(?:(?:Base)?Exception)?\)?(?=[ \t]{0,99}(?:as\b.*)?:)", re.M
)


def unreadable(data: bytes) -> tuple[int, str] | None:
    """Return (line, what is wrong) of the first bytes that do not fit the encoding, or None."""
    declared = CODING.match(data)
    coding = declared[1].decode() if declared else "utf-8"
    try:
        data.decode(coding)
    except UnicodeError as error:
        start = getattr(error, "start", 0)
        what = f"the byte 0x{data[start]:02x}, which is not {coding.upper()}"
        return data.count(b"\n", 0, start) + 1, what
    except LookupError:
        end = declared.end() if declared else 0
        return data.count(b"\n", 0, end) + 1, f"an unknown encoding, {coding}"
    return None


def python_lines(text: str) -> list[str]:
    """Return the lines as Python counts them; splitlines() also splits at form feed and U+2028."""
    return [line.rstrip("\r\n") for line in io.StringIO(text, newline="")]


def text_of(node: ast.AST) -> str:
    """Return a short text of an expression, or else its kind."""
    if isinstance(node, ast.Constant):
        return str(node.value)
    if isinstance(node, ast.Name):
        return node.id
    if isinstance(node, ast.Attribute):
        return f"{text_of(node.value)}.{node.attr}"
    if isinstance(node, ast.Call):
        return f"{text_of(node.func)}()"
    if isinstance(node, ast.Lambda):
        return "lambda"
    return type(node).__name__


def last_name(node: ast.Call) -> str:
    return text_of(node.func).rsplit(".", 1)[-1]


def is_broad(handler: ast.ExceptHandler) -> bool:
    """Return whether a handler catches every error."""
    return not handler.type or text_of(handler.type) in ("Exception", "BaseException")


def _joined(lines: Iterable[str]) -> str:
    return "".join(f"{line}\n" for line in lines)


def unmasked(text: str) -> str | None:
    """Return the program with each catch-all except catching nothing; None if it has none."""
    changed, count = MASK.subn(r"\1 ()", _joined(python_lines(text)))
    return changed if count else None


def without_name(text: str, name: str) -> str | None:
    """Return the program without an imported name; None if it does not import it."""
    lines = python_lines(text)
    for node in ast.walk(ast.parse(text)):
        if not isinstance(node, ast.ImportFrom):
            continue
        if name in {alias.asname or alias.name for alias in node.names}:
            line = lines[node.lineno - 1]
            margin = line[: len(line) - len(line.lstrip())]
            lines.insert(node.end_lineno or node.lineno, f"{margin}del {name}")
            return _joined(lines)
    return None


def flipped_anonymous(text: str, wanted: bool) -> str | None:
    """Return the program with anonymous=wanted in init_node; None if that cannot be changed."""
    for node in ast.walk(ast.parse(text)):
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
