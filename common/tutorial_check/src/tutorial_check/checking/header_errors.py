"""Headers that the compiler does not find, and those that no program should include."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Iterator

from tutorial_check.checking.causes import advice, explained, meant, packages_of_ros
from tutorial_check.checking.make_output import Target, build_hint
from tutorial_check.checking.submission import Submission
from tutorial_check.course.definition import SUITE
from tutorial_check.submission.packages import Package

MISSING = re.compile(r"\A(\S{1,300}): No such file or directory")
IN_PACKAGE = re.compile(r"([\w.+-]+)/(\S+)\.h(?:pp)?")
SYSTEM = Path("/usr/include")
OF_LANGUAGE = "c++/*/[a-z]*"  # the standard library, in SYSTEM
OF_ROS = ("ros", "std_srvs", "tf", "tf2", "tf2_*", "actionlib", "image_transport", "*_msgs")
SUFFIXES = (".h", ".hpp", ".hh", ".hxx")
# {folder: what CMakeLists.txt needs to generate a header from a file in it}
MAKERS = {
    "msg": ("add_message_files", "generate_messages"),
    "srv": ("add_service_files", "generate_messages"),
    "action": ("add_action_files", "generate_messages"),
    "cfg": ("generate_dynamic_reconfigure_options",),
}
# What a generated header's name adds to that of its source file.
MADE = "(?:Request|Response|Config|(?:Action)?(?:Goal|Result|Feedback)?)"


def is_outside(submission: Submission, path: str) -> bool:
    """Return whether a file belongs to neither the system, ROS, nor the workspace."""
    real = Path(os.path.realpath(path))
    known = (Path("/usr"), Path("/opt"), SUITE, *submission.order.sandbox.readable)
    inside = (*known, submission.folder, *_prefixes(submission))
    return not any(Path(os.path.realpath(folder)) in real.parents for folder in inside)


def hint_of_header(submission: Submission, message: str, target: Target) -> str:
    """Return what to do about a missing header; "" if the message is about something else."""
    missing = MISSING.match(message)
    if not missing:
        return ""
    name = missing[1]
    readers = (_of_table, _generated, _own, _installed, _absent, _similar)
    hints = (read(submission, name, target) for read in readers)
    return next(filter(None, hints), "")


def _of_table(_submission: Submission, name: str, _target: Target) -> str:
    return "".join(explained("header", name))


def _generated(submission: Submission, name: str, target: Target) -> str:
    """Return what to do about a header that is generated from a message of the workspace."""
    header = IN_PACKAGE.fullmatch(name)
    packages = (package for package in submission.packages if header and package.name == header[1])
    package = next(packages, None)
    if not header or not package:
        return ""
    files = [path for kind in MAKERS for path in (package.folder / kind).glob("*")]
    path = next((p for p in files if re.fullmatch(re.escape(p.stem) + MADE, header[2])), None)
    if not path:
        return ""
    lacking = [word for word in MAKERS[path.parent.name] if word not in (package.cmake or "")]
    if lacking:
        return f"no header is made of {path.name}: CMakeLists.txt lacks {' and '.join(lacking)}"
    if package != target.package and target.lacks(package.name):
        return build_hint("header", f"{package.name} is no component")
    return build_hint("catkin_make", f"{target.name} is compiled before {path.name}")


def _own(submission: Submission, name: str, target: Target) -> str:
    """Return what to do about a header that the workspace has at another place."""
    headers = {path: package for package in submission.packages for path in _headers(package)}
    for path, package in headers.items():
        if path.as_posix().endswith(f"/{name}"):
            folder = path.as_posix()[: -len(name) - 1]
            inside = os.path.relpath(folder, package.folder)
            if inside == f"include/{package.name}":
                return build_hint("header", f"own {package.name}/{name} is meant")
            if package != target.package and inside == "include":
                return build_hint("header", f"{package.name} is no component")
            return build_hint("header", f"{name} is in folder {inside}")
    names = {_included_as(path, package): path.name for path, package in headers.items()}
    bases = {base: word for word, base in names.items()}
    near = meant(name, names, 0.75, "{}") or bases.get(meant(Path(name).name, bases, 0.75, "{}"))
    return build_hint("header", f"own {near} is meant") if near else ""


def _installed(submission: Submission, name: str, target: Target) -> str:
    """Return what to do about a header that exists, but not where the compiler looks."""
    if not any((folder / name).is_file() for folder in _folders(submission)):
        return ""
    if "catkin_INCLUDE_DIRS" not in target.cmake:
        return build_hint("header", "no include_directories")
    package = name.partition("/")[0]
    return build_hint("header", f"{'roscpp' if package == 'ros' else package} is no component")


def _absent(submission: Submission, name: str, _target: Target) -> str:
    """Return how to get the package of a header, unless it is installed."""
    package = name.partition("/")[0]
    is_here = any((folder / package).is_dir() for folder in _folders(submission))
    return "" if is_here else advice(package, packages_of_ros(package))


def _similar(submission: Submission, name: str, _target: Target) -> str:
    """Return the header that is meant by a name that no header has."""
    known = list(_known(submission))
    folded = {header.casefold(): header for header in known}
    near = folded.get(name.casefold()) or folded.get(f"{name}.h".casefold())
    if "/" not in name:
        bases = {Path(header).name.casefold(): header for header in known}
        near = near or bases.get(name.casefold())
    near = near or meant(name, known, 0.75, "{}")
    return build_hint("header", f"{near} is meant") if near else ""


def _headers(package: Package) -> Iterator[Path]:
    """Yield the header files of a package."""
    for path in sorted(package.folder.rglob("*")):
        if path.suffix in SUFFIXES and path.is_file():
            yield path


def _included_as(path: Path, package: Package) -> str:
    """Return the name by which #include finds a header of a package."""
    inside = path.relative_to(package.folder).as_posix()
    return inside.rpartition("include/")[2] if "include/" in inside else path.name


def _prefixes(submission: Submission) -> list[Path]:
    prefixes = submission.underlay_environment.get("CMAKE_PREFIX_PATH", "").split(":")
    return [Path(prefix) for prefix in prefixes if prefix]


def _folders(submission: Submission) -> list[Path]:
    return [*(prefix / "include" for prefix in _prefixes(submission)), SYSTEM]


def _known(submission: Submission) -> Iterator[str]:
    """Yield the headers of ROS that are installed here, and of the language."""
    for folder in _folders(submission):
        for pattern in OF_ROS:
            for path in sorted(folder.glob(f"{pattern}/*.h")):
                yield path.relative_to(folder).as_posix()
    yield from (path.name for path in sorted(SYSTEM.glob(OF_LANGUAGE)) if path.is_file())
