"""Files of the student's packages, whose lines a diagnosis names."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Sequence

from tutorial_check.checking.crashes import crash, silent_end, traceback_of
from tutorial_check.checking.packages import package_of
from tutorial_check.checking.results import Note, Wrong
from tutorial_check.checking.submission import Submission
from tutorial_check.checking.texts import Lines
from tutorial_check.course.definition import ANY
from tutorial_check.data.recordings import Ran
from tutorial_check.submission.aborts import abort_of, has_failed
from tutorial_check.submission.idioms import PYTHON, Idioms
from tutorial_check.submission.python_facts import PythonFacts
from tutorial_check.submission.source_facts import SourceFacts


class File(Lines):
    """A file of a package."""

    idioms: Idioms = PYTHON  # the program's

    def __init__(self, submission: Submission, package: str, path: str) -> None:
        """Read it. path: within the package. Raises Wrong if it is missing."""
        if not (package_of(submission, package).folder / path).is_file():
            seen, hint = "no such file in the package", f"write it: {path}"
            raise Wrong(f"{package}/{path}", seen, hint=hint)
        self.submission, self.package, self.where = submission, package, path
        self.text = submission.text(package, path)

    def crash(self, ran: Ran, expected: str, hint: str = "") -> Wrong:
        return crash(self.submission, self.package, ran, expected, hint)

    def must_run(self, ran: Ran, expected: str, hint: str = "", may_end: bool = False) -> None:
        """Raise Wrong if this program has failed, or ended although it may not."""
        if has_failed(ran) or (ran.ended and not may_end):
            raise self.crash(ran, expected, hint or f"{self.idioms.spin} keeps it running")


class Script(File):
    """A program of a package, with the facts that its text shows."""

    def __init__(self, submission: Submission, package: str, path: str) -> None:
        """Read it. path: within the package. Raises Wrong if it is missing."""
        super().__init__(submission, package, path)
        self.name = Path(path).name
        facts, compiled = (
            submission.facts_of(package, path),
            submission.executable_of(package, path),
        )
        self.facts: SourceFacts = facts or PythonFacts("")
        self.is_python = facts is not None and facts.is_python
        if compiled:
            self.name, self.text = compiled.name, "\n".join(self.facts.text.values())
        self.idioms = self.facts.idioms

    def either(self, python: str, cpp: str) -> str:
        """Return the text for the language of the program."""
        return python if self.facts.is_python else cpp

    def at(self, *words: str) -> str:
        """Return FILE:LINE of the first of the words that the text has; else the file."""
        place = super().at(*words)
        return self.at_line(int(place.rpartition(":")[2])) if place != self.where else place

    def at_line(self, line: int = 0) -> str:
        """Return FILE:LINE; for line 0 only the file."""
        return self.facts.place(self.where, line)

    def at_call(self, name: str) -> str:
        """Return FILE:LINE of the first call of a function, or else the file."""
        return self.at_line(*self.facts.lines(name)[:1])

    def end(self, ran: Ran, expected: str, hint: str = "") -> Wrong:
        """Return the Wrong for a program that ended; its text explains what its output does not."""
        return self.with_end(self.crash(ran, expected, hint))

    def with_end(self, wrong: Wrong) -> Wrong:
        """Return the Wrong for a program that ended, with what its text shows if it has no line."""
        if not wrong.where:
            subscriber = self.facts.first("Subscriber")
            topic = f"; it subscribes to {', '.join(subscriber.words[:2])}" if subscriber else ""
            line, hint = silent_end(self.facts)
            wrong.seen, wrong.where = wrong.seen + topic, self.at_line(line)
            wrong.hint = hint if line else wrong.hint or hint
        return wrong

    def check_end(self, taken_s: float | None, output: str) -> Note | None:
        """Return a Note on how Ctrl-C ended it, or None. Raises Wrong. taken_s: None if killed."""
        if taken_s is None:
            endless = self.facts.loops if "is_shutdown" not in self.facts.calls else []
            expected, where = f"{self.name} ends within 3 s of Ctrl-C", self.at_line(*endless[:1])
            hint = f"{self.idioms.spin}, or {self.idioms.loop}"
            hint += " and no `except` that hides the end" if self.is_python else ""
            bare_ok = self.facts.lapses.bare_ok
            if bare_ok:
                where, hint = self.at_line(bare_ok), "without () it is not called: ros::ok()"
            raise Wrong(expected, "it had to be killed", where, hint)
        trace = traceback_of(self.submission, self.package, output)
        if trace and "ROSInterrupt" in trace.error:
            seen = f"{self.name} ends with a traceback, ROSInterruptException"
            return Note(seen, trace.where, "except rospy.ROSInterruptException: pass")
        error = "" if self.is_python else abort_of(output)
        if error:
            return Note(f"{self.name} ends with an error: {error}", self.where)
        if trace:
            hint = "try: ... except rospy.ROSInterruptException: pass"
            raise Wrong(f"{self.name} ends without a traceback", trace.error, trace.where, hint)
        return None

    def unusual_node_name(self) -> Note | None:
        """Return a Note on its node's name, if ROS warns about that."""
        if not self.facts.unusual_node_name:
            return None
        line, name = self.facts.unusual_node_name
        seen = f"the node is called {name!r}, which ROS warns about: not a legal ROS base name"
        right = re.sub(r"\W", "_", re.sub(r"\.py$", "", name))
        return Note(seen, self.at_line(line), f"letters, digits and _ only: {right!r}")

    def private(self, kind: str, expected: str, seen: str) -> Wrong | None:
        """Return the Wrong for a Publisher or Subscriber of a private NodeHandle, or None."""
        line = dict(self.facts.oddities.private).get(kind, 0)
        hint = "a private NodeHandle puts the node's name before a topic: ros::NodeHandle n;"
        return Wrong(expected, seen, self.at_line(line), hint, sure=True) if line else None


def in_cpp(programs: Sequence[Script]) -> Note | None:
    """Return a Note on programs in C++ where the course takes any language, or None."""
    paths = [program.where for program in programs if not program.is_python]
    if not paths or programs[0].submission.language != ANY:
        return None
    return Note(f"{', '.join(paths)}: in C++, which is right; the handout's are in Python")
