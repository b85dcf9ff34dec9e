"""The student's text files, and the lines that a diagnosis names."""

from __future__ import annotations

from pathlib import Path

from tutorial_check.checking.results import Wrong, wrong_of
from tutorial_check.errors import FileTooLarge
from tutorial_check.submission import student_files
from tutorial_check.submission.launch_xml import place_of, without_comments


def text_of_file(path: Path) -> str:
    """Return the content of a text file. Raises Wrong if it is too large."""
    try:
        return student_files.text_of_file(path)
    except FileTooLarge as error:
        raise wrong_of(error) from None


def read_xml(path: Path) -> str:
    """Return a launch file or manifest without its comments. Raises Wrong."""
    return without_comments(text_of_file(path))


class Lines:
    """A text, and its path within the package."""

    where: str
    text: str

    def at(self, *words: str) -> str:
        """Return FILE:LINE of the first of the words that the text has; else the file."""
        return place_of(self.where, self.text, *words)

    def must(
        self, is_right: object, words: str, expected: str, seen: object, hint: str = ""
    ) -> None:
        """Raise Wrong unless it is right; its line is that of the first word that the text has."""
        if not is_right:
            raise Wrong(expected, str(seen), self.at(*words.split()), hint)
