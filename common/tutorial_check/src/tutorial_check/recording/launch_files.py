"""A recorder of what roslaunch reads in launch files, and a launch file that runs."""

from __future__ import annotations

import json
import re
from typing import Tuple

from tutorial_check.data.recordings import ReadLaunchFiles
from tutorial_check.errors import CannotCheck
from tutorial_check.recording import launch_file_reader
from tutorial_check.recording.ros_session import RosSession
from tutorial_check.recording.workspace import Workspace
from tutorial_check.submission.tracebacks import last_lines

READ_S = 15.0  # for all files
DIED = re.compile(r"^\[([^\]]+)-\d+\] process has died", re.MULTILINE)


def read_launch_files(workspace: Workspace, *paths: str) -> ReadLaunchFiles:
    """Read launch files as roslaunch does, and start nothing. paths: within src."""
    whole = [str(workspace.source / path) for path in paths]
    command = ["/usr/bin/python3", launch_file_reader.__file__, *whole]
    program = workspace.runner.start(command, workspace.environment)
    ended = workspace.runner.wait(program.has_ended, READ_S)
    workspace.runner.end(program)
    if not ended and workspace.runner.clock.busy():
        raise CannotCheck("launch files cannot be read in time: the machine is too busy")
    if not ended:
        return ReadLaunchFiles(None)
    lines = (
        line for line in program.output.splitlines() if line.startswith(launch_file_reader.MARK)
    )
    files = tuple(json.loads(line[len(launch_file_reader.MARK) :]) for line in lines)
    if sorted(file["path"] for file in files) != sorted(whole):
        raise CannotCheck(f"launch files cannot be read: {last_lines(program.output)}")
    return ReadLaunchFiles(files)


class Launch:
    """A launch file that runs in a RosSession."""

    def __init__(self, ros: RosSession, path: str, *arguments: str) -> None:
        """Start it. path: within src. arguments: such as x:=1."""
        self._ros = ros
        self.program = ros.launch(["roslaunch", str(ros.workspace.source / path), *arguments])

    @property
    def nodes(self) -> Tuple[str, ...]:
        """The nodes at the master, without the checker's."""
        return tuple(sorted(self._ros.peer.state()[0].get("/rosout", ())))

    @property
    def died(self) -> Tuple[str, ...]:
        """The nodes that roslaunch reports as dead."""
        return tuple(DIED.findall(self.program.output))

    @property
    def is_over(self) -> bool:
        """Whether it, or one of its nodes, has ended."""
        return self.program.ended or bool(self.died)
