"""What README.md and docstrings list is what the code has: parameters."""

import ast
import re
from dataclasses import fields
from pathlib import Path

import pytest

from joy_to_twist.parameters import AXIS_DEFAULTS, Parameters

PACKAGE = Path(__file__).parents[3] / "joy2twist"
DEFAULTS = {**AXIS_DEFAULTS, **{f.name: f.default for f in fields(Parameters) if f.metadata}}


def written(default):
    """A default as it is written in YAML."""
    return str(default).lower() if isinstance(default, bool) else str(default)


def node_docstring():
    module = ast.parse((PACKAGE / "src/joy_to_twist/node.py").read_text())
    (node,) = (part for part in module.body if isinstance(part, ast.ClassDef))
    return ast.get_docstring(node)


@pytest.mark.parametrize(
    "documented",
    [
        re.findall(r"^\| `~(\w+)` \| ([^|]+) \|", (PACKAGE / "README.md").read_text(), re.M),
        re.findall(r"\b(\w+): ([\w.-]+)(?: [\w/]+)?[,.]", node_docstring().split("Private")[1]),
    ],
    ids=["README", "docstring"],
)
def test_parameters(documented):
    assert sorted(name for name, _ in documented) == sorted(DEFAULTS)
    for name, default in documented:
        if DEFAULTS[name] is not None:  # else it depends on another parameter
            assert default == written(DEFAULTS[name]), name
