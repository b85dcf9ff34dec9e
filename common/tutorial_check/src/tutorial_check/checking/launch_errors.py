"""Launch files that roslaunch cannot read: the line to blame, and a hint."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Callable
from xml.parsers import expat

from tutorial_check.checking.causes import advice, explained, is_lacking, meant, packages_of_ros
from tutorial_check.checking.results import Wrong, first_of
from tutorial_check.checking.texts import read_xml
from tutorial_check.submission.launch_xml import (
    COMMENT_END,
    Fault,
    comments,
    line_of,
    place_of,
    without_comments,
)

CURLY = re.compile("[“”‘’]")
VALUE = re.compile(r"=\s*(\"[^\"]*\"|'[^']*')")
QUOTES = 'each value needs two quotes: name="value"'
# Packages that a launch file of the exercises may name.
PACKAGES = (
    "rbx1_nav rbx1_bringup turtlebot_rviz_launchers turtlebot_bringup fake_turtlebot_sim joy2twist"
    " gamepad joy rosbag rviz"
)
EXPECTED = "a launch file that roslaunch can read"
# roslaunch's error classes and messages.
UNSET, UNUSED = "ArgException", r"unused args \[(\w+).*\] for include of \[(.*)\]"
NO_FILE = r"No such file or directory: '([^']+)'|file does not exist \[([^\]]*)\]"


def not_xml(error: str, text: str) -> tuple[int | None, str]:
    """Return (line or None, hint) for expat's error in a launch file. text: with its comments."""
    curly = CURLY.search(without_comments(text))
    if curly:
        return line_of(text, curly.start()), 'curly quotes came from the PDF: type " instead'
    if re.search("mismatched tag|no element found", error):
        return _not_closed(text)
    place = re.search(r"line (\d+), column (\d+)", error)
    if not place:
        return None, 'Python cannot read the encoding of its first line: write encoding="utf-8"'
    line, column = map(int, place.groups())
    if "junk after" in error:
        return line, "nothing may follow </launch>: put it before"
    start = sum(len(before) + 1 for before in text.split("\n")[: line - 1])
    return _not_well_formed(text, line, start + column)


def _not_well_formed(text: str, line: int, index: int) -> tuple[int, str]:
    """Return the same for an error of expat's at text[index], in that line."""
    ends = -len(COMMENT_END) + 1  # with the first hyphen of its end, as in "--->"
    inner = ((start, text.find("--", start + 4, end + ends)) for start, end in comments(text))
    if line in {line_of(text, index) for _, index in inner if index >= 0}:
        return line, "a comment must not contain --: delete it, or the whole line"
    if text.startswith("<!--", index):
        return line, "each <!-- needs its -->"
    if text[index : index + 1] == "\xa0":
        return line, "a gap from the PDF is not a space: delete it, and type a space"
    # A value without its closing quote extends to the next tag, so look at the tag before it first.
    for start in (text.rfind("<", 0, index), text.rfind("<", 0, index + 1)):
        tag = re.split("[<>]", text[start + 1 :])[0] if start >= 0 else ""
        if re.search(r"[\"'=]", VALUE.sub("", tag)):
            return line_of(text, start), QUOTES
    return line, "each tag ends with > or />; the mistake is in the line named or in the one before"


def _not_closed(text: str) -> tuple[int | None, str]:
    """Return the same for a file with a tag that is not closed, or closed twice."""
    stack: list[tuple[str, int]] = []  # (tag, line) of those that are open
    parser = expat.ParserCreate("utf-8")
    parser.StartElementHandler = lambda tag, _: stack.append((tag, parser.CurrentLineNumber))
    parser.EndElementHandler = lambda _: stack.pop()
    try:
        parser.Parse(text.encode(), True)
    except expat.ExpatError as error:
        line = error.lineno
        closing = re.split(r"[^\w-]", text.split("\n")[line - 1][error.offset :])[0]
    else:
        return None, "each <tag> needs its </tag> or />"  # the file was saved in between
    if not stack:
        return None, "it begins with <launch> and ends with </launch>"
    tag, opened = stack[-1]
    if closing and closing not in dict(stack):
        return line, f"</{closing}> closes nothing: the open tag is the <{tag}> of line {opened}"
    return opened, f"the <{tag}> of line {opened} is never closed: /> at its end, or </{tag}> below"


def package_hint(name: str) -> str:
    """Return what to do about a missing ROS package."""
    words = f"there is no package {name}; is {{}} meant?"
    hint = "" if is_lacking(name) else meant(name, PACKAGES.split(), 0.8, words)
    spelling = f"there is no package {name}: look at the spelling in $(find {name}) or pkg="
    return hint or advice(name, packages_of_ros(name)) or spelling


def blamed_place(fault: Fault, is_own: Callable[[str], bool]) -> tuple[str, int]:
    """Return (file, line) of the innermost tag in a student's file.

    If the included file declares an arg that has no value, the <include> is to blame.
    """
    own = [place for place in fault.places if is_own(place[0])]
    if fault.kind == UNSET:
        file = own[-1][0]
        declared = rf"<arg\b[^<>]*\bname\s*=\s*[\"']{re.escape(fault.words)}[\"']"
        if re.search(declared, read_xml(Path(file))):
            own = [place for place in own if place[0] != file] or own
    return own[-1]


@dataclass(frozen=True)
class Unread:
    """A launch file that roslaunch cannot read."""

    fault: Fault
    where: str  # of its tag: the file
    line: int
    text: str  # of the file, with comments
    may_see: Callable[[Path], bool]

    @property
    def words(self) -> str:
        return " ".join(self.fault.words.split())[:250]

    def wrong(self, seen: str, hint: str) -> Wrong:
        return Wrong(EXPECTED, seen, f"{self.where}:{self.line}", hint)


def no_xml(file: Unread) -> Wrong | None:
    if file.fault.kind != "ExpatError":
        return None
    line, hint = not_xml(file.fault.words, file.text)
    return Wrong(EXPECTED, file.words, f"{file.where}:{line}" if line else file.where, hint)


def open_substitution(file: Unread) -> Wrong | None:
    text = without_comments(file.text)
    opened = re.search(r"\$\((?:find|arg)\b[^)\"'<>]{0,300}[\"'<>]", text)
    if not opened:
        return None
    hint = "each $( needs its ): $(find PACKAGE)/launch/FILE"
    return Wrong(
        EXPECTED, f"{opened[0][:-1]} without )", place_of(file.where, text, opened[0]), hint
    )


def lost_package(file: Unread) -> Wrong | None:
    if file.fault.kind != "ResourceNotFound":
        return None
    return file.wrong(f"package not found: {file.words}", package_hint(file.words))


def lost_include(file: Unread) -> Wrong | None:
    match = re.search(NO_FILE, file.words)
    if not match:
        return None
    path = Path(match[1] or match[2])
    hint = 'an include needs the whole path: file="$(find PACKAGE)/launch/FILE"'
    if path.is_absolute():
        paths = path.parent.glob("*") if file.may_see(path.parent) else ()
        hint = meant(path.name, [path.name for path in paths], 0.7)
        hint = hint or "look at the name of the file, and of its folder"
    return file.wrong(f"no such file: {path}", hint)


def unknown_arg(file: Unread) -> Wrong | None:
    unused = re.search(UNUSED, file.words)
    if not unused:
        return None
    path = Path(unused[2])
    text = read_xml(path) if file.may_see(path) and path.is_file() else ""
    known = re.findall(r"<arg\b[^<>]*\bname\s*=\s*[\"']([^\"']+)[\"']", text)
    hint = meant(unused[1], known, 0.6) or f"remove it; the file has {', '.join(known) or 'none'}"
    return file.wrong(f"{path.name} has no arg {unused[1]}", hint)


def launch_error(
    fault: Fault, where: str, line: int, text: str, may_see: Callable[[Path], bool]
) -> Wrong:
    """Return the Wrong for a file that roslaunch cannot read. text: with its comments."""
    file = Unread(fault, where, line, text, may_see)
    wrong = first_of((no_xml, open_substitution, lost_package, lost_include, unknown_arg), file)
    if wrong:
        return wrong
    said = f"{fault.kind} <{fault.tag}>: {file.words.partition(' xml is ')[0]}"
    *seen, hint = explained("roslaunch", said)
    return file.wrong((seen or [file.words])[0], hint)
