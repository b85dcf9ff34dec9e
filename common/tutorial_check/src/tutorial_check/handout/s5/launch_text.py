"""What roslaunch says of a launch file, and the file's text: from both to a line and a hint."""

from __future__ import annotations

import difflib
import os
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Callable, Sequence

from tutorial_check.model import Wrong
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
# (what roslaunch says, what is seen, what to do); without the second its own words. The first that fits counts.
SAID = (
    (f"{UNSET} .*?: (.*)", "the arg {0} has no value",
     'give it a value: <arg name="{0}" default="..."/>, or value="..." in the <include>'),
    ("^KeyError <include>", "an <include> without file=",
     'an include has file="$(find PACKAGE)/launch/FILE"'),
    ("<node>: .*missing required", "", "a node has pkg=, type= and name="),
    ("<remap>: .*missing required", "",
     '<remap from="name in the program" to="name on the robot"/>'),
    ("missing required", "", "look at the names of its attributes"),
    (r"environment variable b?'(\w+)' is not set", "",
     "export {0}=... in the terminal of roslaunch; or $(optenv {0} VALUE), which has a default"),
    ("node name cannot contain a namespace", 'a "/" in the name= of a node',
     "the part before the / belongs into ns=, as in ns=\"robot1\" name=\"talker\""),
    (r"multiple nodes named \[(.*?)\]", "several nodes named {0}",
     "each node has a name of its own, those of included files as well"),
    (r"\[(?= |[^\]]* \]) *([^\]]*?) *\] is not a valid ROS name", "",
     'a blank stands between the quotes: "{0}"'),
    ("is not a valid ROS name", "", "a name has letters, digits, _ and / only"),
    (r"Unknown substitution command \[rospack ([^\]]*)\]", "",
     "in a launch file it is $({0}), without rospack"),
    (r"Unknown substitution command \[(\S+)", "",
     "there is no $({0} ...): look at its spelling, as in $(find PACKAGE)"),
    (r"\$\(arg", "", 'each $(arg x) needs an <arg name="x" default="..."/>'),
    ("no root <launch> tag", "", "roslaunch knows <launch> alone around all, in lower case"),
    ("", "", "roslaunch --nodes FILE shows the same"),
)  # fmt: skip


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


def space_hint(text: str) -> tuple[str, str]:
    """Return (what has a space that should be an underscore, what to do); empty if there is none."""
    for pattern in GAPS:
        found = re.search(pattern, text)
        if found:
            whole = found[0].replace(found[1], "_".join(found[1].split()))
            return found[0], f"a name has no space, the PDF shows _ as a gap: {whole}"
    return "", ""


def package_hint(name: str) -> str:
    """Return what to do about a ROS package that is not there."""
    near = difflib.get_close_matches(name, PACKAGES.split(), 1, 0.8)
    if near:
        return f"there is no package {name}; is {near[0]} meant?"
    spelling = f"there is no package {name}: look at the spelling in $(find {name}) or pkg="
    return advice(name, packages_of_ros(name)) or spelling


def blamed(fault: Fault, is_own: Callable[[str], bool]) -> tuple[str, int]:
    """Return (file, line) of the innermost tag in a file of the student's, which is at fault.

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
    """Return the Wrong for a file that roslaunch cannot read.

    where, line: to blame. text: with its comments. may_see(path): whether to look at what it names.
    """
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
        return _no_file(expected, file[1] or file[2], place, may_see)
    unused = re.search(UNUSED, words)
    if unused:
        included = Path(unused[2])
        seen, hint = _unused(unused[1], included, may_see(included))
        return Wrong(expected, seen, place, hint)
    said = f"{fault.kind} <{fault.tag}>: {words.partition(' xml is ')[0]}"
    for pattern, seen, hint in SAID:
        found = re.search(pattern, said)
        if found:
            shown = seen.format(*found.groups()) or words
            return Wrong(expected, shown, place, hint.format(*found.groups()))
    raise AssertionError(words)


def _unused(name: str, file: Path, is_seen: bool) -> tuple[str, str]:
    """Return (what is seen, what to do) for an arg that an included file does not have."""
    text = read(file) if is_seen and file.is_file() else ""
    known = re.findall(r"<arg\b[^<>]*\bname\s*=\s*[\"']([^\"']+)[\"']", text)
    near = difflib.get_close_matches(name, known, 1, 0.6)
    hint = f"is {near[0]} meant?" if near else f"leave it out; it has {', '.join(known) or 'none'}"
    return f"{file.name} has no arg {name}", hint


def _no_file(expected: str, name: str, place: str, may_see: Callable[[Path], bool]) -> Wrong:
    path, hint = Path(name), 'an include needs the whole path: file="$(find PACKAGE)/launch/FILE"'
    if path.is_absolute():
        is_seen = may_see(path.parent) and os.path.isdir(path.parent)
        files = path.parent.glob("*") if is_seen else ()
        near = difflib.get_close_matches(path.name, [each.name for each in files], 1, 0.7)
        hint = f"is {near[0]} meant?" if near else "look at the name of the file, and of its folder"
    return Wrong(expected, f"no such file: {path}", place, hint)
