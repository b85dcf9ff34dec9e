"""The text of a launch file or manifest: comments, lines, and roslaunch's errors."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Iterator, Sequence

COMMENT_START, COMMENT_END = "<!--", "-->"
# Names with a space. (roslaunch allows it in the name of a node, which gets a note.)
GAPS = (
    r"\$\(find\s+(\w+(?:[ \t]+\w+)+)\s*\)",
    r"\b(?:pkg|type)\s*=\s*[\"'](\w+(?:[ \t]+[\w.]+)+)[\"']",
)


def comments(text: str) -> Iterator[tuple[int, int]]:
    """Yield (start, end) of each comment in linear time, unlike a regular expression."""
    start = text.find(COMMENT_START)
    while start >= 0:
        end = text.find(COMMENT_END, start + len(COMMENT_START))
        if end < 0:
            return
        yield start, end + len(COMMENT_END)
        start = text.find(COMMENT_START, end + len(COMMENT_END))


def without_comments(text: str) -> str:
    """Return the text with blanks instead of comments, so that lines keep their numbers."""
    parts, done = [], 0
    for start, end in comments(text):
        blank = "\n".join(" " * len(line) for line in text[start:end].split("\n"))
        parts += [text[done:start], blank]
        done = end
    return "".join([*parts, text[done:]])


def place_of(where: str, text: str, *words: str) -> str:
    """Return FILE:LINE of the first line with the first of the words that occurs; else the file."""
    for word in words:
        for number, line in enumerate(text.splitlines(), 1):
            if word and word in line:
                return f"{where}:{number}"
    return where


def line_of(text: str, index: int) -> int:
    """Return the number, from 1, of the line that text[index] is in."""
    return text.count("\n", 0, index) + 1


@dataclass(frozen=True)
class Fault:
    """An error of roslaunch in a launch file, and the tag that it was reading."""

    kind: str
    words: str
    tag: str
    places: Sequence[tuple[str, int]]  # (file, line) of each tag around it, the outermost first


def attribute(name: str, value: str) -> tuple[str, ...]:
    """Return the ways to write an attribute, for place_of."""
    return f'{name}="{value}"', f"{name}='{value}'", value
