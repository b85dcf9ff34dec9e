"""Which Debian package has a Python module or a ROS package: by debian_packages.yaml. Pure."""

from __future__ import annotations

import fnmatch
from pathlib import Path

import yaml

TABLES: dict[str, str] = yaml.safe_load(Path(__file__).with_suffix(".yaml").read_text())
MODULES, DEV_PACKAGES = TABLES["MODULES"], TABLES["DEV_PACKAGES"]
OTHER_MODULES, OTHER_PACKAGES = TABLES["OTHER_MODULES"], TABLES["OTHER_PACKAGES"]


def _found(table: str, name: str) -> str:
    """Return what a table has after the first pattern that fits a name, its {} filled in; or ""."""
    for row in table.strip().splitlines():
        names, _, words = row.partition(": ")
        if any(fnmatch.fnmatchcase(name, each) for each in names.split()):
            return words.replace("{}", name.lower().replace("_", "-"))
    return ""


def package_of_module(module: str) -> str:
    """Return the Debian package that has a Python module, or ""."""
    top = module.partition(".")[0]
    return _found(f"{top}: python3-{{}}" if top in MODULES.split() else OTHER_MODULES, top)


def packages_of_ros(name: str) -> str:
    """Return the Debian packages, with blanks between, that have a ROS package; or ""."""
    table = f"{name}: lib{{}}-dev" if name in DEV_PACKAGES.split() else OTHER_PACKAGES
    return _found(table, name) or package_of_module(name)


def in_place_of(name: str) -> str:
    """Return what to do without a ROS package, or module, that Debian lacks; or ""."""
    return _found(TABLES["LACKING"], name)


def advice(name: str, packages: str) -> str:
    """Return what to do about what is not installed, and is in these packages of Debian's; or ""."""
    other = in_place_of(name)
    lacks = f"Debian lacks {name}; {other}" if other else ""
    return f"Debian has it: sudo apt install {packages}" if packages else lacks
