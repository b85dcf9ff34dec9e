"""The text of a Python file: its coding, its lines, an expression in short. Pure."""

from __future__ import annotations

import ast
import io
import re

# In which a file is written, from a comment in the first or second line (PEP 263).
CODING = re.compile(rb"(?:[ \t\f]*(?:#[^\n]*)?\n)??[ \t\f]*#[^\n]*?coding[:=][ \t]*([-\w.]+)")


def unreadable(data: bytes) -> tuple[int, str] | None:
    """Return (line, what is there) of the first thing in a file that is not of its coding; None if all is."""
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
