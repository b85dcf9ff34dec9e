"""Texts of the student's: read, and the line that a diagnosis names."""

from __future__ import annotations

from pathlib import Path

from tutorial_check.checking.results import Wrong, wrong_of
from tutorial_check.errors import FileTooLarge
from tutorial_check.submission import student_files
from tutorial_check.submission.launch_xml import place_of, without_comments


def text_of_file(path: Path) -> str:
    """Return what a text file holds. Raises Wrong for one that is too large."""
    try:
        return student_files.text_of_file(path)
    except FileTooLarge as error:
        raise wrong_of(error) from None


def read_xml(path: Path) -> str:
    """Return the text of a launch file, or manifest, without its comments. Raises Wrong."""
    return without_comments(text_of_file(path))


class Lines:
    """A text, and where it is within its package."""

    where: str
    text: str

    def at(self, *words: str) -> str:
        """Return FILE:LINE of the first of the words that is there; else the file."""
        return place_of(self.where, self.text, *words)

    def must(
        self, is_right: object, words: str, expected: str, seen: object, hint: str = ""
    ) -> None:
        """Raise Wrong, at the first of the words that is there, unless it is right."""
        if not is_right:
            raise Wrong(expected, str(seen), self.at(*words.split()), hint)
