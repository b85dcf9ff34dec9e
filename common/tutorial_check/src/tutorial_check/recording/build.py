"""Recorders of builds with catkin_make."""

from __future__ import annotations

from tutorial_check.data.recordings import Built, Installed
from tutorial_check.recording.builder import Builder


def built(workspace: Builder) -> Built:
    return workspace.built


def own_built(workspace: Builder) -> Built:
    """Build only the exercises' packages, because another package may have stopped the build."""
    return workspace.needed_built


def installed(workspace: Builder, package: str, script: str) -> Installed:
    """Look for a program in devel. script: its path within the package."""
    return Installed("/devel/lib/" in workspace.command(package, script)[0])
