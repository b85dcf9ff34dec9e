"""C19: the simulated robot follows."""

from __future__ import annotations

from tutorial_check import Note, Submission, Wrong, check, crash

from ..driving.evidence import ANGULAR, LINEAR
from ..driving.main_script import main_script
from ..task import PACKAGE
from .record import agree, follow


@check("C19", "the simulated robot follows", "4.4", needs="C16",
       look="rostopic echo /odom/pose/pose/position")  # fmt: skip
def simulated(submission: Submission) -> Note | str | None:
    script = main_script(submission)
    drive = submission.recording(follow, script)
    if not drive.ready:
        raise crash(submission, PACKAGE, drive.program, "the node runs beside the simulated robot")
    if len(drive.publishers) != 1:
        seen = f"{len(drive.publishers)}: {', '.join(drive.publishers)}"
        hint = "end the older version: rosnode list"
        raise Wrong(f"one node publishes on {submission.task.names.cmd_vel}", seen, hint=hint)
    if drive.told_v is None or drive.told_w is None:
        raise Wrong("Twists that the robot obeys", "none came")
    seen = f"{drive.v:.2f} m/s, then {drive.w:.2f} rad/s"
    if not agree(drive.v, drive.told_v, LINEAR) or not agree(drive.w, drive.told_w, ANGULAR):
        expected = f"forwards with {drive.told_v:.2f} m/s,"
        expected += f" then turning left with {drive.told_w:.2f} rad/s"
        rules = submission.task.answers.rules
        hint = f"linear.x = {rules[1]}, angular.z = {rules[0]}, for every Joy"
        raise Wrong(expected, seen, script, hint)
    return seen
