"""Variants: what a student's task has in place of what the course says, from a file or a seed."""

from __future__ import annotations

import hashlib
import re
from pathlib import Path
from types import MappingProxyType
from typing import Any, Dict, Mapping

import yaml

from tutorial_check.course import Course, Value
from tutorial_check.model import CannotCheck, Result

FOLDER = "variants"  # beside what the students of --all handed in: NAME.yaml
SHEET = "# {title}: the task of {name}\n\n{tasks}\n\nTo check it yourself keep this as variant.yaml:\n\n{file}"
UNASKED = "/unasked"  # before a topic that has the checks' name in the student's programs
Variant = Dict[str, Any]  # {name of a value: what it is}; what is not named is as the course has it


class Task:
    """What a variant changes for the checker; a course that changes more has a subclass, with @task."""

    # {name that the checks have for a topic: that of the student's programs}
    topics: Mapping[str, str] = MappingProxyType({})

    def __init__(self, values: Variant) -> None:
        """values: those that are given."""
        self.values = values

    def known_as(self, package: str) -> str:
        """Return the name that the checks know a package of the student's by."""
        return package

    def named(self, package: str) -> str:
        """Return the name that the student's files have for a package that the checks name."""
        return package

    def words(self, result: Result) -> Result:
        """Return a result in the words of this task, whose values stand in hints alone."""
        return result


def read_variant(course: Course, file: str | Path) -> Variant:
    """Return the Variant of a file. Raises CannotCheck."""
    try:
        values = yaml.safe_load(Path(file).read_text(encoding="utf-8"))
    except OSError as error:
        raise CannotCheck(f"{file}: {error.strerror}") from None
    except (UnicodeDecodeError, yaml.YAMLError) as error:
        raise CannotCheck(f"{file}: no YAML: {' '.join(str(error).split())}") from None
    known = ", ".join(course.variants) or "none in this course"
    if not isinstance(values, dict):
        raise CannotCheck(f"{file}: a map of values is wanted; known are: {known}")
    for name, value in values.items():
        if name not in course.variants:
            raise CannotCheck(f"{file}: {name} is not known; known are: {known}")
        one = course.variants[name]
        if not _is_allowed(value, one):
            raise CannotCheck(f"{file}: {name}: {value!r}; allowed is {_range(one)}")
    for name, one in course.variants.items():
        both = {
            values.get(each, course.variants[each].default) for each in (name, one.unlike or name)
        }
        if one.unlike and len(both) == 1:
            raise CannotCheck(f"{file}: {name} and {one.unlike} are both {both.pop()!r}: name both")
    return values


def _is_allowed(value: Any, one: Value) -> bool:
    if isinstance(one.allowed, str):
        return isinstance(value, str) and bool(re.fullmatch(one.allowed, value))
    kinds = (int,) if isinstance(one.allowed[0], int) else (int, float)
    lowest, highest = one.allowed
    return type(value) in kinds and lowest <= value <= highest


def _range(one: Value) -> str:
    is_text = isinstance(one.allowed, str)
    return f"what fits {one.allowed}" if is_text else f"{one.allowed[0]} to {one.allowed[1]}"


def drawn(course: Course, seed: str, name: str) -> Variant:
    """Return the Variant that a seed gives a student: the same on every machine."""
    values: Variant = {}
    for key, one in course.variants.items():
        choices = [each for each in one.draw if each != values.get(one.unlike)]
        digest = hashlib.sha256("\0".join((seed, name, key)).encode("utf-8", "replace")).digest()
        values[key] = choices[int.from_bytes(digest, "big") % len(choices)]
    return values


def variant_of(course: Course, options: Any, name: str) -> Variant:
    """Return a student's Variant: from variants/NAME.yaml, or drawn, or from the file for all."""
    own = Path(options.all or "", FOLDER, f"{name}.yaml")
    if options.all and own.is_file():
        return read_variant(course, own)
    if options.variants is not None:
        return drawn(course, options.variants, name)
    return read_variant(course, options.variant) if options.variant else {}


def sheet(course: Course, values: Variant, name: str) -> str:
    """Return the task sheet of a student. Raises CannotCheck if nothing differs from the course."""
    if not values:
        raise CannotCheck(f"no variant of {name}: --variant FILE, or --variants SEED")
    tasks = "\n".join(f"- {course.variants[key].about.format(is_=values[key])}" for key in values)
    file = yaml.safe_dump(values, sort_keys=False).rstrip()
    try:
        return (course.sheet or SHEET).format(title=course.title, name=name, tasks=tasks, file=file)
    except (LookupError, ValueError) as error:
        raise CannotCheck(f"{course.folder}: sheet: {error!r}: {{tasks}}, {{name}} ...") from None
