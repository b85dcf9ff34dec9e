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


def test_no_file_needs_more_than_python_3_8():
    # Annotations that Python 3.8 evaluates are found by ruff (FA102).
    options = ["--target=3.8-", "--violations", "--no-eval-annotations", "--no-tips", "--quiet"]
    vermin = [sys.executable, "-c", "import vermin; vermin.main()", *options]
    done = subprocess.run(
        [*vermin, *map(str, python_files())], capture_output=True, text=True, check=False
    )
    assert not done.returncode, done.stdout + done.stderr
