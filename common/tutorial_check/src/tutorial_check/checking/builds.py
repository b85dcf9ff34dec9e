"""Whether a submission builds with catkin_make."""

from __future__ import annotations

from tutorial_check.checking.build_errors import build_error, endless_build
from tutorial_check.checking.results import Wrong
from tutorial_check.checking.submission import Submission
from tutorial_check.data.recorders import BUILT, OWN_BUILT
from tutorial_check.data.recordings import Built
from tutorial_check.submission.packages import Package


def cmake_of(package: Package) -> str:
    """Return the text of a package's CMakeLists.txt without comments. Raises Wrong."""
    if package.cmake is None:
        expected, hint = "a package as catkin_create_pkg makes it", "take it from a new package"
        raise Wrong(expected, "the file CMakeLists.txt is missing", package.inside, hint)
    return package.cmake


def must_build(submission: Submission) -> Built:
    """Return what catkin_make has built. Raises Wrong."""
    for package in submission.needed:
        cmake_of(package)
    made = submission.recording(BUILT)
    if made.code is None:
        raise endless_build(submission, made.output)
    if made.code != 0:
        outputs = (made.output, build_output(submission))
        wrong, own = (build_error(submission, output) for output in outputs)
        if (own.seen, own.where) != (wrong.seen, wrong.where):
            place = f" ({wrong.where})" if wrong.where else ""
            own.seen += f"; another package fails, too: {wrong.seen}{place}"
        own.look = "catkin_make"
        raise own
    return made


def build_output(submission: Submission) -> str:
    """Return what catkin_make prints about the exercises' packages, whatever other packages do."""
    made = submission.recording(BUILT)
    if not made.code or len(submission.needed) == len(submission.packages):
        return made.output
    return submission.recording(OWN_BUILT).output
