"""A student's program in C++: the target of CMake that it is, and whether it is there."""

from __future__ import annotations

import difflib
from pathlib import Path

from tutorial_check.checking.builds import must_build
from tutorial_check.checking.results import Wrong
from tutorial_check.checking.submission import Submission
from tutorial_check.data.recordings import Executable
from tutorial_check.submission.launch_xml import place_of

LINKED = "target_link_libraries({} ${{catkin_LIBRARIES}})"


def find_compiled(submission: Submission, package: str, name: str) -> str:
    """Return the main source of a program, within its package. Raises Wrong.

    name: talker.py for a program talker. An executable of that name comes before one that is made
    of a source of that name, and that before one whose name has it as a part.
    """
    must_build(submission)
    stem, programs = name.rpartition(".py")[0] or name, submission.cpp_programs(package)
    names = {path: _executable(submission, package, path).name for path in programs}

    def rank(path: str) -> int:
        ways = (names[path] == stem, Path(path).stem == stem, stem in names[path])
        return next((place for place, is_so in enumerate(ways) if is_so), len(ways))

    best = min(programs, key=rank, default="")
    if best and rank(best) < 3:
        return best
    raise _no_target(submission, package, stem, names)


def _executable(submission: Submission, package: str, path: str) -> Executable:
    executable = submission.executable_of(package, path)
    assert executable, path
    return executable


def _no_target(submission: Submission, package: str, stem: str, names: dict[str, str]) -> Wrong:
    """Return the Wrong for a program that no add_executable makes."""
    inside = submission.package(package)
    where = f"{inside.inside}/CMakeLists.txt"
    expected = f"a program {stem} in the package {submission.task.in_messages(package)}"
    sources = [path.relative_to(inside.folder) for path in submission.cpp_sources(package)]
    stems = [path.stem for path in sources]
    place = place_of(where, inside.cmake or "", "add_executable", "catkin_package", "project")
    near = difflib.get_close_matches(stem, stems, 1, 0.7)
    if not near:
        seen = f"the programs are called {', '.join(names.values())}" if names else "none"
        hint = f"write src/{stem}.cpp, and in CMakeLists.txt"
        return Wrong(expected, seen, place, f"{hint} {_lines(stem, f'src/{stem}.cpp')}")
    source = sources[stems.index(near[0])]
    seen = f"{source} is in no add_executable of CMakeLists.txt"
    return Wrong(expected, seen, place, f"below catkin_package() write {_lines(stem, source)}")


def _lines(stem: str, source: object) -> str:
    return f"add_executable({stem} {source}) and {LINKED.format(stem)}"


def must_be_built(submission: Submission, package: str, path: str) -> None:
    """Raise Wrong unless rosrun finds a program in C++. path: of its main source."""
    executable = _executable(submission, package, path)
    if not executable.is_built:
        must_build(submission)
        seen = f"catkin_make has made no {executable.name}"
        raise Wrong(f"a program {executable.name}", seen, path, "catkin_make in your workspace")
    name = submission.package(package).name
    if not executable.path.startswith(f"devel/lib/{name}/"):
        inside = submission.package(package)
        words = (f"add_executable({executable.name}", "add_executable")
        where = place_of(f"{inside.inside}/CMakeLists.txt", inside.cmake or "", *words)
        seen = f"it is made as {executable.path}"
        hint = "catkin_package() belongs above add_executable: it says where programs go"
        raise Wrong(f"{executable.name} where rosrun finds it", seen, where, hint)
