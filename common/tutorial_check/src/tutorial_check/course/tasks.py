"""Variants: the values of a student's task that differ from the course, from a file or seed."""

from __future__ import annotations

import hashlib
import re
from pathlib import Path
from types import MappingProxyType
from typing import Any, Dict, Mapping

import yaml

from tutorial_check.course.definition import Course, package_of, read_yaml
from tutorial_check.errors import CannotCheck

Variant = Dict[str, Any]  # {name: value}; for others the course's defaults hold
SHEET = (
    "# {title}: the task of {name}\n\n{tasks}\n\n"
    "To check it yourself keep this as variant.yaml:\n\n{file}"
)


class Task:
    """What a variant changes for the checker; a course may have a subclass that changes more."""

    # {a topic's name in the checks: its name in the student's programs}
    topics: Mapping[str, str] = MappingProxyType({})

    def __init__(self, values: Variant) -> None:
        self.values = values

    def name_of(self, package: str) -> str:
        """Return the student's name of a package that the checks name."""
        return package

    def in_messages(self, package: str) -> str:
        """Return the package's name in messages other than hints."""
        return package

    def fill(self, text: str) -> str:
        """Return a check's title or command for this task, without giving its values away."""
        return text


def task_of(course: Course) -> type[Task]:
    """Return the Task of a course whose checks are loaded."""
    package = f"{package_of(course)}."
    tasks = [task for task in Task.__subclasses__() if task.__module__.startswith(package)]
    return tasks[-1] if tasks else Task


def read_variant(course: Course, file: str | Path) -> Variant:
    values = read_yaml(file)
    known = ", ".join(course.variants) or "none in this course"
    if not isinstance(values, dict):
        raise CannotCheck(f"{file}: a map of values is wanted; known are: {known}")
    for name, value in values.items():
        if name not in course.variants:
            raise CannotCheck(f"{file}: {name} is not known; known are: {known}")
        allowed = _misses(value, course.variants[name].allowed)
        if allowed:
            raise CannotCheck(f"{file}: {name}: {value!r}; allowed is {allowed}")
    whole = {name: values.get(name, value.default) for name, value in course.variants.items()}
    for name, value in course.variants.items():
        if value.unlike and whole[name] == whole[value.unlike]:
            both = f"{name} and {value.unlike} are both {whole[name]!r}"
            raise CannotCheck(f"{file}: {both}: name both")
    return values


def _misses(value: object, allowed: Any) -> str:
    """Return what is allowed instead of a value; empty if the value is allowed."""
    if isinstance(allowed, str):
        fits = isinstance(value, str) and re.fullmatch(allowed, value)
        return "" if fits else f"what fits {allowed}"
    ranges = allowed if isinstance(allowed[0], list) else [allowed]
    kinds = (int,) if isinstance(ranges[0][0], int) else (int, float)
    if type(value) in kinds and any(lowest <= value <= highest for lowest, highest in ranges):
        return ""
    return " or ".join(f"{lowest} to {highest}" for lowest, highest in ranges)


def drawn(course: Course, seed: str, name: str) -> Variant:
    """Return the Variant that a seed draws for a student, the same on every machine."""
    values: Variant = {}
    for key, value in course.variants.items():
        choices = [choice for choice in value.draw if choice != values.get(value.unlike)]
        digest = hashlib.sha256("\0".join((seed, name, key)).encode("utf-8", "replace")).digest()
        values[key] = choices[int.from_bytes(digest, "big") % len(choices)]
    return values


def variant_of(course: Course, name: str, file: str | None, seed: str | None = None) -> Variant:
    """Return a student's Variant: from NAME.yaml in a folder, drawn, or from the file for all.

    name: empty for the caller's own workspace, which needs no folder of tasks.
    """
    path = Path(file) if file else None
    if path and path.is_dir():
        if not name:
            raise CannotCheck("--variant FOLDER is for --all and --show-variant")
        path = path / f"{name}.yaml"
        if path.is_symlink():
            raise CannotCheck(f"{path}: a link is not followed: put the file itself here")
        if path.exists():
            return read_variant(course, path)
        path = None
    if seed is not None:
        return drawn(course, seed, name)
    return read_variant(course, path) if path else {}


def sheet(course: Course, values: Variant, name: str) -> str:
    """Return a student's task sheet. Raises CannotCheck if nothing differs from the course."""
    if not values:
        raise CannotCheck(f"no variant of {name}: --variant FILE, or --variants SEED")
    words = {"title": course.title, "file": yaml.safe_dump(values, sort_keys=False).rstrip()}
    lines = [_filled(course.variants[key].about, {"is_": values[key]}) for key in values]
    words.update(tasks="\n".join(f"- {line}" for line in lines), name=name)
    return _filled(course.sheet or SHEET, words)


def _filled(text: str, words: Mapping[str, Any]) -> str:
    """Return a text with {names} replaced. str.format would accept a width of a gigabyte."""
    return re.sub(r"\{(\w+)\}", lambda name: str(words.get(name[1], name[0])), text)
