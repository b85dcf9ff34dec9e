"""The linker's first error: the line of CMakeLists.txt or of the source, and the usual cause."""

from __future__ import annotations

import re

from tutorial_check.checking.compiler_errors import plain
from tutorial_check.checking.compiler_places import text_of
from tutorial_check.checking.make_output import EXPECTED, Target, build_hint, failed_target
from tutorial_check.checking.results import Wrong
from tutorial_check.checking.submission import Submission
from tutorial_check.submission.launch_xml import place_of

# Bounded, because an unbounded search takes quadratic time.
ERROR = re.compile(
    r"undefined reference to [^\n]{1,2000}|cannot find -l[^\s:]{1,99}"
    r"|multiple definition of [^;\n]{1,260}"
)
SYMBOL = re.compile(r"undefined reference to .((?:\w+::)*)(~?\w+)\(")  # `Class::function(int)'
USER = re.compile(r"\.dir/(\S{1,200})\.o: in function")  # the source that needs it
BEFORE = 5000  # characters in which it is named
SOURCES = (".cpp", ".cc", ".cxx", ".c")
# {namespace: the package with its library}
LIBRARIES = {"ros": "roscpp", "tf": "tf", "tf2_ros": "tf2_ros", "actionlib": "actionlib"}


def of_linker(submission: Submission, output: str) -> Wrong | None:
    """Return the Wrong for the first error of the linker, if there is one."""
    error = ERROR.search(output)
    if not error:
        return None
    target = failed_target(submission, output, error.end())
    message = plain(error[0])
    empty = _empty_source(target) if message.endswith("main'") else ""
    if empty:
        return Wrong(EXPECTED, "the file is empty", empty, "was it saved?")
    where, hint = target.where, ""
    symbol = SYMBOL.match(message)
    library = LIBRARIES.get(symbol[1].partition("::")[0], "") if symbol else ""
    if library and _links(target) and target.lacks(library):
        hint = build_hint("header", f"{library} is no component")
    elif symbol and not library:
        users = USER.findall(output, max(0, error.start() - BEFORE), error.start())
        where, hint = _of_own(submission, target, symbol, users[-1] if users else "")
    others = target.line_with(f"target_link_libraries({target.name} ")
    if library and others and not _links(target):
        where, hint = others, build_hint("catkin_make", f"{target.name} links others")
    unlinked = f"{target.name} without libraries: " if library or not _links(target) else ""
    hint = hint or build_hint("catkin_make", f"{unlinked}{message}")
    return Wrong(EXPECTED, f"{target.name}: {message}"[:300], where or target.where, hint)


def _empty_source(target: Target) -> str:
    """Return the path within src of an empty file that is named like the target, or ""."""
    if not target.package:
        return ""
    folder = target.package.folder
    for path in sorted(folder.rglob(f"{target.name}.*")):
        if path.suffix in SOURCES and path.is_file() and not path.stat().st_size:
            return f"{target.package.inside}/{path.relative_to(folder)}"
    return ""


def _links(target: Target) -> bool:
    links = rf"(?i:target_link_libraries)\s*\(\s*{re.escape(target.name)}\s[^)]*catkin_LIBRARIES"
    return bool(re.search(links, target.cmake))


def _of_own(
    submission: Submission, target: Target, symbol: re.Match[str], user: str
) -> tuple[str, str]:
    """Return (where, hint) for a function of the student's own that is not linked; or ("", "")."""
    if not target.package:
        return "", ""
    folder, call = target.package.folder, f"{symbol[2]}("
    for path in sorted(folder.rglob("*")):
        source = path.relative_to(folder).as_posix()
        is_left_out = path.suffix in SOURCES and source not in target.cmake
        if is_left_out and path.is_file() and call in text_of(submission, path):
            return "", build_hint("catkin_make", f"{source} is left out of {target.name}")
    text = text_of(submission, folder / user) if symbol[1] and user else ""
    if call not in text:
        return "", ""
    where = place_of(f"{target.package.inside}/{user}", text, call)
    return where, build_hint("catkin_make", f"{symbol[1]}{symbol[2]} is only declared")
