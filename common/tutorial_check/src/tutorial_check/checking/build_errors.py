"""Errors that catkin_make prints: its own, and those of CMake, compiler, linker and genmsg."""

from __future__ import annotations

import os
import re
from pathlib import Path

from node_kit.printable import printable
from tutorial_check.checking.causes import advice, is_lacking, meant, packages_of_ros
from tutorial_check.checking.compiler_errors import OUTSIDE, of_compiler
from tutorial_check.checking.header_errors import is_outside
from tutorial_check.checking.linker_errors import SOURCES, of_linker
from tutorial_check.checking.make_output import EXPECTED, Target, build_hint, failed_target
from tutorial_check.checking.results import Wrong
from tutorial_check.checking.submission import Submission
from tutorial_check.submission.launch_xml import place_of

NOTABLE = re.compile(
    r"Error at|CMake Error|^E: |mismatched tag|error:|Could not find|Multiple packages"
)
MAKE_ERROR = re.compile(r"^make\[\d+\]: \*\*\* \[")
CMAKE_ERROR = re.compile(r"^CMake Error(?: at [^\n]*)?:\s(.*?)(?:\n\n\n|\Z)", re.M | re.S)
DETAILS = re.compile(r"Call Stack|Tried\s+extensions|See\s+documentation|\n(?:CMake |-- )")
TAKEN = re.compile(
    r'create target "(\S{1,200})" because another target with the same name already exists\.'
    r' .{1,100} source directory "([^"]{1,500})"'
)
NO_SOURCE = re.compile(r"Cannot find source file: (\S{1,300})")
NAMED_TARGET = re.compile(r'language for target:? "?([^\s".]{1,200})')
# What is compiled, what package is configured, or that neither is going on.
STEP = re.compile(
    r"Building \w+ object (\S{1,200}?)/CMakeFiles/\S{1,200}?\.dir/(\S{1,200}?)\.o$"
    r"|==> add_subdirectory\((\S{1,200})\)|Built target", re.M
)  # fmt: skip
COMMANDS = ("execute_process", "add_custom_", "file(DOWNLOAD", "while(", "include(")
# genmsg's errors about a message or service: (file, type) or (file, what it read there).
DEFINITION = re.compile(
    r"messages which\s+'([^']+)'\s+depends.+?message\s+\[(\S+)\]"
    r"|InvalidMsgSpec: (/\S+): (?:Invalid declaration: ([^\n]+)|(\S+) is not a legal)", re.DOTALL
)  # fmt: skip


def build_error(submission: Submission, output: str) -> Wrong:
    """Return the Wrong for the first error in what catkin_make printed."""
    output = printable(output)
    is_of_cmake = CMAKE_ERROR.search(output)
    readers = () if is_of_cmake else (of_compiler, of_linker)
    for read in (_of_definition, _of_package, _of_included, _of_target, *readers):
        error = read(submission, output)
        if error:
            return error
    return _other(submission, output)


def endless_build(submission: Submission, output: str) -> Wrong:
    """Return the Wrong for a catkin_make that has not ended, from what it has printed."""
    steps = [("", "", ""), *STEP.findall(printable(output))]
    folder, source, configured = steps[-1]
    if source:
        where, seen = f"{folder}/{source}", "compiling takes more than two minutes"
    else:
        packages = sorted(submission.packages, key=lambda package: package.inside != configured)
        places = (Target(package).line_with(*COMMANDS) for package in packages)
        where = next(filter(None, places), "")
        seen = "CMake or a command takes more than two minutes"
    return Wrong("catkin_make ends", seen, where, build_hint("catkin_make", seen))


def missing_in(output: str) -> list[str]:
    """Return the packages that CMake does not find. CMake wraps and indents long lines."""
    return re.findall(r'[Cc]ould not find (?:[^"\n]|\n  (?=\S))*"([^"]+)"', output)


def not_found(submission: Submission, name: str) -> tuple[str, str, str]:
    """Return (seen, where, hint) for a package in CMakeLists.txt that catkin does not find."""
    packages = submission.packages
    cmakes = [(f"{package.inside}/CMakeLists.txt", package.cmake or "") for package in packages]
    places = ((place_of(file, text, name), text) for file, text in cmakes if name in text)
    place, text = next(places, ("", ""))
    wanted = " ".join(submission.course.packages.values()).split()
    absent = {name for name in wanted if name not in text}
    hint = ""
    if "," not in name and not is_lacking(name):
        hint = meant(name, absent, 0.65, f"correct {name} to {{}} in CMakeLists.txt")
    hint = hint or advice(name, packages_of_ros(name))
    hint = hint or f"is {name} spelt right in find_package of CMakeLists.txt, and without a comma?"
    return f"catkin cannot find {name}", place, hint


def _of_definition(submission: Submission, output: str) -> Wrong | None:
    """Return the Wrong for a message or service with an unknown type or an invalid field."""
    definition = DEFINITION.search(output)
    if not definition:
        return None
    path = Path(definition[1] or definition[3])
    word = definition[2] or definition[4] or definition[5]
    where = place_of(str(path.relative_to(submission.source)), submission.read(path), word)
    hint = "a field is TYPE NAME, as int64 num; another package's type has that before it"
    return Wrong(EXPECTED, f"{path.name}: {word} is no field of a known type"[:300], where, hint)


def _of_package(submission: Submission, output: str) -> Wrong | None:
    missing = missing_in(output)
    if not missing:
        return None
    seen, place, hint = not_found(submission, missing[0])
    return Wrong(EXPECTED, seen[:300], place or _own_line(output), hint)


def _of_included(submission: Submission, output: str) -> Wrong | None:
    """Return the Wrong for CMake's error in a file outside of the package. It quotes nothing."""
    error = CMAKE_ERROR.search(output)
    path = re.match(r"CMake Error at (/[^\n]{1,500}?):\d", error[0]) if error else None
    if not path or not is_outside(submission, path[1]):
        return None
    places = (Target(p).line_with(path[1], "include(", "include (") for p in submission.packages)
    where = next(filter(None, places), "")
    return Wrong(EXPECTED, f"CMake includes {path[1]}"[:300], where, build_hint("header", OUTSIDE))


def _of_target(submission: Submission, output: str) -> Wrong | None:
    """Return the Wrong for a target with a name that is taken, or without its source file."""
    message, place = _of_cmake(output), _own_line(output)
    taken, source = TAKEN.search(message), NO_SOURCE.search(message)
    inside = place.rpartition("/CMakeLists.txt")[0]
    folder = os.path.realpath(taken[2]) if taken else ""
    other = next((p for p in submission.packages if os.path.realpath(p.folder) == folder), None)
    if taken and other:
        seen = f"two targets are named {taken[1]}: this one, and {Target(other, taken[1]).where}"
        is_own = other.inside == inside
        text = message if is_own else f"{taken[1]} is a target of {other.name}, too"
        return Wrong(EXPECTED, seen[:300], place, build_hint("catkin_make", text[:1000]))
    package = next((p for p in submission.packages if p.inside == inside), None)
    if not source or not package:
        return None
    files = [path for path in sorted(package.folder.rglob("*")) if path.suffix in SOURCES]
    names = {path.stem: path.relative_to(package.folder).as_posix() for path in files}
    near = names.get(meant(Path(source[1]).stem, names, 0.7, "{}"))
    hint = f"is {near} meant?" if near else build_hint("catkin_make", message[:1000])
    return Wrong(EXPECTED, f"CMake: {message}"[:300], place, hint)


def _other(submission: Submission, output: str) -> Wrong:
    """Return the Wrong for a CMake error, or for any other line."""
    lines = [line.strip() for line in output.splitlines()]
    notable = (next(filter(pattern.search, lines), "") for pattern in (NOTABLE, MAKE_ERROR))
    words = next(filter(None, notable), lines[-1] if lines else "")
    message, place = _of_cmake(output), _own_line(output)
    if MAKE_ERROR.search(words):
        place = failed_target(submission, output).where
    if words.startswith("CMake Error") and message:
        words = f"CMake: {message}"
    named = NAMED_TARGET.search(message)
    if named and not place:
        targets = (Target(package, named[1]) for package in submission.packages)
        place = next((t.where for t in targets if f"({named[1]}" in t.cmake), "")
    return Wrong(EXPECTED, words[:300], place, build_hint("catkin_make", message[:1000]))


def _of_cmake(output: str) -> str:
    """Return CMake's first error, in one line, or ""."""
    error = CMAKE_ERROR.search(output)
    return " ".join(DETAILS.split(error[1])[0].split()) if error else ""


def _own_line(output: str) -> str:
    """Return the student's line that a CMake error comes from, or "".

    The error itself is often in one of catkin's files; the call stack names the student's line.
    """
    error = CMAKE_ERROR.search(output)
    own = re.search(r"(?<!\S)[^/\s]\S*/CMakeLists\.txt:\d+", error[0] if error else "")
    return own[0] if own else ""
