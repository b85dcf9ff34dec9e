"""A course: a folder with course.yaml and Python files of recorders and checks."""

from __future__ import annotations

import functools
import importlib.util
import pkgutil
import re
import shutil
import sys
import traceback
import types
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

import yaml

from tutorial_check.errors import CannotCheck

FILE = "course.yaml"
SOLUTIONS = "solutions"  # folder of a course, for the self-test
SUITE = Path(__file__).resolve().parents[5]
SHIPPED = SUITE / "common" / "courses"  # --course takes these by name, too
HANDOUT = SHIPPED / "handout"
# Wherever a course is, its modules are imported as courses.NAME.*, by the folder's name.
COURSES = "courses"
PYTHON, CPP, ANY = LANGUAGES = ("python", "cpp", "any")  # any: Python where there is one
RENAMED = ": common/doc/COURSES.md says what a course of an earlier release has to change"

# {a field's type: what YAML may give for it}; other types take anything.
KINDS: dict[str, tuple[type, ...]] = {
    "str": (str,), "bool": (bool,), "float": (int, float), "tuple": (list,), "dict": (dict,)
}  # fmt: skip


@dataclass(frozen=True)
class Exercise:
    """An exercise. document: of its sections. points: for all of it; 0: one per check."""

    title: str
    document: str = ""
    points: float = 0.0
    by_default: bool = True  # checked if no exercise is named
    solution: tuple[str, ...] = ()


@dataclass(frozen=True)
class Value:
    """A value that varies with a student's task; see common/doc/COURSES.md.

    about: its line of the task sheet. allowed: [lowest, highest], a list of these, or a regular
    expression. draw: what a seed draws from. unlike: another value, which must differ.
    """

    about: str
    allowed: Any
    draw: tuple[Any, ...]
    default: Any = None
    unlike: str = ""


@dataclass(frozen=True)
class Course:
    """The content of course.yaml. exercises: in order, by the number that the student knows.

    packages: {name: the other arguments of catkin_create_pkg}.
    """

    folder: Path
    title: str = ""
    document: str = "task"
    sheet: str = ""  # the template of a task sheet, if not tasks.SHEET
    language: str = PYTHON  # of the programs, one of LANGUAGES
    exercises: dict[str, Exercise] = field(default_factory=dict, hash=False)
    variants: dict[str, Value] = field(default_factory=dict, hash=False)
    packages: dict[str, str] = field(default_factory=dict, hash=False)

    @property
    def by_default(self) -> list[str]:
        return [name for name, exercise in self.exercises.items() if exercise.by_default]

    def meant(self, word: str) -> list[str]:
        """Return the exercises that a word selects: 4 is 4.2 to 4.5; 5.1, a section, is 5."""
        section = f"{word.rstrip('.')}."
        inner = [name for name in self.exercises if name.startswith(section)]
        whole = [name for name in self.exercises if section.startswith(f"{name}.")]
        return inner or whole or [word]

    def exercise_of(self, section: str) -> str:
        """Return the exercise with the longest number that a section begins with; or ""."""
        whole = (name for name in self.exercises if f"{section}.".startswith(f"{name}."))
        return max(whole, key=len, default="")


def package_of(course: Course) -> str:
    name = re.sub(r"\W", "_", course.folder.name)
    return f"{COURSES}.{name}"


def sources_of(folder: Path) -> list[Path]:
    """Return course.yaml and the Python files of a course, without its solutions."""
    inside = sorted(path.relative_to(folder) for path in folder.rglob("*.py"))
    return [folder / FILE, *(folder / path for path in inside if path.parts[0] != SOLUTIONS)]


def copy_sources(folder: Path, target: Path) -> None:
    """Copy a course for a worker, with its bytecode so that the worker compiles nothing."""
    for source in sources_of(folder):
        copied = target / source.relative_to(folder)
        copied.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(source, copied)
        compiled = Path(importlib.util.cache_from_source(str(source)))
        if source.suffix == ".py" and compiled.is_file():
            (copied.parent / compiled.parent.name).mkdir(exist_ok=True)
            shutil.copy2(compiled, copied.parent / compiled.parent.name)


def read_yaml(file: str | Path, what: str = "") -> object:
    """Return the content of a YAML file. Raises CannotCheck. what: added if the file is missing."""
    try:
        return yaml.safe_load(Path(file).read_text(encoding="utf-8"))
    except OSError as error:
        raise CannotCheck(f"{file}: {error.strerror}{what}") from None
    except (UnicodeDecodeError, yaml.YAMLError) as error:
        raise CannotCheck(f"{file}: no YAML: {' '.join(str(error).split())}") from None


@functools.lru_cache(maxsize=None)
def read_course(folder: str | Path = HANDOUT) -> Course:
    """Return the Course in a folder, or the shipped one of that name. Raises CannotCheck."""
    file = Path(folder).resolve() / FILE
    shipped = {path.parent.name: path for path in sorted(SHIPPED.glob(f"*/{FILE}"))}
    if str(folder) in shipped and not file.exists():
        file = shipped[str(folder)]
    names = f"; a course is a folder with {FILE}, or one of {', '.join(shipped)}"
    given = read_yaml(file, names)
    try:
        about = _known(Course, given)
        named, varied = about.pop("exercises", None), about.pop("variants", {})
        if not named:
            raise ValueError('exercises: {"1": TITLE, ...} is missing')
        course = Course(folder=file.parent, **about)
        if course.language not in LANGUAGES:
            raise ValueError(f"language: {course.language}: one of {', '.join(LANGUAGES)}")
        for number, what in named.items():
            if not isinstance(number, str):
                raise ValueError(f'exercise {number}: write "{number}", in quotes')
            words = _known(Exercise, what if isinstance(what, dict) else {"title": what})
            if not 0 <= words.get("points", 0) <= 10**6:  # not .nan, either
                raise ValueError(f"exercise {number}: points: 0 to 1000000")
            course.exercises[number] = Exercise(**{"document": course.document, **words})
        for name, what in varied.items():
            course.variants[name] = Value(**_known(Value, what))
    except (TypeError, ValueError) as error:
        raise CannotCheck(f"{file}: {error}") from None
    return course


def _known(kind: type, given: object) -> dict[str, Any]:
    """Return the given fields of a dataclass. Raises ValueError."""
    known = {known.name: str(known.type).partition("[")[0] for known in fields(kind)}
    known.pop("folder", None)  # it is where the file is
    if not isinstance(given, dict):
        raise ValueError(f"must be a map of {', '.join(known)}, not {given!r}")
    for name, value in given.items():
        if name not in known:
            raise ValueError(f"{name} is not known; known are {', '.join(known)}")
        kinds = KINDS.get(known[name], ())
        if kinds and type(value) not in kinds:
            raise ValueError(f"{name}: {value!r} is no {kinds[-1].__name__}")
    return given


def load(course: Course) -> set[str]:
    """Import all modules of a course; return their names. Raises CannotCheck."""
    package = package_of(course)
    _make_package(package, course.folder)
    try:
        modules = pkgutil.walk_packages([str(course.folder)], f"{package}.")
        return {importlib.import_module(module.name).__name__ for module in modules}
    except Exception as error:
        name = getattr(error, "name", None) or ""
        renamed = RENAMED if name.startswith(("tutorial_check", "tutorial_course")) else ""
        raise CannotCheck(f"{_place(error, course.folder)}: {error}{renamed}") from None


def _make_package(package: str, folder: Path) -> None:
    """Make a package of a folder; forget the modules of another folder of that name."""
    if package in sys.modules and [*sys.modules[package].__path__] == [str(folder)]:
        return
    for name in [known for known in sys.modules if f"{known}.".startswith(f"{package}.")]:
        del sys.modules[name]
    for name, path in ((COURSES, SHIPPED), (package, folder)):
        if name not in sys.modules:
            sys.modules[name] = types.ModuleType(name)
            sys.modules[name].__path__ = [str(path)]


def _place(error: Exception, folder: Path) -> str:
    """Return FILE:LINE of a course's exception."""
    if isinstance(error, SyntaxError):
        return f"{Path(error.filename or '').name}:{error.lineno}"
    frames = traceback.extract_tb(error.__traceback__)
    own = [frame for frame in frames if Path(frame.filename).parent == folder]
    return f"{Path(own[-1].filename).name}:{own[-1].lineno}" if own else type(error).__name__
