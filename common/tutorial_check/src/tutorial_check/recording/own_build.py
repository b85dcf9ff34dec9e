"""What catkin_make makes of the packages of the exercises alone."""

from __future__ import annotations

from tutorial_check.recording.builder import SLOW_S, Builder, Built


def own_built(workspace: Builder) -> Built:
    """Build them after a build that failed, as another package may have kept them from it."""
    names = ";".join(package.name for package in workspace.needed)
    only = f"-DCATKIN_WHITELIST_PACKAGES={names}"
    program = workspace.runner.start(("catkin_make", "-C", str(workspace.folder / "ws"), only))
    ended = workspace.runner.wait(lambda: program.ended, SLOW_S)
    workspace.runner.end(program)
    return Built(program.process.returncode if ended else None, program.output)
