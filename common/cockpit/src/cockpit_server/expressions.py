"""Expressions in forms, with the names that rqt_publisher has: i, time(), and functions of math.

Only what is below is evaluated, and on floats: no step takes long, whatever a page sends. (Debian
12's simpleeval computes 3999999**1999999, and takes 9 s.)
"""

import ast
import math
import operator
import random
from typing import Any, Mapping

LONGEST = 200  # characters, which bounds the depth, too
OF_MATH = """acos acosh asin asinh atan atan2 atanh ceil copysign cos cosh degrees e exp expm1 fabs
floor fmod hypot log log10 log1p log2 pi pow radians sin sinh sqrt tan tanh tau trunc"""
KNOWN: Mapping[str, Any] = {
    "Add": operator.add, "Sub": operator.sub, "Mult": operator.mul, "Div": operator.truediv,
    "FloorDiv": operator.floordiv, "Mod": operator.mod, "Pow": math.pow, "USub": operator.neg,
    "UAdd": operator.pos, "abs": abs, "max": max, "min": min, "round": round,
    **{name: getattr(math, name) for name in OF_MATH.split()},
    **{name: getattr(random, name) for name in ("gauss", "random", "uniform")},
}  # fmt: skip


def value_of(text: str, kind: type, i: int, now_s: float) -> Any:
    """Return the number of an expression, or the numbers of a list of them.

    kind: float, or int, which drops the fraction. i: number of the message, from 1. now_s: what
    time() returns. Raises any Exception.
    """
    if len(text) > LONGEST:
        raise ValueError(f"it has more than {LONGEST} characters")
    known = {**KNOWN, "i": i, "time": lambda: now_s}

    def number(node: ast.expr) -> Any:
        value = _value(node, known)
        if not math.isfinite(value):
            raise ValueError(f"it is {value}")
        return kind(value)

    tree = ast.parse(text.strip(), mode="eval").body
    return [number(node) for node in tree.elts] if isinstance(tree, ast.List) else number(tree)


def _value(node: Any, known: Mapping[str, Any]) -> float:
    if isinstance(node, ast.Constant) and isinstance(node.value, (int, float)):
        return float(node.value)
    if isinstance(node, ast.Call):
        name, operands = getattr(node.func, "id", "such function"), node.args
    else:
        name = getattr(node, "id", type(getattr(node, "op", node)).__name__)
        operands = [part for part in ast.iter_child_nodes(node) if isinstance(part, ast.expr)]
    if name not in known:
        raise ValueError(f"there is no {name}")
    if isinstance(node, ast.Name):
        return float(known[name])
    return float(known[name](*[_value(operand, known) for operand in operands]))
