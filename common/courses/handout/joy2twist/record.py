"""Section 4.3: a recorder that starts the program while Joys arrive."""

from __future__ import annotations

from dataclasses import dataclass

from tutorial_check import START_S, Workspace

from ..task import CMD_VEL, JOY, NEUTRAL, PACKAGE

STARTS = 10  # all at once


@dataclass(frozen=True)
class Loaded:
    """Programs that were started while Joys arrived."""

    failed: bool  # in one of them a callback had no publisher yet


def loaded(workspace: Workspace, script: str) -> Loaded:
    """Start it ten times at once while 200 Joys arrive each second."""
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
