"""Files of the student's, whose lines a diagnosis names."""

from __future__ import annotations

from typing import Callable, TypeVar

from tutorial_check.checking.packages import package_of
from tutorial_check.checking.programs import crash, program_of
from tutorial_check.checking.results import Wrong
from tutorial_check.checking.texts import Lines
from tutorial_check.processes.program import Ran
from tutorial_check.submission.files import Session

Recording = TypeVar("Recording")


class File(Lines):
    """A file of a package, such as a program."""

    def __init__(self, session: Session, package: str, path: str) -> None:
        """Read it. path: within the package. Raises Wrong if there is none."""
        if not (package_of(session, package).folder / path).is_file():
            seen, hint = "no such file in the package", f"write it: {path}"
            raise Wrong(f"{package}/{path}", seen, hint=hint)
        self._session, self._package, self.where = session, package, path
        self.text = session.text(package, path)

    def must_run(self, ran: Ran, expected: str, hint: str = "", may_end: bool = False) -> None:
        """Raise Wrong if this program printed a traceback, or has ended, unless it may."""
        if "Traceback" in ran.output or (ran.ended and not may_end):
            hint = hint or "rospy.spin() keeps it running"
            raise crash(self._session, self._package, ran, expected, hint)


def recorded(
    session: Session, package: str, name: str, recorder: Callable[..., Recording], *about: object
) -> tuple[File, Recording]:
    """Return a program, and what recorder(ground, path, ...) recorded of it. Raises Wrong."""
    file = File(session, package, program_of(session, package, name))
    return file, session.recording(recorder, file.where, *about)
