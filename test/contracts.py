#!/usr/bin/python3
"""Print pyproject.toml for import-linter, with the modules of its contracts filled in.

Arguments: the folders of the libraries. A contract without source_modules covers all modules
outside of folders ros and io; one with "io" covers those in io. The checker has its own
contracts, by the folders of its pipeline.
"""

import re
import sys
from pathlib import Path

PLACES = {"ros", "io"}
OTHERS = ("courses", "ros2_tutorials", "tutorial_check")


def modules(folder):
    """Yield (name, place or None) of each module of a library."""
    for path in sorted(folder.rglob("*.py")):
        parts = path.relative_to(folder.parent).with_suffix("").parts
        place = next((part for part in parts if part in PLACES), None)
        yield ".".join(part for part in parts if part != "__init__"), place


def main():
    folders = [Path(word) for word in sys.argv[1:]]
    libraries = [folder.name for folder in folders]
    own = [folder for folder in folders if folder.name not in OTHERS]
    places = [module for folder in own for module in modules(folder)]
    in_io, outside = ([name for name, at in places if at == place] for place in ("io", None))
    text = Path("pyproject.toml").read_text()
    for keys, names in (("root_packages|ancestors", libraries), ("source_modules", outside)):
        text = re.sub(rf"^({keys}) = \[\]", rf"\1 = {names}", text, flags=re.M)
    text = text.replace('source_modules = ["io"]', f"source_modules = {in_io}")
    print(text)


if __name__ == "__main__":
    main()
