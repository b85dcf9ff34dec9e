#!/usr/bin/python3
"""Print pyproject.toml for import-linter, with the modules that its contracts are about filled in.

Arguments: the folders of the libraries. A contract without source_modules is about all modules
outside of folders ros and io. The checker has contracts of its own, by the folders of its pipeline.
"""

import re
import sys
from pathlib import Path

PLACES = {"ros", "io"}
OTHERS = ("courses", "ros2_tutorials", "tutorial_check")


def modules_outside(folder):
    """Yield the names of a library's modules that are in none of the places."""
    for path in sorted(folder.rglob("*.py")):
        parts = path.relative_to(folder.parent).with_suffix("").parts
        if not PLACES.intersection(parts):
            yield ".".join(part for part in parts if part != "__init__")


def main():
    folders = [Path(word) for word in sys.argv[1:]]
    libraries = [folder.name for folder in folders]
    own = [folder for folder in folders if folder.name not in OTHERS]
    outside = [name for folder in own for name in modules_outside(folder)]
    text = Path("pyproject.toml").read_text()
    for keys, names in (("root_packages|ancestors", libraries), ("source_modules", outside)):
        text = re.sub(rf"^({keys}) = \[\]", rf"\1 = {names}", text, flags=re.M)
    print(text)


if __name__ == "__main__":
    main()
