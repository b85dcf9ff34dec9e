"""Formulas over a gamepad's axes and buttons, such as "max(axes[5], 0.0) * -1.0"."""

from __future__ import annotations

import ast
import operator
from typing import Any, Callable, Mapping, Sequence

Controls = Mapping[str, Sequence[float]]  # axes and buttons
Formula = Callable[[Controls], Any]

LONGEST = 1000  # characters, as upstream has it
NAMES = ("axes", "buttons")
OPERATORS: dict[type, Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.BitXor: operator.xor,
}
FUNCTIONS: dict[str, Callable[..., Any]] = {"abs": abs, "max": max, "min": min}
ALLOWED = "numbers, axes[N], buttons[N], + - * / ^, abs, max, min"


def formula(value: object) -> Formula:
    """Return a text or number as a function of the controls. Raises ValueError.

    The function raises IndexError if the gamepad lacks a control, and the errors of arithmetic.
    """
    text = str(value)
    try:
        if len(text) > LONGEST:
            raise ValueError
        return _compiled(ast.parse(text.strip(), mode="eval").body)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise ValueError(f"{text[:60]!r}: must be made of {ALLOWED}") from None


def _compiled(node: ast.AST) -> Formula:
    """Return what a part of a formula computes. Raises ValueError."""
    if isinstance(node, ast.Constant) and type(node.value) in (int, float):
        number = node.value
        return lambda _: number
    if isinstance(node, ast.BinOp) and type(node.op) in OPERATORS:
        apply, left, right = OPERATORS[type(node.op)], _compiled(node.left), _compiled(node.right)
        return lambda controls: apply(left(controls), right(controls))
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        operand = _compiled(node.operand)
        return lambda controls: -operand(controls)
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and not node.keywords:
        function, values = FUNCTIONS.get(node.func.id), [_compiled(part) for part in node.args]
        if function and (len(values) == 1 if function is abs else len(values) > 1):
            return lambda controls: function(*(value(controls) for value in values))
    if isinstance(node, ast.Subscript) and isinstance(node.value, ast.Name):
        name, index = node.value.id, _index(node.slice)
        if name in NAMES and index is not None:
            return lambda controls: controls[name][index]
    raise ValueError


def _index(node: Any) -> int | None:
    node = node.value if type(node).__name__ == "Index" else node  # Python 3.8 wraps it
    is_whole = isinstance(node, ast.Constant) and type(node.value) is int
    return node.value if is_whole else None
