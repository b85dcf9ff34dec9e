"""What roslaunch says of a launch file, and the file's text: from both to a line and a hint."""

from __future__ import annotations

import difflib
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Callable, Sequence

from tutorial_check.model import Wrong
from tutorial_check.source.causes import explained
from tutorial_check.source.debian_packages import advice, packages_of_ros
from tutorial_check.source.launch_xml import not_xml, place_of, read, without_comments

# Those that a launch file of the exercises may name.
PACKAGES = (
    "rbx1_nav rbx1_bringup turtlebot_rviz_launchers turtlebot_bringup fake_turtlebot_sim joy2twist"
    " gamepad joy rosbag rviz"
)
# Kinds and words of errors, as roslaunch has them.
UNSET, UNUSED = "ArgException", r"unused args \[(\w+).*\] for include of \[(.*)\]"
NO_FILE = r"No such file or directory: '([^']+)'|file does not exist \[([^\]]*)\]"
# Names in two words. (That of a node may have them, says roslaunch; that is worth a note.)
GAPS = (
    r"\$\(find\s+(\w+(?:[ \t]+\w+)+)\s*\)",
    r"\b(?:pkg|type)\s*=\s*[\"'](\w+(?:[ \t]+[\w.]+)+)[\"']",
)


@dataclass(frozen=True)
class Fault:
    """What roslaunch said of a launch file, and the tag that it was reading then."""

    kind: str
    words: str
    tag: str
    places: Sequence[tuple[str, int]]  # (file, line) of each tag around it, the outermost first


def attribute(name: str, value: str) -> tuple[str, ...]:
    """Return how it may be written, for place_of."""
    return f'{name}="{value}"', f"{name}='{value}'", value


def package_hint(name: str) -> str:
    """Return what to do about a ROS package that is not there."""
    near = difflib.get_close_matches(name, PACKAGES.split(), 1, 0.8)
    if near:
        return f"there is no package {name}; is {near[0]} meant?"
    spelling = f"there is no package {name}: look at the spelling in $(find {name}) or pkg="
    return advice(name, packages_of_ros(name)) or spelling


def blamed(fault: Fault, is_own: Callable[[str], bool]) -> tuple[str, int]:
    """Return (file, line) of the innermost tag in a file of the student's.

    An arg without a value is the fault of the <include>, where the included file declares it.
    """
    own = [place for place in fault.places if is_own(place[0])]
    if fault.kind == UNSET:
        file = own[-1][0]
        declared = rf"<arg\b[^<>]*\bname\s*=\s*[\"']{re.escape(fault.words)}[\"']"
        if re.search(declared, read(Path(file))):
            own = [place for place in own if place[0] != file] or own
    return own[-1]


def parse_error(
    fault: Fault, where: str, line: int, text: str, may_see: Callable[[Path], bool]
) -> Wrong:
    """Return the Wrong for a file that roslaunch cannot read, at where:line; text: with comments."""
    expected, place = "a launch file that roslaunch can read", f"{where}:{line}"
    words = " ".join(fault.words.split())[:250]
    if fault.kind == "ExpatError":
        number, hint = not_xml(fault.words, text)
        return Wrong(expected, words, f"{where}:{number}" if number else where, hint)
    text = without_comments(text)
    open_find = re.search(r"\$\((?:find|arg)\b[^)\"'<>]*[\"'<>]", text)
    if open_find:
        place = place_of(where, text, open_find[0])
        hint = "each $( needs its ): $(find PACKAGE)/launch/FILE"
        return Wrong(expected, f"{open_find[0][:-1]} without )", place, hint)
    if fault.kind == "ResourceNotFound":
        return Wrong(expected, f"package not found: {words}", place, package_hint(words))
    file = re.search(NO_FILE, words)
    if file:
        path = Path(file[1] or file[2])
        hint = 'an include needs the whole path: file="$(find PACKAGE)/launch/FILE"'
        if path.is_absolute():
            files = path.parent.glob("*") if may_see(path.parent) else ()
            hint = _meant(path.name, [each.name for each in files], 0.7)
            hint = hint or "look at the name of the file, and of its folder"
        return Wrong(expected, f"no such file: {path}", place, hint)
    unused = re.search(UNUSED, words)
    if unused:
        path = Path(unused[2])
        text = read(path) if may_see(path) and path.is_file() else ""
        known = re.findall(r"<arg\b[^<>]*\bname\s*=\s*[\"']([^\"']+)[\"']", text)
        hint = _meant(unused[1], known, 0.6)
        hint = hint or f"leave it out; it has {', '.join(known) or 'none'}"
        return Wrong(expected, f"{path.name} has no arg {unused[1]}", place, hint)
    said = f"{fault.kind} <{fault.tag}>: {words.partition(' xml is ')[0]}"
    *seen, hint = explained("roslaunch", said)
    return Wrong(expected, (seen or [words])[0], place, hint)


def _meant(name: str, known: Sequence[str], likeness: float) -> str:
    near = difflib.get_close_matches(name, known, 1, likeness)
    return f"is {near[0]} meant?" if near else ""
