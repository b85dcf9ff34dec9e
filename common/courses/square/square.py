"""The example of COURSES.md: a program must drive a square of 1 m, and then rest."""

import math
from dataclasses import dataclass
from typing import Tuple

from tutorial_check import (
    PoseSample,
    Ran,
    SimulatedTurtleBot,
    Wrong,
    check,
    crash,
    has_moved,
    program_of,
)

CORNERS = [(1, 0), (1, 1), (0, 1), (0, 0)]  # [m] to the left; to the right, y is negative
NEAR_M = 0.1
LONGEST_S = 25.0


@dataclass(frozen=True)
class Drive:
    """The recording: the program, and the robot's path."""

    program: Ran
    path: Tuple[PoseSample, ...]


def drive(workspace, script) -> Drive:
    """Record a drive."""
    with workspace.ros_session() as ros:
        robot = SimulatedTurtleBot(ros)
        program = ros.start("square", script)
        path = robot.drive(program, longest_s=LONGEST_S)
    return Drive(program.ran, path)


def path_of(submission):
    """Return the robot's path, which is recorded once for all checks."""
    seen = submission.recording(drive, program_of(submission, "square", "square.py"))
    if not has_moved(seen.path):
        hint = "publish geometry_msgs/Twist on /cmd_vel"
        raise crash(submission, "square", seen.program, "the robot drives", hint)
    return seen.path


@check("S1", section="1", look="rosrun square square.py")
def drives(submission):
    """It drives."""
    path = path_of(submission)
    return f"for {path[-1].at_s - path[0].at_s:.0f} s"


@check("S2", section="1", needs=drives, look="rostopic echo /odom")
def passes_corners(submission):
    """It passes the corners."""
    path = path_of(submission)
    side = 1 if max(path, key=lambda s: abs(s.y)).y > 0 else -1
    for number, (x, y) in enumerate(CORNERS, 1):  # each on the rest of the path
        gap, at = min((math.dist((s.x, s.y), (x, side * y)), k) for k, s in enumerate(path))
        if gap > NEAR_M:
            expected = f"corner {number}, ({x}, {side * y}), within {NEAR_M} m"
            raise Wrong(expected, f"it comes within {gap:.2f} m", hint="angle = w * time")
        path = path[at:]


@check("S3", section="1", needs=drives, look="rostopic echo /odom/twist")
def rests(submission):
    """It rests at the end."""
    end = path_of(submission)[-1]
    if end.v or end.w:
        raise Wrong("a robot at rest", f"{end.v:.2f} m/s", hint="publish Twist() at the end")
