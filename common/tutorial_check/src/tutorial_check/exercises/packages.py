"""C2 to C4 and C12: the packages, their dependencies, the build."""

import difflib
import os
import re
from pathlib import Path

from tutorial_check.exercises import check
from tutorial_check.exercises.launch_text import place_of, read
from tutorial_check.exercises.manifests import unreadable
from tutorial_check.model import Wrong
from tutorial_check.place import own_rights
from tutorial_check.workspace import packages_beside

NAMES = ("beginner_tutorials", "joy2twist")
WANTED = {
    "beginner_tutorials": ("std_msgs", "rospy", "roscpp"),
    "joy2twist": ("rospy", "std_msgs", "sensor_msgs", "geometry_msgs"),
}
CREATE = {name: f"catkin_create_pkg {name} {' '.join(words)}" for name, words in WANTED.items()}

# What a message of CMake's most often means here: (pattern, what to do). The first that fits counts.
CMAKE_HINTS = (
    (r"does not match current PROJECT_NAME", "write the name that package.xml has into project()"),
    (r"non-existing file|Cannot find source file", "look at the spelling of the file's path"),
    (r"Unknown CMake command", "look at the spelling of the command"),
)


def _similar(name, packages):
    """A package that was meant to be the one of that name, or None."""
    plain = re.sub(r"[^a-z0-9]", "", name)
    for each in packages:
        for word in (each.name, each.folder.name):
            bare = re.sub(r"[^a-z0-9]", "", word.lower())
            if bare == plain or difflib.SequenceMatcher(None, bare, plain).ratio() > 0.8:
                return each
    return None


def _package(session, name):
    packages = session.packages
    named = [each for each in packages if each.name == name]
    expected = f"one package {name} in src"
    broken = [each for each in packages if each.error and name in (each.name, each.folder.name)]
    if broken:
        raise unreadable(broken[0])
    if len(named) > 1:
        raise Wrong(
            expected,
            f"{len(named)}: {', '.join(each.inside for each in named)}",
            where=named[1].inside,
            hint="remove the copy from src, or put an empty file CATKIN_IGNORE into it",
        )
    if named:
        outer = next(
            (
                each
                for each in packages
                if each is not named[0] and each.folder in named[0].folder.parents
            ),
            None,
        )
        if outer:
            raise Wrong(
                expected,
                f"it lies within another package, {outer.inside}",
                where=named[0].inside,
                hint="move it up: packages stand side by side in src",
            )
        return named[0]
    beside = [each for each in packages_beside(session.layout) if each.name == name]
    if beside:
        raise Wrong(
            expected,
            f"it lies beside src: {beside[0].inside}",
            where=beside[0].inside,
            hint=f"mv {session.whole(beside[0].inside)} {session.whole('src')}",
        )
    link = session.layout.source / name
    with own_rights():
        leads_to = os.readlink(link) if link.is_symlink() and not link.exists() else ""
    if leads_to:
        raise Wrong(
            expected,
            f"src/{name} is a link to {leads_to}, and leads nowhere here",
            where=f"src/{name}",
            hint="put the folder itself into src in place of the link",
        )
    similar = _similar(name, packages)
    if similar:
        raise Wrong(
            expected,
            f"a package called {similar.name}",
            where=f"{similar.inside}/package.xml",
            hint=f"its name must be exactly {name}: lower case, with _ and without -; in package.xml, CMakeLists.txt"
            " and the folder",
        )
    raise Wrong(
        expected,
        "none; found: " + (", ".join(each.name for each in packages) or "no package at all"),
        hint=f"cd to src of your workspace; {CREATE[name]}. ./tutorial shell without --in has one of OURS",
    )


def _dependencies(session, name):
    package = _package(session, name)
    odd = sorted(
        each
        for each in package.depends
        if not re.fullmatch(r"[a-z][a-z0-9_+-]*", each, re.IGNORECASE)
    )
    if odd:
        raise Wrong(
            "names of packages",
            f"a dependency on {odd[0]!r}",
            where=f"{package.inside}/package.xml",
            hint="between the dependencies stand spaces only, no commas: mend package.xml and CMakeLists.txt",
        )
    missing = [each for each in WANTED[name] if each not in package.depends]
    others = package.depends - set(WANTED[name])
    # One kind of dependency may name it rightly.
    for each in sorted(others):
        meant = difflib.get_close_matches(each, WANTED[name], 1, 0.8)
        if not missing and meant and not _is_known(session, each):
            missing = meant
    if missing:
        near = {each: difflib.get_close_matches(each, others, 1, 0.65) for each in missing}
        seen, where = f"no {', '.join(missing)}", f"{package.inside}/package.xml"
        if missing[0] in package.depends:
            seen = f"{near[missing[0]][0]}, which is no package"
        text = read(package.folder / "package.xml")
        place = place_of(where, text, "exec_depend>", "run_depend>", "depend>", "</package>")
        hint = "add " + " and ".join(f"<depend>{each}</depend>" for each in missing)
        for each, found in near.items():
            if found:
                seen += f" (but {found[0]})" if each not in package.depends else ""
                place = place_of(where, text, f">{found[0]}<", found[0])
                hint = f"correct {found[0]} to {each}, in each line that has it"
        raise Wrong(f"dependencies on {', '.join(WANTED[name])}", seen, where=place, hint=hint)
    return package


@check(
    "C2", "package beginner_tutorials", "2.1", look="rospack find beginner_tutorials", timeless=True
)
def beginner(session):
    """Package beginner_tutorials."""
    return f"src/{_package(session, 'beginner_tutorials').inside}"


@check(
    "C3", "its dependencies", "2.1", "C2", look="rospack depends1 beginner_tutorials", timeless=True
)
def beginner_dependencies(session):
    """Its dependencies."""
    _dependencies(session, "beginner_tutorials")


@check(
    "C12",
    "package joy2twist and its dependencies",
    "4.3",
    look="rospack find joy2twist",
    timeless=True,
)
def joy2twist(session):
    """Package joy2twist and its dependencies."""
    package = _dependencies(session, "joy2twist")
    text = _cmake(package)
    found = re.search(r"find_package\s*\(\s*catkin\b[^)]*\bCOMPONENTS\b([^)]*)\)", text)
    for name in found[1].split() if found else ():
        if not _is_known(session, name) and name in _missing_in(session.built()[1]):
            raise Wrong("packages that catkin can find", *_not_found(session, name))
    return f"src/{package.inside}"


def _is_known(session, name):
    """Whether find_package surely finds a package. If not, a build tells, which takes its time."""
    prefixes = session.floor_environment.get("CMAKE_PREFIX_PATH", "").split(":")
    if any(each.name == name for each in session.packages):
        return True
    with own_rights():
        return any(
            Path(prefix, "share", name, "cmake", f"{name}Config.cmake").is_file()
            for prefix in (*prefixes, "/usr")
        )


def _cmake(package):
    """The text of a package's CMakeLists.txt without comments. Raises Wrong."""
    path = package.folder / "CMakeLists.txt"
    if not path.is_file():
        raise Wrong(
            "a package as catkin_create_pkg makes it",
            "the file CMakeLists.txt is missing",
            where=package.inside,
            hint="take it from a new package of the same name",
        )
    return re.sub(r"#.*", "", path.read_text(errors="replace"))


@check("C4", "catkin_make builds", "2.1", "C2", look="catkin_make")
def build(session):
    """Catkin_make in a fresh copy."""
    for each in session.packages:
        _cmake(each)
    code, output = session.built()
    if code is None:
        raise Wrong(
            "catkin_make ends",
            "it runs for more than two minutes",
            hint="catkin_make in your workspace",
        )
    if code != 0:
        raise _build_error(session, output)
    listed = re.search(r"traversing \d+ packages?[^:]*:((?:\s*--\s+~~\s+- .*)+)", output)
    names = re.findall(r"- (\S+)", listed[1]) if listed else []
    if listed and "beginner_tutorials" not in names:
        raise Wrong(
            "catkin_make goes through beginner_tutorials", f"it goes through {', '.join(names)}"
        )


def _build_error(session, output):
    output = re.sub(r"\x1b\[[0-9;]*m", "", output)
    lines = [line.strip() for line in output.splitlines()]
    words = next(
        (
            line
            for line in lines
            if re.search(
                r"Error at|^E: |mismatched tag|error:|Could not find|Multiple packages", line
            )
        ),
        lines[-1] if lines else "",
    )
    missing = _missing_in(output)
    message, where = _cmake_error(output)
    if words.startswith("CMake Error") and message:
        words = f"CMake: {message}"
    hint = next(
        (what for pattern, what in CMAKE_HINTS if re.search(pattern, message)),
        "read the first error of catkin_make: it names file and line",
    )
    if missing:
        words, place, hint = _not_found(session, missing[0])
        where = place or where
    return Wrong("catkin_make without an error", words[:300], where=where, hint=hint)


def _missing_in(output):
    """The packages that catkin_make said it could not find."""
    return re.findall(
        r"[Cc]ould not find .*?(?:package configuration file provided by |component )?\"([^\"]+)\"",
        output,
    )


def _not_found(session, name):
    """(what is seen, where, what to do) for a package that CMakeLists.txt names and catkin does not find."""
    place, text = _place_in_cmake(session, name)
    absent = {each for names in WANTED.values() for each in names if each not in text}
    near = difflib.get_close_matches(name, absent, 1, 0.65)
    hint = f"is {name} spelt right in find_package of CMakeLists.txt, and without a comma?"
    if near and "," not in name:
        hint = f"correct {name} to {near[0]} in CMakeLists.txt"
    return f"catkin cannot find {name}", place, hint


def _cmake_error(output):
    """(message, FILE:LINE of the student's) of CMake's first error, each perhaps empty.

    Where the error is met, it is often in a file of catkin's; the call stack tells who called that.
    """
    found = re.search(r"^CMake Error(?: at [^\n]*)?:\s(.*?)(?:\n\n\n|\Z)", output, re.M | re.S)
    if not found:
        return "", ""
    place = re.search(r"(?<!\S)[^/\s]\S*/CMakeLists\.txt:\d+", found[0])
    return " ".join(found[1].split("Call Stack")[0].split()), place[0] if place else ""


def _place_in_cmake(session, word):
    """(first line with a word in a CMakeLists.txt of the student's, its text); or empty."""
    for each in session.packages:
        name = f"{each.inside}/CMakeLists.txt"
        file = each.folder / "CMakeLists.txt"
        text = file.read_text(errors="replace") if file.is_file() else ""
        place = place_of(name, re.sub(r"#.*", "", text), word)
        if place != name:
            return place, text
    return "", ""
