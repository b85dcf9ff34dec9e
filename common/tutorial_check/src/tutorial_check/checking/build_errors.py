"""Errors that catkin_make prints: its own, and those of CMake, compiler, linker and genmsg."""

from __future__ import annotations

import re
from pathlib import Path

from node_kit.printable import printable
from tutorial_check.checking.causes import advice, explained, is_lacking, meant, packages_of_ros
from tutorial_check.checking.results import Wrong
from tutorial_check.checking.submission import Submission
from tutorial_check.submission.launch_xml import place_of
from tutorial_check.submission.packages import Package

EXPECTED = "catkin_make without an error"
NOTABLE = re.compile(r"Error at|^E: |mismatched tag|error:|Could not find|Multiple packages")
CMAKE_ERROR = re.compile(r"^CMake Error(?: at [^\n]*)?:\s(.*?)(?:\n\n\n|\Z)", re.M | re.S)
# genmsg's errors about a message or service: (file, type) or (file, what it read there).
DEFINITION = re.compile(
    r"messages which\s+'([^']+)'\s+depends.+?message\s+\[(\S+)\]"
    r"|InvalidMsgSpec: (/\S+): (?:Invalid declaration: ([^\n]+)|(\S+) is not a legal)", re.DOTALL
)  # fmt: skip
# Bounded, because an unbounded search takes quadratic time.
COMPILER = re.compile(r"^(/[^\s:]+):(\d+):(?:\d+:)? (?:fatal )?error: ([^\n]{1,300})", re.M)
LINKER = re.compile(
    r"undefined reference to [^\n]{1,260}|cannot find -l[^\s:]{1,99}"
    r"|multiple definition of [^;\n]{1,260}"
)
TARGET = re.compile(r"\*\*\* \[(\S{1,200}?)/CMakeFiles/(\S{1,200}?)\.dir/")  # package, target
SOURCE = re.compile(r"(?<!\S)(/[^\s:]+):(\d+)[:,]")
HEADER = re.compile(r"([\w.+-]+)/(\S+)\.h(?:pp)?: No such file")
# {folder: what CMakeLists.txt needs to generate a header from a file in it}
MAKERS = {
    "msg": ("add_message_files", "generate_messages"),
    "srv": ("add_service_files", "generate_messages"),
    "action": ("add_action_files", "generate_messages"),
    "cfg": ("generate_dynamic_reconfigure_options",),
}
# What a generated header's name adds to that of its source file.
MADE = "(?:Request|Response|Config|(?:Action)?(?:Goal|Result|Feedback)?)"


def build_error(submission: Submission, output: str) -> Wrong:
    """Return the Wrong for the first error in what catkin_make printed."""
    output = printable(output)
    is_of_cmake = CMAKE_ERROR.search(output)
    readers = () if is_of_cmake else (_of_compiler, _of_linker)
    for read in (_of_definition, _of_package, *readers):
        error = read(submission, output)
        if error:
            return error
    return _other(output)


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


def _hint(text: str) -> str:
    hint = "".join(explained("catkin_make", text))
    return hint or "read the first error of catkin_make: it names file and line"


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


def _of_compiler(submission: Submission, output: str) -> Wrong | None:
    error = COMPILER.search(output)
    if not error:
        return None
    # The compiler often reports an error in a template at the system's header.
    places = [place for place in (error, *SOURCE.finditer(output)) if submission.is_own(place[1])]
    path, line = places[0].group(1, 2) if places else error.group(1, 2)
    where = f"{Path(path).relative_to(submission.source)}:{line}" if places else f"{path}:{line}"
    hint = _of_header(submission, error[3], _target(submission, output)[1]) or _hint(error[3])
    return Wrong(EXPECTED, error[3], where, hint)


def _of_header(submission: Submission, message: str, target: str) -> str:
    """Return what to do about a missing header; "" if the message is about something else."""
    header = HEADER.search(message)
    if not header:
        return ""
    packages = (package for package in submission.packages if package.name == header[1])
    package = next(packages, None)
    if not package:
        return advice(header[1], packages_of_ros(header[1]))
    files = [path for kind in MAKERS for path in (package.folder / kind).glob("*")]
    for path in files:
        if not re.fullmatch(re.escape(path.stem) + MADE, header[2]):
            continue
        lacking = [name for name in MAKERS[path.parent.name] if name not in (package.cmake or "")]
        if lacking:
            return f"no header is made of {path.name}: CMakeLists.txt lacks {' and '.join(lacking)}"
        return _hint(f"{target} is compiled before {path.name}")
    own = list(package.folder.glob(f"include/{header[1]}/{header[2]}.h*"))
    return _hint("header in include") if own else ""


def _of_linker(submission: Submission, output: str) -> Wrong | None:
    error = LINKER.search(output)
    if not error:
        return None
    package, target = _target(submission, output)
    text = package.cmake or "" if package else ""
    text = text.replace("${PROJECT_NAME}", package.name if package else "")
    links = rf"target_link_libraries\s*\(\s*{re.escape(target)}\s[^)]*catkin_LIBRARIES"
    unlinked = "" if re.search(links, text, re.IGNORECASE) else f"{target} without libraries: "
    where = ""
    if package:
        words = (f"add_executable({target}", f"add_library({target}", f"({target}")
        where = place_of(f"{package.inside}/CMakeLists.txt", text, *words)
    return Wrong(EXPECTED, f"{target}: {error[0]}"[:300], where, _hint(unlinked + error[0]))


def _target(submission: Submission, output: str) -> tuple[Package | None, str]:
    """Return (the package, the target) at which make failed."""
    target = TARGET.search(output)
    if not target:
        return None, ""
    inside = (package for package in submission.packages if package.inside == target[1])
    return next(inside, None), target[2]


def _other(output: str) -> Wrong:
    """Return the Wrong for a CMake error, or for any other line."""
    lines = [line.strip() for line in output.splitlines()]
    words = next(filter(NOTABLE.search, lines), lines[-1] if lines else "")
    error = CMAKE_ERROR.search(output)
    message = " ".join(error[1].split("Call Stack")[0].split()) if error else ""
    if words.startswith("CMake Error") and message:
        words = f"CMake: {message}"
    return Wrong(EXPECTED, words[:300], _own_line(output), _hint(message[:1000]))


def _own_line(output: str) -> str:
    """Return the student's line that a CMake error comes from, or "".

    The error itself is often in one of catkin's files; the call stack names the student's line.
    """
    error = CMAKE_ERROR.search(output)
    own = re.search(r"(?<!\S)[^/\s]\S*/CMakeLists\.txt:\d+", error[0] if error else "")
    return own[0] if own else ""
