"""The text of a launch file, and what roslaunch says of it: from both to a line and a hint."""

import difflib
import os
import re
from pathlib import Path

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
NOT_XML = r"mismatched tag|no element found|not well-formed|junk after|unclosed token"
NO_FILE = r"No such file or directory: '([^']+)'|\[([^\]]+)\] (?:does not exist|cannot be)"
NO_PACKAGE = r"Resource not found: (\S+)|package \[?'?([\w-]+)|(\S+) ROS path \[0\]="
# Names in two words. (That of a node may have them, says roslaunch; that is worth a note.)
GAPS = (
    r"\$\(find\s+(\w+(?:[ \t]+\w+)+)\s*\)",
    r"\b(?:pkg|type)\s*=\s*[\"'](\w+(?:[ \t]+[\w.]+)+)[\"']",
)
CURLY = re.compile("[“”‘’]")


def without_comments(text):
    """The text with blanks in place of comments: its lines keep their numbers."""
    return re.sub(r"<!--.*?-->", lambda found: re.sub(r"[^\n]", " ", found[0]), text, flags=re.S)


def read(path):
    """The text of a launch file, without its comments."""
    return without_comments(path.read_text(errors="replace"))


def place_of(where, text, *words):
    """FILE:LINE of the first line with the first of the words that is there; else the file."""
    for word in words:
        for number, line in enumerate(text.splitlines(), 1):
            if word and word in line:
                return f"{where}:{number}"
    return where


def attribute(name, value):
    """How it may be written, for place_of."""
    return f'{name}="{value}"', f"{name}='{value}'", value


def space_hint(text):
    """(what has a space that should be an underscore, what to do); empty if there is none."""
    for pattern in GAPS:
        found = re.search(pattern, text)
        if found:
            whole = found[0].replace(found[1], "_".join(found[1].split()))
            return found[0], f"a name has no space, the PDF shows _ as a gap: {whole}"
    return "", ""


def parse_error(error, where, text):
    """The Wrong for a file that roslaunch cannot read. text: without comments."""
    expected = "a launch file that roslaunch can read"
    gap, hint = space_hint(text)
    open_find = re.search(r"\$\((?:find|arg)\b[^)\"'<>]*[\"'<>]", text)
    if re.search(NOT_XML, error):
        return Wrong(expected, error[:250], *_not_xml(error, where, text))
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
    hint, place = "roslaunch --nodes FILE shows the same", where
    arg = re.search(r"requires the '(\w+)' arg", error)
    if arg:
        hint = f'give it a value: <arg name="{arg[1]}" default="..."/>, or value="..." in the <include>'
        place = place_of(where, text, f'name="{arg[1]}"', "<include")
    elif "attribute" in error or "requires" in error:
        hint = 'a node has pkg=, type= and name=; an include has file="$(find PACKAGE)/launch/FILE"'
        tag = re.search(r"<(\w+)>", error)
        place = _tag_without(
            where, text, tag[1] if tag else "node", re.findall(r"'(\w+)'|(\w+)/(\w+) attr", error)
        )
    elif re.search(r"\barg", error):
        hint = 'each $(arg x) needs an <arg name="x" default="..."/>'
        place = place_of(where, text, "$(arg")
    return Wrong(expected, error[:250], place, hint)


def _tag_without(where, text, tag, attributes):
    """FILE:LINE of the first such tag that lacks an attribute. attributes: as re.findall has them."""
    names = [name for found in attributes for name in found if name]
    for found in re.finditer(rf"<{tag}\b[^<>]*", text):
        if not all(re.search(rf"\b{name}\s*=", found[0]) for name in names):
            return f"{where}:{text.count(chr(10), 0, found.start()) + 1}"
    return place_of(where, text, f"<{tag}")


def _not_xml(error, where, text):
    """(place, hint)."""
    curly = CURLY.search(text)
    if curly:
        return place_of(where, text, curly[0]), 'curly quotes came from the PDF: type " instead'
    line = re.search(r"line (\d+)", error)
    hint = (
        "each <tag> needs its </tag> or />; the mistake is in the line named or in the one before"
    )
    return f"{where}:{line[1]}" if line else where, hint


def _no_file(expected, path, where, text):
    path = Path(path)
    seen, place = f"no such file: {path}", place_of(where, text, path.name)
    if not path.is_absolute():
        hint = 'an include needs the whole path: file="$(find PACKAGE)/launch/FILE"'
        return Wrong(expected, seen, place, hint)
    beside = [each.name for each in path.parent.glob("*")] if os.path.isdir(path.parent) else []
    near = difflib.get_close_matches(path.name, beside, 1, 0.7)
    hint = f"is {near[0]} meant?" if near else "look at the name of the file, and of its folder"
    return Wrong(expected, seen, place, hint)
