"""The student's program that a check is about, in Python or C++, and its recording."""

from __future__ import annotations

import difflib
from pathlib import Path
from typing import Callable, TypeVar

from tutorial_check.checking.cpp_programs import find_compiled
from tutorial_check.checking.package_files import Script
from tutorial_check.checking.packages import package_of
from tutorial_check.checking.results import Wrong
from tutorial_check.checking.script_faults import check_file
from tutorial_check.checking.submission import Submission
from tutorial_check.course.definition import CPP, PYTHON

Recording = TypeVar("Recording")


def find_script(submission: Submission, package: str, name: str) -> str:
    """Return the path of a program within its package; in C++, of its main source. Raises Wrong.

    name: with .py, as it would be in Python.
    """
    folder = submission.package(package).folder
    if submission.language == CPP:
        return find_compiled(submission, package, name)
    files = sorted(path for path in folder.rglob("*") if path.is_file())
    paths = must_be_one_program(folder, name)
    # A name without .py counts if no file has one with it.
    scripts = [path for path in files if not _is_compiled(path)]
    paths += [path for word in (name, name[:-3]) for path in scripts if path.name == word]
    if paths:
        return str(paths[0].relative_to(folder))
    sources = submission.cpp_sources(package)
    if sources and submission.language != PYTHON:
        return find_compiled(submission, package, name)
    _must_have_its_name(submission, package, name, files)
    for path in sorted(sources, key=lambda path: path.stem != name[:-3]):
        seen, where = f"a program in C++, {path.name}", str(path.relative_to(folder))
        hint = f"the exercise asks for Python, rospy: write scripts/{name}; the C++ may stay"
        raise Wrong(f"a program {name}", seen, where, hint)
    expected = f"a program {name} in the package {submission.task.in_messages(package)}"
    hint = f"create scripts/{name} in YOUR package; ./tutorial shell without --in has one of OURS"
    look = f"ls {submission.whole('scripts', package)}"
    raise Wrong(expected, "no such file anywhere in it", "", hint, look=look)


def _is_compiled(path: Path) -> bool:
    """Return whether a file is a program that was built, and handed in with its source."""
    with path.open("rb") as file:
        return file.read(4) == b"\x7fELF"


def _must_have_its_name(submission: Submission, package: str, name: str, files: list[Path]) -> None:
    """Raise Wrong for a file whose name is similar to the program's."""
    others = {path.name: path for path in files if path.name != "CMakeLists.txt"}
    near = [other for other in others if other.lower().startswith(name)]
    # new_joy2twist.py is another program, not a misspelt joy2twist.py.
    texts = [other for other in others if Path(other).suffix.lower() in ("", ".py", ".txt")]
    words = [other for other in texts if name not in other]
    for similar in [*near, *difflib.get_close_matches(name, words, 1, 0.75)]:
        other = others[similar]
        paths = (submission.whole(path, package) for path in (other, other.with_name(name)))
        hint = f"mv {' '.join(paths)}: capitals, underscores and the extension matter"
        where = str(other.relative_to(submission.package(package).folder))
        raise Wrong(f"a program {name}", f"a file {similar}", where, hint)


def program_of(submission: Submission, package: str, name: str) -> str:
    """Return the path, within its package, of a program that can be run. Raises Wrong."""
    package_of(submission, package)
    script = find_script(submission, package, name)
    check_file(submission, package, script)
    return script


def must_be_one_program(folder: Path, name: str) -> list[Path]:
    """Return the programs of that name that rosrun finds. Raises Wrong for more than one."""
    files = sorted(path for path in folder.rglob(name) if path.is_file())
    runnable = [path for path in files if path.stat().st_mode & 0o100]
    if len(runnable) > 1:
        inside = [str(path.relative_to(folder)) for path in runnable]
        hint = "rosrun asks which one ('You have chosen a non-unique executable'):"
        hint += f" remove all but one {name}"
        raise Wrong(f"one program {name}", f"several: {', '.join(inside)}", inside[1], hint)
    return runnable


def recorded(
    submission: Submission,
    package: str,
    name: str,
    recorder: Callable[..., Recording],
    *about: object,
) -> tuple[Script, Recording]:
    """Return a program, and what recorder(workspace, path, ...) returns for it. Raises Wrong."""
    script = Script(submission, package, program_of(submission, package, name))
    return script, submission.recording(recorder, script.where, *about)
