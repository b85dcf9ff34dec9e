"""The text of a launch file, and what roslaunch says of it: from both to a line and a hint."""

from __future__ import annotations

import difflib
import os
import re
from pathlib import Path
from typing import Any

from tutorial_check.launch_xml import NOT_XML, line_of, not_xml, place_of, without_comments
from tutorial_check.model import Wrong

# Those that a launch file of the exercises may name.
PACKAGES = (
    "rbx1_nav",
    "rbx1_bringup",
    "turtlebot_rviz_launchers",
    "turtlebot_bringup",
    "fake_turtlebot_sim",
    "joy2twist",
    "gamepad",
    "joy",
    "rosbag",
    "rviz",
)
NO_FILE = r"No such file or directory: '([^']+)'|\[([^\]]+)\] (?:does not exist|cannot be)"
NO_PACKAGE = r"Resource not found: (\S+)|package \[?'?([\w-]+)|(\S+) ROS path \[0\]="
# Names in two words. (That of a node may have them, says roslaunch; that is worth a note.)
GAPS = (
    r"\$\(find\s+(\w+(?:[ \t]+\w+)+)\s*\)",
    r"\b(?:pkg|type)\s*=\s*[\"'](\w+(?:[ \t]+[\w.]+)+)[\"']",
)
# What roslaunch wants in a tag.
ATTRIBUTES = {
    "node": "a node has pkg=, type= and name=",
    "include": 'an include has file="$(find PACKAGE)/launch/FILE"',
    "remap": '<remap from="name in the program" to="name on the robot"/>',
}
# Other errors: (what roslaunch says, words of the line to blame, what to do). The first that fits counts.
SAID = (
    (r"requires the '(\w+)' arg", ('name="{0}"', "$(arg {0})", "<include"),
     'give it a value: <arg name="{0}" default="..."/>, or value="..." in the <include>'),
    (r"\[(?= |[^\]]* \])( *([^\]]*?) *)\] is not a valid ROS name", ('"{0}"', "'{0}'", "{0}"),
     'a blank stands between the quotes: "{1}"'),
    (r"\[([^\]]*)\] is not a valid ROS name", ('"{0}"', "'{0}'", "{0}"),
     "a name has letters, digits, _ and / only"),
    (r"Unknown substitution command \[rospack ([^\]]*)\]", ("$(rospack",),
     "in a launch file it is $({0}), without rospack"),
    (r"Unknown substitution command \[(\S+)", ("$({0}",),
     "there is no $({0} ...): look at its spelling, as in $(find PACKAGE)"),
    (r"\$\(arg", ("$(arg",), 'each $(arg x) needs an <arg name="x" default="..."/>'),
    ("", (), "roslaunch --nodes FILE shows the same"),
)  # fmt: skip


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


def parse_error(error: str, where: str, text: str) -> Wrong:
    """Return the Wrong for a file that roslaunch cannot read. text: with its comments."""
    expected = "a launch file that roslaunch can read"
    if re.search(NOT_XML, error):
        line, hint = not_xml(error, text)
        return Wrong(expected, error[:250], f"{where}:{line}" if line else where, hint)
    text = without_comments(text)
    gap, hint = space_hint(text)
    open_find = re.search(r"\$\((?:find|arg)\b[^)\"'<>]*[\"'<>]", text)
    if gap:
        return Wrong(expected, gap, place_of(where, text, gap), hint)
    if open_find:
        place = place_of(where, text, open_find[0])
        hint = "each $( needs its ): $(find PACKAGE)/launch/FILE"
        return Wrong(expected, f"{open_find[0][:-1]} without )", place, hint)
    file = re.search(NO_FILE, error)
    if file:
        return _no_file(expected, file[1] or file[2], where, text)
    missing = re.search(NO_PACKAGE, error)
    if missing:
        name = next(each for each in missing.groups() if each).rstrip(":.")
        near = difflib.get_close_matches(name, PACKAGES, 1, 0.8)
        hint = f"there is no package {name}: look at the spelling in $(find {name}) or pkg="
        hint += f"; is {near[0]} meant?" if near else ""
        return Wrong(expected, f"package not found: {name}", place_of(where, text, name), hint)
    return Wrong(expected, error[:250], *_place_and_hint(error, where, text))


def _place_and_hint(error: str, where: str, text: str) -> tuple[str, str]:
    """Return (where, what to do) for what names neither file nor package."""
    twice = re.search(r"multiple nodes named \[(?:.*/)?([^/\]]+)\]", error)
    if twice:
        named = rf"<node\b[^<>]*\bname\s*=\s*[\"']{re.escape(twice[1])}[\"']"
        ends = [each.end() for each in re.finditer(named, text)]
        place = f"{where}:{line_of(text, ends[:2][-1])}" if ends else where
        return place, "each node has a name of its own, those of included files as well"
    about = error.partition(" xml is ")[0]  # without the tag itself, in which any word may stand
    lacks = re.search(r"<(\w+)> tag is missing", about)
    tag = "include" if error == "'file'" else lacks[1] if lacks else ""
    if tag:
        names = re.findall(r"'(\w+)'|(\w+)/(\w+) attr", about)
        place = _tag_without(where, text, tag, names)
        return place, ATTRIBUTES.get(tag, "look at the names of its attributes")
    for pattern, words, hint in SAID:
        found = re.search(pattern, about)
        if found:
            parts = found.groups()
            return place_of(where, text, *(each.format(*parts) for each in words)), hint.format(
                *parts
            )
    return where, ""


def _tag_without(where: str, text: str, tag: str, attributes: Any) -> str:
    """Return FILE:LINE of the first such tag that lacks an attribute. attributes: as re.findall has them."""
    names = [name for found in attributes for name in found if name]
    for found in re.finditer(rf"<{tag}\b[^<>]*", text):
        if not all(re.search(rf"\b{name}\s*=", found[0]) for name in names):
            return f"{where}:{line_of(text, found.start())}"
    return place_of(where, text, f"<{tag}")


def _no_file(expected: str, name: str, where: str, text: str) -> Wrong:
    path = Path(name)
    seen, place = f"no such file: {path}", place_of(where, text, path.name)
    if not path.is_absolute():
        hint = 'an include needs the whole path: file="$(find PACKAGE)/launch/FILE"'
        return Wrong(expected, seen, place, hint)
    beside = [each.name for each in path.parent.glob("*")] if os.path.isdir(path.parent) else []
    near = difflib.get_close_matches(path.name, beside, 1, 0.7)
    hint = f"is {near[0]} meant?" if near else "look at the name of the file, and of its folder"
    return Wrong(expected, seen, place, hint)
