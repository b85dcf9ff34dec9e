"""A launch file that is no XML, or whose tags are nested by mistake: from its text to the culprit. Pure."""

from __future__ import annotations

import re
from pathlib import Path
from xml.parsers import expat

CURLY = re.compile("[“”‘’]")
COMMENT = re.compile(r"<!--(.*?)-->", re.DOTALL)
VALUE = re.compile(r"=\s*(\"[^\"]*\"|'[^']*')")
QUOTES = 'each value stands between two quotes: name="value"'


def without_comments(text: str) -> str:
    """Return the text with blanks in place of comments: its lines keep their numbers."""
    return COMMENT.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), text)


def read(path: Path) -> str:
    """Return the text of a launch file, or manifest, without its comments."""
    return without_comments(path.read_text(errors="replace"))


def place_of(where: str, text: str, *words: str) -> str:
    """FILE:LINE of the first line with the first of the words that is there; else the file."""
    for word in words:
        for number, line in enumerate(text.splitlines(), 1):
            if word and word in line:
                return f"{where}:{number}"
    return where


def line_of(text: str, index: int) -> int:
    """Return the number of the line, from 1, in which text[index] stands."""
    return text.count("\n", 0, index) + 1


def not_xml(error: str, text: str) -> tuple[int | None, str]:
    """(line or None, hint) for what expat says of a launch file. text: with its comments."""
    curly = CURLY.search(without_comments(text))
    if curly:
        return line_of(text, curly.start()), 'curly quotes came from the PDF: type " instead'
    if re.search("mismatched tag|no element found", error):
        return _not_closed(text)
    found = re.search(r"line (\d+), column (\d+)", error)
    if not found:
        return None, "each <tag> needs its </tag> or />"
    line, column = map(int, found.groups())
    if "junk after" in error:
        return line, "nothing may follow </launch>: put it before"
    start = sum(len(each) + 1 for each in text.split("\n")[: line - 1])
    return _not_well_formed(text, line, start + column)


def _not_well_formed(text: str, line: int, index: int) -> tuple[int, str]:
    """Return the same for a file in which expat came as far as text[index], in that line."""
    dashes = [
        line_of(text, each.start(1) + f"{each[1]}-".index("--"))
        for each in COMMENT.finditer(text)
        if "--" in f"{each[1]}-"
    ]
    if line in dashes:
        return line, "within <!-- --> there may be no --: delete it, or the whole line"
    if text.startswith("<!--", index):
        return line, "each <!-- needs its -->"
    if text[index : index + 1] == "\xa0":
        return line, "a gap that came from the PDF is no space: delete it, and type one instead"
    # A value without its second quote goes on to the next tag: so, the one before it first.
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
        return None, "each <tag> needs its </tag> or />"  # it was saved in between
    if not stack:
        return None, "it begins with <launch> and ends with </launch>"
    tag, opened = stack[-1]
    if closing and closing not in dict(stack):
        return line, f"</{closing}> closes nothing: open is the <{tag}> of line {opened}"
    return opened, f"the <{tag}> of line {opened} is never closed: /> at its end, or </{tag}> below"
