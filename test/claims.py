#!/usr/bin/python3
"""Check test/CLAIMS.md: the tests that it names exist; it names rostests, system and browser tests.

A name is a path, which stands for all tests in it, or PATH::TEST, in backquotes.
"""

import re
import sys
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[1]
CLAIMS = REPOSITORY / "test/CLAIMS.md"
NAMED = re.compile(r"`(test/[^`:]+)(?:::([^`]+))?`")


def tests_in(path):
    return re.findall(r"^def (test_\w+)", path.read_text(), re.M)


def to_be_named():
    """Yield (path, name) of each test that a claim must name; of a rostest the name is empty."""
    for kind in ("system", "browser"):
        for path in sorted(REPOSITORY.glob(f"test/*/{kind}/test_*.py")):
            yield from ((path, name) for name in tests_in(path))
    for path in sorted(REPOSITORY.glob("test/*/ros/*.py")):
        beside = path.with_suffix(".test")
        yield (beside if beside.exists() else path), ""


def complaints():
    """Yield a line for each name that is wrong, and for each test without a claim."""
    named = [(REPOSITORY / path, name) for path, name in NAMED.findall(CLAIMS.read_text())]
    for path, name in named:
        test = re.compile(rf"\b{re.escape(name.split('[')[0].split('::')[-1])}\b")
        if not path.exists():
            yield f"{path.relative_to(REPOSITORY)}: there is no such file"
        elif name and not test.search(path.read_text()):
            yield f"{path.relative_to(REPOSITORY)}: it has no test {name}"
    known = {*named, *((path, "") for path, _ in named)}
    whole = {path for path, name in named if not name}
    for path, name in to_be_named():
        if path not in whole and (path, name) not in known:
            yield f"{path.relative_to(REPOSITORY)}: no claim names {name or 'it'}"


if __name__ == "__main__":
    sys.exit("\n".join(complaints()) or None)
