"""No Python file needs more than Python 3.8, ROS Noetic's own, as far as vermin (PyPI) knows."""

import ast
import importlib.util
import subprocess
import sys
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[2]
pytestmark = pytest.mark.skipif(
    not importlib.util.find_spec("vermin"), reason="vermin missing: ./tutorial setup"
)


def python_files():
    """Every .py, and every script that says so in its first line."""
    for path in sorted(REPOSITORY.rglob("*")):
        hidden = any(part.startswith(".") for part in path.relative_to(REPOSITORY).parts)
        if not hidden and path.is_file():
            with path.open("rb") as file:
                first = file.readline() if path.suffix == "" else b""
            if path.suffix == ".py" or (first.startswith(b"#!") and b"python" in first):
                yield path


def violations(*files):
    """What vermin finds in the files beyond Python 3.8; empty if they are well."""
    # Annotations too: without a __future__ import, Python 3.8 evaluates them.
    options = ["--target=3.8-", "--violations", "--eval-annotations", "--no-tips", "--quiet"]
    done = subprocess.run(
        [sys.executable, "-c", "import vermin; vermin.main()", *options, *map(str, files)],
        capture_output=True, text=True, check=False, timeout=300,
    )  # fmt: skip
    assert not done.stderr, done.stderr
    unions = [f"{path}: X | Y in an annotation" for path in files if has_union_annotation(path)]
    return "\n".join([done.stdout, *unions]) if done.returncode or unions else ""


def has_union_annotation(path):
    """Whether a type stands as X | Y in an annotation, which vermin takes for numbers: 3.10."""
    tree = ast.parse(path.read_bytes())
    if any(isinstance(n, ast.ImportFrom) and n.module == "__future__" for n in ast.walk(tree)):
        return False
    annotations = [
        annotation
        for node in ast.walk(tree)
        for annotation in (getattr(node, "annotation", None), getattr(node, "returns", None))
        if annotation
    ]
    return any(isinstance(n, ast.BitOr) for root in annotations for n in ast.walk(root))


def test_no_file_needs_more_than_python_3_8():
    files = list(python_files())
    names = {path.name for path in files}
    assert {"demo.py", "joy_node", "conftest.py", "test_python_versions.py"} <= names
    found = violations(*files)
    assert not found, found


@pytest.mark.parametrize(
    "newer",
    [
        "def f(a: int | None): pass",
        "def f() -> int | None: pass",
        "names: list[str] = []",
        "print('a'.removeprefix('a'))",
        "match 1:\n    case 1: pass",
        "with (open('a') as a, open('b') as b): pass",
        "import tomllib",
    ],
)
def test_newer_python_is_found(tmp_path, newer):
    (tmp_path / "newer.py").write_text(newer + "\n")
    assert violations(tmp_path / "newer.py")
