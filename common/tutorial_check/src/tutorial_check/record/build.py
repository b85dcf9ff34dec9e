"""What catkin_make makes of a workspace."""

from __future__ import annotations

from dataclasses import dataclass
from typing import List, Optional, Protocol


@dataclass(frozen=True)
class Built:
    """A build of all, or of what the exercises need if all cannot be built."""

    code: Optional[int]  # catkin_make's exit code; None: it did not end
    output: str
    unbuilt: str = ""  # what it printed of packages that the exercises do not need


@dataclass(frozen=True)
class Installed:
    """Whether catkin has made a program that rosrun finds."""

    installed: bool


class Builds(Protocol):
    """A ground.Ground, as far as it is needed here."""

    @property
    def built(self) -> Built:
        """Build, at the first call."""

    def command(self, package: str, script: str) -> List[str]:
        """Return what starts a program as rosrun does."""


def built(ground: Builds) -> Built:
    """Build the workspace."""
    return ground.built


def installed(ground: Builds, package: str, script: str) -> Installed:
    """Look for a program in devel. script: its path within the package."""
    return Installed("/devel/lib/" in ground.command(package, script)[0])
