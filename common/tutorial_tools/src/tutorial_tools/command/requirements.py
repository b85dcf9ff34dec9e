"""Reads a file of requirements for pip."""

from __future__ import annotations

import operator
import re

SIGNS = {"<": operator.lt, ">=": operator.ge, "==": operator.eq}


def names_of(requirements: str, minor: int) -> list[str]:
    """Return the names of the requirements that apply to Python 3.minor."""
    line = r"^([a-z-]+)[=[][^;\n]*(?:; python_version (<|>=|==) \"3\.(\d+)\")?"
    return [
        name
        for name, sign, bound in re.findall(line, requirements, re.M)
        if not sign or SIGNS[sign](minor, int(bound))
    ]
