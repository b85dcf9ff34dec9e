"""What the readers of catkin_make's output share: the target that failed, and hints."""

from __future__ import annotations

import re
from dataclasses import dataclass

from tutorial_check.checking.causes import explained
from tutorial_check.checking.submission import Submission
from tutorial_check.submission.launch_xml import place_of
from tutorial_check.submission.packages import Package

EXPECTED = "catkin_make without an error"
# Package, target, and the source of the object file that make cannot make. Bounded, because an
# unbounded search takes quadratic time.
FAILED = re.compile(
    r"\*\*\* \[(\S{1,200}?)/CMakeFiles/(\S{1,200}?)\.dir/"
    r"(?:build\.make:\d+: \S{1,200}?/CMakeFiles/\S{1,200}?\.dir/(\S{1,200})\.o\])?"
)


@dataclass(frozen=True)
class Target:
    """A program or library of a package, at which make failed."""

    package: Package | None = None
    name: str = ""
    source: str = ""  # the path within the package of what was compiled; "" for the linker

    @property
    def cmake(self) -> str:
        """The text of CMakeLists.txt, with the project's name."""
        if not self.package:
            return ""
        return (self.package.cmake or "").replace("${PROJECT_NAME}", self.package.name)

    @property
    def file(self) -> str:
        """CMakeLists.txt, for the student; "" if the package is unknown."""
        return f"{self.package.inside}/CMakeLists.txt" if self.package else ""

    @property
    def where(self) -> str:
        """The line of CMakeLists.txt that adds it."""
        words = (f"add_executable({self.name}", f"add_library({self.name}", f"({self.name}")
        return self.line_with(*words) or self.file

    def lacks(self, word: str) -> bool:
        """Return whether CMakeLists.txt is known, and does not name a package."""
        return bool(self.package) and not re.search(rf"\b{re.escape(word)}\b", self.cmake)

    def line_with(self, *words: str) -> str:
        """Return the line of CMakeLists.txt with the first of the words that occurs; or ""."""
        if not any(word in self.cmake for word in words):
            return ""
        return place_of(self.file, self.cmake, *words)


def failed_target(submission: Submission, output: str, start: int = 0) -> Target:
    """Return the target at which make failed after an error. start: where that error is."""
    failed = FAILED.search(output, start) or FAILED.search(output)
    if not failed:
        return Target()
    inside = (package for package in submission.packages if package.inside == failed[1])
    return Target(next(inside, None), failed[2], failed[3] or "")


def build_hint(section: str, text: str) -> str:
    """Return what causes.txt has for an error of a build."""
    hint = "".join(explained(section, text))
    return hint or "read the first error of catkin_make: it names file and line"
