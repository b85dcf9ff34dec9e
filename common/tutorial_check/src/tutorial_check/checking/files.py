"""Files of the student's, whose lines a diagnosis names."""

from __future__ import annotations

from typing import Callable, TypeVar

from tutorial_check.checking.packages import package_of
from tutorial_check.checking.programs import crash, program_of
from tutorial_check.checking.results import Wrong
from tutorial_check.checking.submission import Submission
from tutorial_check.checking.texts import Lines
from tutorial_check.processes.program import Ran

Recording = TypeVar("Recording")


class File(Lines):
    """A file of a package, such as a program."""

    def __init__(self, submission: Submission, package: str, path: str) -> None:
        """Read it. path: within the package. Raises Wrong if there is none."""
        if not (package_of(submission, package).folder / path).is_file():
            seen, hint = "no such file in the package", f"write it: {path}"
            raise Wrong(f"{package}/{path}", seen, hint=hint)
        self._submission, self._package, self.where = submission, package, path
        self.text = submission.text(package, path)

    def must_run(self, ran: Ran, expected: str, hint: str = "", may_end: bool = False) -> None:
        """Raise Wrong if this program printed a traceback, or has ended, unless it may."""
        if "Traceback" in ran.output or (ran.ended and not may_end):
            hint = hint or "rospy.spin() keeps it running"
            raise crash(self._submission, self._package, ran, expected, hint)


def recorded(
    submission: Submission,
    package: str,
    name: str,
    recorder: Callable[..., Recording],
    *about: object,
) -> tuple[File, Recording]:
    """Return a program, and what recorder(workspace, path, ...) recorded of it. Raises Wrong."""
    file = File(submission, package, program_of(submission, package, name))
    return file, submission.recording(recorder, file.where, *about)
