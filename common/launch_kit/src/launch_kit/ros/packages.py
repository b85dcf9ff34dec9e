"""Packages and their files: launch files of a command line, presets, programs."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

import rospkg
from roslaunch.substitution_args import SubstitutionException, resolve_args


def folder(package: str) -> Path | None:
    """Return the folder of a package, or None."""
    try:
        return Path(resolve_args(f"$(find {package})", {}))  # it remembers where packages are
    except (rospkg.ResourceNotFound, SubstitutionException):
        return None


def check_preset(value: str) -> None:
    """Check for a preset of joy2twist, unless that is a package of the user's without presets."""
    package = folder("joy2twist")
    presets = sorted(package.glob("config/*.yaml")) if package else []
    if package and presets and not (package / f"config/{value}.yaml").is_file():
        names = ", ".join(preset.stem for preset in presets)
        raise ValueError(f"there is none of this name; there are {names}")


def check_joy_package(value: str) -> None:
    """Check for a package with a joy_node."""
    import roslib.packages  # noqa: PLC0415  it takes a while

    if not folder(value):
        raise ValueError("there is no package of this name; take gamepad or joy")
    if not roslib.packages.find_node(value, "joy_node"):
        raise ValueError("this package has no joy_node; take gamepad or joy")


def named_files(words: Sequence[str]) -> list[str]:
    """Return the launch files that words of a command line name, as paths or as PACKAGE FILE.

    Empty if there is none, or if PACKAGE has several files of this name: roslaunch reports it.
    """
    words = [word for word in words if not word.startswith("-") and ":=" not in word]
    for start, word in enumerate(words):  # one before it may be the value of an option
        first = _of_package(*words[start : start + 2]) if words[start + 1 :] else []
        if first:
            return [*first, *words[start + 2 :]] if len(first) == 1 else []
        if os.path.isfile(word) and "<launch" in Path(word).read_text(errors="replace"):
            return words[start:]
    return []


def _of_package(package: str, file: str) -> list[str]:
    top = folder(package)
    if not top:
        return []
    direct = top / file
    paths = [direct] if direct.is_file() else sorted(top.rglob(Path(file).name))
    return [str(path) for path in paths if str(path).endswith(f"/{file}")]
