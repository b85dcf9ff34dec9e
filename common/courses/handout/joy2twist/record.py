"""Section 4.3: the program is started while Joys stream."""

from __future__ import annotations

from dataclasses import dataclass

from tutorial_check import START_S, Workspace

from ..task import CMD_VEL, JOY, NEUTRAL, PACKAGE

STARTS = 10  # under load, all at once


@dataclass(frozen=True)
class Loaded:
    """Starts while Joys stream."""

    failed: bool  # in one of them a callback found no publisher


def loaded(workspace: Workspace, script: str) -> Loaded:
    """Start it ten times while 200 Joys a second come."""
    with workspace.ros_session() as ros:
        ros.peer.advertise(JOY, "Joy")
        ros.peer.listen(CMD_VEL, "Twist")
        ros.peer.stream(JOY, [NEUTRAL], 200.0, True)
        names = [f"__name:=loaded_{number}" for number in range(STARTS)]
        programs = [ros.start(PACKAGE, script, name) for name in names]

        def has_failed() -> bool:
            return any("NameError" in program.output for program in programs)

        def all_publish() -> bool:
            return len({caller for _, caller, _ in ros.peer.received(CMD_VEL)}) >= STARTS

        ros.wait(lambda: all_publish() or has_failed(), START_S)
        return Loaded(has_failed())
