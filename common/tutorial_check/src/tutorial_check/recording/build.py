"""What catkin_make makes of a workspace."""

from __future__ import annotations

from dataclasses import dataclass

from tutorial_check.recording.builder import Builder, Built


@dataclass(frozen=True)
class Installed:
    """Whether catkin has made a program that rosrun finds."""

    installed: bool


def built(workspace: Builder) -> Built:
    return workspace.built


def own_built(workspace: Builder) -> Built:
    """Build the packages of the exercises alone, as another may have kept them from it."""
    return workspace.build(only_needed=True)


def installed(workspace: Builder, package: str, script: str) -> Installed:
    """Look for a program in devel. script: its path within the package."""
    return Installed("/devel/lib/" in workspace.command(package, script)[0])
