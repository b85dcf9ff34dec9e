"""No Python file needs more than Python 3.8, ROS Noetic's own, as far as vermin (PyPI) knows."""

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
    """Yield every .py, and every script that says so in its first line."""
    for path in sorted(REPOSITORY.rglob("*")):
        hidden = any(part.startswith(".") for part in path.relative_to(REPOSITORY).parts)
        if not hidden and path.is_file() and path.suffix in ("", ".py"):
            first = path.read_bytes().partition(b"\n")[0]
            if path.suffix or (first.startswith(b"#!") and b"python" in first):
                yield path


def violations(*files):
    """Return what vermin finds in the files beyond Python 3.8; empty if they are well."""
    # Annotations that Python 3.8 evaluates are found by ruff (FA102).
    options = ["--target=3.8-", "--violations", "--no-eval-annotations", "--no-tips", "--quiet"]
    done = subprocess.run(
        [sys.executable, "-c", "import vermin; vermin.main()", *options, *map(str, files)],
        capture_output=True, text=True, check=False, timeout=300,
    )  # fmt: skip
    assert not done.stderr, done.stderr
    return done.stdout if done.returncode else ""


def test_no_file_needs_more_than_python_3_8():
    files = list(python_files())
    names = {path.name for path in files}
    assert {"demo.py", "joy_node", "conftest.py", "test_python_versions.py"} <= names
    assert violations(*files) == ""


@pytest.mark.parametrize(
    "newer",
    [
        "print('a'.removeprefix('a'))",
        "match 1:\n    case 1: pass",
        "with (open('a') as a, open('b') as b): pass",
        "import tomllib",
    ],
)
def test_newer_python_is_found(tmp_path, newer):
    (tmp_path / "newer.py").write_text(newer + "\n")
    assert violations(tmp_path / "newer.py")
