"""What the checker itself records of programs, builds, topics and launch files."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Dict, Optional, Tuple

Heard = Tuple[float, str, Tuple[float, ...]]  # (when it came [s], from which node, its numbers)
HeardText = Tuple[float, str, str]
Topics = Dict[str, Tuple[str, ...]]  # {topic: nodes}
LaunchNode = Dict[str, Any]  # a node of a launch file: package, type, name, args ...


@dataclass(frozen=True)
class Ran:
    """The state of a program that was started, at the time of recording."""

    name: str
    output: str
    code: Optional[int]  # if it ended by itself: its exit code, or -N for signal N
    spins: bool  # it used the CPU without making progress until it was stopped
    was_stopped: bool

    @property
    def ended(self) -> bool:
        return self.code is not None


@dataclass(frozen=True)
class Executable:
    """A program in C++, as CMake has configured it."""

    name: str  # of the file that rosrun starts
    path: str  # of that file, within the workspace
    sources: Tuple[str, ...]  # within src; its own first, then those of the libraries it needs
    is_built: bool = False


@dataclass(frozen=True)
class Built:
    """A build of all packages; if that fails, of those that the exercises need."""

    code: Optional[int]  # catkin_make's exit code; None: it did not end
    output: str
    unbuilt: str = ""  # what it printed about packages that the exercises do not need
    executables: Tuple[Executable, ...] = ()


@dataclass(frozen=True)
class Installed:
    """Whether catkin has put a program where rosrun finds it."""

    installed: bool


@dataclass(frozen=True)
class ReadLaunchFiles:
    """What roslaunch makes of launch files; see launch_file_reader."""

    files: Optional[Tuple[Dict[str, Any], ...]]  # None: reading them does not end
