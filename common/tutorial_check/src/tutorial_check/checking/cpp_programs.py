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
    of a source of that name, and that before one whose name begins with it, or has it as a part,
    in any case; last comes the only program of the package.
    """
    must_build(submission)
    stem, programs = name.rpartition(".py")[0] or name, submission.cpp_programs(package)
    names = {path: _executable(submission, package, path).name for path in programs}
    unused = _near(stem, _unused_sources(submission, package))

    def rank(path: str) -> tuple[int, bool]:
        called = names[path].lower()
        is_built = _executable(submission, package, path).is_built
        # new_joy2twist is another program, not a joy2twist.
        is_other = called.startswith("new_")
        contains = stem in called and not is_other
        is_alone = len(names) == 1 and not is_other and not unused
        made_of = Path(path).stem == stem
        ways = (names[path] == stem, made_of, called.startswith(stem), contains, is_alone)
        place = next((place for place, is_so in enumerate(ways) if is_so), len(ways))
        return place, not is_built

    best = min(programs, key=rank, default="")
    if best and rank(best)[0] < 5:
        return best
    raise _no_target(submission, package, stem, names, unused)


def _executable(submission: Submission, package: str, path: str) -> Executable:
    executable = submission.executable_of(package, path)
    assert executable, path
    return executable


def _near(stem: str, sources: list[Path]) -> Path | None:
    """Return the source whose name is most like a program's, or None."""
    by_stem = {source.stem: source for source in sources}
    near = difflib.get_close_matches(stem, by_stem, 1, 0.7)
    return by_stem[near[0]] if near else None


def _no_target(
    submission: Submission, package: str, stem: str, names: dict[str, str], unused: Path | None
) -> Wrong:
    """Return the Wrong for a program that no add_executable makes. unused: its source, perhaps."""
    inside = submission.package(package)
    where = f"{inside.inside}/CMakeLists.txt"
    expected = f"a program {stem} in the package {submission.task.in_messages(package)}"
    place = place_of(where, inside.cmake or "", "add_executable", "catkin_package", "project")
    if unused:
        seen = f"{unused} is in no add_executable of CMakeLists.txt"
        return Wrong(expected, seen, place, f"below catkin_package() write {_lines(stem, unused)}")
    if not names:
        hint = f"write src/{stem}.cpp, and in CMakeLists.txt {_lines(stem, f'src/{stem}.cpp')}"
        return Wrong(expected, "none", place, hint)
    seen = f"the programs are called {', '.join(names.values())}"
    others = {path: name for path, name in names.items() if not name.startswith("new_")}
    lower = {path: name.lower() for path, name in others.items()}
    alike = difflib.get_close_matches(stem, lower.values(), 1, 0.7)
    own = next((path for path in lower if lower[path] in alike), f"src/{stem}.cpp")
    return Wrong(expected, seen, place, f"the name is the first word in {_lines(stem, own)}")


def _unused_sources(submission: Submission, package: str) -> list[Path]:
    """Return the C++ files, within a package, that no program is made of."""
    folder = submission.package(package).folder
    used = {source for made in submission.executables for source in made.sources}
    sources = submission.cpp_sources(package)
    unused = (path for path in sources if str(path.relative_to(submission.source)) not in used)
    return [path.relative_to(folder) for path in unused]


def _lines(stem: str, source: object) -> str:
    return f"add_executable({stem} {source}) and {LINKED.format(stem)}"


def must_be_built(submission: Submission, package: str, path: str) -> None:
    """Raise Wrong unless rosrun finds a program in C++. path: of its main source."""
    executable = _executable(submission, package, path)
    if not executable.is_built:
        must_build(submission)
        seen = f"catkin_make has made no {executable.name}"
        raise Wrong(f"a program {executable.name}", seen, path, "catkin_make in your workspace")
    inside = submission.package(package)
    places = (f"devel/lib/{inside.name}/", f"src/{inside.inside}/")  # where rosrun looks
    if not executable.path.startswith(places):
        words = (f"add_executable({executable.name}", "add_executable")
        where = place_of(f"{inside.inside}/CMakeLists.txt", inside.cmake or "", *words)
        seen = f"it is made as {executable.path}"
        hint = "catkin_package() belongs above add_executable: it says where programs go"
        raise Wrong(f"{executable.name} where rosrun finds it", seen, where, hint)
