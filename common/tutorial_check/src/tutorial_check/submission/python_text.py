"""The text of a Python file: its coding, lines, expressions; with one thing changed. Pure."""

from __future__ import annotations

import ast
import io
import re
from typing import Iterable

# In which a file is written, from a comment in the first or second line (PEP 263).
CODING = re.compile(rb"(?:[ \t\f]*(?:#[^\n]*)?\n)??[ \t\f]*#[^\n]*?coding[:=][ \t]*([-\w.]+)")
# The start of an except that hides every kind of error.
MASK = re.compile(
    r"^([ \t]*except)\b[ \t(]{0,99}(?:(?:Base)?Exception)?\)?(?=[ \t]{0,99}(?:as\b.*)?:)", re.M
)


def unreadable(data: bytes) -> tuple[int, str] | None:
    """Return (line, what is there) of the first bytes not of a file's coding; None if all are."""
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
        return data.count(b"\n", 0, end) + 1, f"a coding that is none, {coding}"
    return None


def python_lines(text: str) -> list[str]:
    """Return the lines as Python counts them; splitlines() also splits at a form feed or U+2028."""
    return [line.rstrip("\r\n") for line in io.StringIO(text, newline="")]


def text_of(node: ast.AST) -> str:
    """Return a short text of an expression; for what has none, its kind."""
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
    """Return whether it catches every kind of error."""
    return not handler.type or text_of(handler.type) in ("Exception", "BaseException")


def _joined(lines: Iterable[str]) -> str:
    return "".join(f"{line}\n" for line in lines)


def unmasked(text: str) -> str | None:
    """Return the program with each catch-all except: made to catch nothing; None without one."""
    changed, count = MASK.subn(r"\1 ()", _joined(python_lines(text)))
    return changed if count else None


def without_name(text: str, name: str) -> str | None:
    """Return the program without something that it imports; None if it imports no such name."""
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
    """Return the program with anonymous=wanted in its init_node; None if none is plain."""
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
