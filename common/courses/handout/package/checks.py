"""C1 to C4 and C12: workspace and underlay, packages, dependencies, the build."""

from __future__ import annotations

import difflib
import os
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Sequence

from tutorial_check import (
    Note,
    Package,
    Submission,
    Wrong,
    build_error,
    build_output,
    check,
    cmake_of,
    first_of,
    is_lacking,
    is_stand_in,
    missing_in,
    must_be_unique,
    must_build,
    must_pass,
    not_found,
    packages_beside,
    packages_of_ros,
    place_of,
    read_xml,
    underlays,
    unreadable,
)

SUITE = ("node_kit", "fake_turtlebot_sim")  # packages of the underlay
COMPONENTS = r"find_package\s*\(\s*catkin\b[^)]*\bCOMPONENTS\b([^)]*)\)"
AGAIN = "in the workspace: rm -r build devel, then catkin_make"


@check("C1", "the workspace", "2.1", look="ls src devel", timeless=True, eager=True)
def workspace(submission: Submission) -> Note | str | None:
    layout = submission.layout
    if not layout.source.is_dir():
        seen = f"none in {layout.root}, and no package"
        hint = "is this your workspace? --in ~/ros/hydro/catkin_ws; a new one begins with src"
        raise Wrong("a folder src in the workspace", seen, hint=hint)
    _check_names(submission)
    if not layout.is_workspace:
        return Note("handed in as packages, without their workspace: built again here")
    devel = layout.root / "devel"
    real = Path(os.path.realpath(devel / "setup.sh"))
    if layout.root.resolve() not in real.parents and not submission.may_see(real):
        return Note("never built here (devel is a link that leads elsewhere)")
    made_for, below = underlays(devel)
    setup = devel / "setup.bash"
    if made_for and os.path.realpath(made_for) != os.path.realpath(devel):
        return Note(f"its devel folder was made elsewhere ({made_for}); built again here")
    if setup.is_file() and not (made_for and below is not None and setup.stat().st_size):
        gone = setup.name if made_for and below is not None else "_setup_util.py or setup.sh"
        seen = f"it is incomplete: {gone} is missing or empty"
        raise Wrong("a devel folder as catkin_make makes it", seen, "devel", AGAIN)
    if not made_for and any((layout.source / name).is_dir() for name in ("build", "devel")):
        hint = "catkin_make is called in the workspace: cd .., and remove src/build and src/devel"
        raise Wrong("build and devel beside src", "they are within src", hint=hint)
    if below is None:
        return Note("never built here (no devel/setup.bash)", hint="catkin_make in the workspace")
    if not any(devel.glob("setup.*")):  # git may omit these
        return Note("its devel folder has no setup.bash; built again here", hint=AGAIN)
    lower = [folder for folder in below if os.path.realpath(folder) != str(devel.resolve())]
    return _over(submission, lower)


def _over(submission: Submission, below: Sequence[str]) -> Note | str:
    """Return a verdict on the underlays of a workspace. Raises Wrong.

    A workspace over a ROS in /opt/ros is right there; here it is built again.
    """
    suite = os.path.realpath(Path(submission.order.underlay).parent)
    if suite in map(os.path.realpath, below):
        return "src and devel, on top of this suite"
    if below and all(folder.startswith("/opt/ros/") for folder in below):
        return Note(f"built over {', '.join(below)} alone; built again here, on top of this suite")
    seen = f"devel was built over {', '.join(below) or 'nothing'}"
    hint = "built in a terminal without ./tutorial shell:"
    hint += " delete build and devel, then catkin_make in it"
    for other in below[::-1]:  # the first is the most important
        is_suite = any(os.path.isdir(f"{other}/share/{name}") for name in SUITE)
        if is_suite or Path(other).parts[-2:] == ("lower", "devel"):  # it may be invisible here
            seen = f"devel was built over another copy of the suite, {other}; this one is {suite}"
            hint = f"{AGAIN} in the ./tutorial shell of this copy; or check with the ./tutorial"
            hint += " (and TUTORIAL_WORKSPACE) of the other"
    raise Wrong("a workspace built on top of this suite", seen, "devel", hint)


def _check_names(submission: Submission) -> None:
    """Raise Wrong for a package with a name that belongs to the suite or ROS."""
    share = Path(submission.order.underlay).parent / "share"
    for package in submission.packages:
        name, folder = package.name, package.folder
        is_suite = (share / name).is_dir() and not is_stand_in(name)
        is_ros = any(name in _wanted(submission, ours) for ours in submission.course.packages)
        # A clone of the real package was not made by catkin_create_pkg by mistake.
        is_clone = (folder / "msg").is_dir() or (folder / "src" / name).is_dir()
        if is_suite or (is_ros and not is_clone):
            seen = f"a package {name}: it hides {'the suite' if is_suite else 'ROS'}'s own"
            hint = "remove it from src. catkin_create_pkg's first argument is the name"
            hint += " of the new package, the others are what it depends on"
            raise Wrong("packages with names of their own", seen, f"src/{package.inside}", hint)


def _wanted(submission: Submission, name: str) -> list[str]:
    """Return the dependencies that a package of the exercises must have."""
    return submission.course.packages[name].split()


def _needed(submission: Submission, name: str) -> list[str]:
    """Return those dependencies; programs in C++ alone need roscpp in place of rospy."""
    wanted = _wanted(submission, name)
    if not submission.is_in_cpp(name):
        return wanted
    return list(dict.fromkeys("roscpp" if word == "rospy" else word for word in wanted))


def _package(submission: Submission, name: str) -> Package:
    """Return the package that the checks know by a name. Raises Wrong."""
    expected = f"one package {submission.task.in_messages(name)} in src"
    own = submission.task.name_of(name)
    named = [package for package in submission.packages if package.name == own]
    for package in submission.packages:
        if package.error and own in (package.name, package.folder.name):
            raise unreadable(package)
    must_be_unique(named)
    if not named:
        diagnoses = (package_beside_src, link_to_nowhere, similar_package)
        lost = LostPackage(submission, name, own, expected)
        raise first_of(diagnoses, lost) or no_package(lost)
    for outer in (p for p in submission.packages if p.folder in named[0].folder.parents):
        seen = f"it is within another package, {outer.inside}"
        hint = "move it up: packages are side by side in src"
        raise Wrong(expected, seen, named[0].inside, hint)
    return named[0]


@dataclass(frozen=True)
class LostPackage:
    """A package that is not in src."""

    submission: Submission
    name: str  # in the checks
    own: str  # that it should have
    expected: str


def package_beside_src(lost: LostPackage) -> Wrong | None:
    packages = packages_beside(lost.submission.layout)
    for beside in (package.inside for package in packages if package.name == lost.own):
        hint = f"mv {lost.submission.whole(beside)} {lost.submission.whole('src')}"
        return Wrong(lost.expected, f"it is beside src: {beside}", beside, hint)
    return None


def link_to_nowhere(lost: LostPackage) -> Wrong | None:
    link, inside = lost.submission.layout.source / lost.own, f"src/{lost.own}"
    if not link.is_symlink() or link.exists():
        return None
    seen = f"{inside} is a link to {os.readlink(link)}, and leads nowhere here"
    return Wrong(lost.expected, seen, inside, "put the folder itself into src, not a link")


def _plain(name: str) -> str:
    return re.sub(r"[^a-z0-9]", "", name.lower())


def similar_package(lost: LostPackage) -> Wrong | None:
    packages = lost.submission.packages
    words = ((word, p) for p in packages for word in (p.name, p.folder.name))
    named = {_plain(word): package for word, package in words}
    for near in difflib.get_close_matches(_plain(lost.own), named, 1, 0.8):
        seen, where = f"a package called {named[near].name}", f"{named[near].inside}/package.xml"
        hint = f"its name must be exactly {lost.own}: lower case, with _ and without -;"
        hint += " in package.xml, CMakeLists.txt and the folder"
        return Wrong(lost.expected, seen, where, hint)
    return None


def no_package(lost: LostPackage) -> Wrong:
    names = ", ".join(package.name for package in lost.submission.packages)
    hint = f"cd to src of your workspace; catkin_create_pkg {lost.own}"
    hint += f" {lost.submission.course.packages[lost.name]}."
    hint += " ./tutorial shell without --in has one of OURS"
    return Wrong(lost.expected, f"none; found: {names or 'no package at all'}", hint=hint)


def odd_name(package: Package) -> Wrong | None:
    for odd in sorted(package.depends):
        if not re.fullmatch(r"[a-z][a-z0-9_+-]*", odd, re.IGNORECASE):
            hint = "separate dependencies by spaces, not by commas:"
            hint += " fix package.xml and CMakeLists.txt"
            where = f"{package.inside}/package.xml"
            return Wrong("names of packages", f"a dependency on {odd!r}", where, hint)
    return None


def _missing(wanted: Sequence[str], package: Package, unknown: Sequence[str]) -> list[str]:
    """Return the missing dependencies, or one that is misspelt in another kind of dependency."""
    missing = [name for name in wanted if name not in package.depends]
    meant = (difflib.get_close_matches(name, wanted, 1, 0.8) for name in unknown)
    return missing or next(filter(None, meant), [])


def _dependencies(submission: Submission, name: str) -> Package:
    """Return a package with all its dependencies. Raises Wrong."""
    package = _package(submission, name)
    wanted = _needed(submission, name)
    must_pass([odd_name], package)
    others = sorted(package.depends - set(wanted))
    # The name of an existing package is not misspelt.
    unknown = [
        name
        for name in others
        if not (packages_of_ros(name) or is_lacking(name) or _is_known(submission, name))
    ]
    missing = _missing(wanted, package, unknown)
    if not missing:
        return package
    near = {name: difflib.get_close_matches(name, unknown, 1, 0.65) for name in missing}
    seen = f"no {', '.join(missing)}"
    if missing[0] in package.depends:
        seen = f"{near[missing[0]][0]}, which is no package"
    text, where = read_xml(package.folder / "package.xml"), f"{package.inside}/package.xml"
    place = place_of(where, text, "exec_depend>", "run_depend>", "depend>", "</package>")
    # Format 1 has no <depend>.
    kinds = ("build_depend", "run_depend") if package.format == 1 else ("depend",)
    hint = "add " + " and ".join(f"<{k}>{name}</{k}>" for name in missing for k in kinds)
    if "rospy" in missing and "roscpp" in others:
        seen, hint = f"{seen}, but roscpp", f"the exercise asks for Python, not for C++: {hint}"
    for right, (odd,) in ((right, words) for right, words in near.items() if words):
        seen += f" (but {odd})" if right not in package.depends else ""
        place = place_of(where, text, f">{odd}<", odd)
        hint = f"correct {odd} to {right}, in each line that has it"
    raise Wrong(f"dependencies on {', '.join(wanted)}", seen, place, hint)


@check("C2", "package beginner_tutorials", "2.1", look="rospack find beginner_tutorials",
       timeless=True)  # fmt: skip
def beginner(submission: Submission) -> Note | str | None:
    return f"src/{_package(submission, 'beginner_tutorials').inside}"


@check("C3", "its dependencies", "2.1", needs=beginner, look="rospack depends1 beginner_tutorials",
       timeless=True)  # fmt: skip
def beginner_dependencies(submission: Submission) -> None:
    _dependencies(submission, "beginner_tutorials")


@check("C12", "package {n.package} and its dependencies", "4.3", look="rospack find {n.package}",
       timeless=True)  # fmt: skip
def joy2twist(submission: Submission) -> Note | str | None:
    package = _dependencies(submission, "joy2twist")
    components = re.search(COMPONENTS, cmake_of(package))
    for name in components[1].split() if components else ():
        if not _is_known(submission, name) and name in missing_in(build_output(submission)):
            raise Wrong("packages that catkin can find", *not_found(submission, name))
    return f"src/{package.inside}"


def _is_known(submission: Submission, name: str) -> bool:
    """Return whether find_package certainly finds a package; if not, only a build can tell."""
    prefixes = submission.underlay_environment.get("CMAKE_PREFIX_PATH", "").split(":")
    if any(package.name == name for package in submission.packages):
        return True
    file = f"share/{name}/cmake/{name}Config.cmake"
    is_there = any(Path(prefix, file).is_file() for prefix in (*prefixes, "/usr"))
    # Debian's place for a package with a library, such as roscpp.
    return is_there or any(Path("/usr/lib").glob(f"*/cmake/{name}/{name}Config.cmake"))


@check("C4", "catkin_make builds", "2.1", needs=beginner, look="catkin_make")
def build(submission: Submission) -> Note | None:
    made = must_build(submission)
    listed = re.search(r"traversing \d+ packages?[^:]*:((?:\s*--\s+~~\s+- .*)+)", made.output)
    names = re.findall(r"- (\S+)", listed[1]) if listed else []
    if listed and "beginner_tutorials" not in names:
        seen = f"it goes through {', '.join(names)}"
        raise Wrong("catkin_make goes through beginner_tutorials", seen)
    if not made.unbuilt:
        return None
    wrong = build_error(submission, made.unbuilt)
    seen = f"it builds what the exercises need; another package fails: {wrong.seen}"
    hint = f"{wrong.hint}; or put an empty file CATKIN_IGNORE into that package"
    return Note(seen, wrong.where, hint)
