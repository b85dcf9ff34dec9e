#!/usr/bin/python3
"""Write the READMEs' tables of parameters from the dataclasses that declare them.

--check: compare only, with exit code 1 if a table is old. Run by test/lint.
"""

import importlib
import re
import sys
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[1]
TABLES = {"joy2twist/README.md": ("joy2twist/src", "joy_to_twist.parameters", "Parameters")}
TABLE = re.compile(r"^\| parameter \| default \|.*\n(\|.*\n)+", re.MULTILINE)


def main() -> int:
    """Compare or write each table; return the exit code."""
    sys.path.insert(0, str(REPOSITORY / "common/node_kit/src"))
    old = []
    for name, (folder, module, kind) in TABLES.items():
        sys.path.insert(0, str(REPOSITORY / folder))
        readme = REPOSITORY / name
        table = importlib.import_module("node_kit.parameters").table
        declared = table(getattr(importlib.import_module(module), kind))
        text, count = TABLE.subn(lambda _, new=declared: new, readme.read_text())
        assert count == 1, name
        if text != readme.read_text():
            old.append(name)
            if "--check" not in sys.argv:
                readme.write_text(text)
    if "--check" not in sys.argv or not old:
        return 0
    print("tables of parameters that are old, which test/lint --fix mends:", *old)
    return 1


if __name__ == "__main__":
    sys.exit(main())
