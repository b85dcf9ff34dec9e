"""The worked example of COURSES.md: a program that drives a square of 1 m, and rests."""

import math

from tutorial_check.course import check
from tutorial_check.model import Wrong
from tutorial_check.scripts import program_of
from tutorial_check.simulated_robot import SimulatedRobot

CORNERS = [(1, 0), (1, 1), (0, 1), (0, 0)]  # [m], to the left; to the right the y are negative
NEAR_M = 0.1
LONGEST_S = 25.0


def drive(session):
    """Return the path of the robot; driven once, for both checks."""
    with session.stage() as stage:
        robot = SimulatedRobot(stage)
        program = stage.start("square", "scripts/square.py")
        return robot.drive(session, "square", program, longest_s=LONGEST_S)


@check("S1", "it drives", "1", look="rosrun square square.py")
def drives(session):
    """Find the program and let it drive."""
    program_of(session, "square", "square.py")
    path = session.run("drive", lambda: drive(session))
    return f"for {path[-1].at_s - path[0].at_s:.0f} s"


@check("S2", "it passes the corners", "1", "S1", look="rostopic echo /odom")
def passes_corners(session):
    """Look for each corner on the way that is left."""
    path = session.run("drive", lambda: drive(session))
    side = 1 if max(path, key=lambda s: abs(s.y)).y > 0 else -1
    for number, (x, y) in enumerate(CORNERS, 1):
        gap, at = min((math.dist((s.x, s.y), (x, side * y)), k) for k, s in enumerate(path))
        if gap > NEAR_M:
            expected = f"corner {number}, ({x}, {side * y}), within {NEAR_M} m"
            raise Wrong(expected, f"it comes within {gap:.2f} m", hint="angle = w * time")
        path = path[at:]


@check("S3", "it rests at the end", "1", "S1", look="rostopic echo /odom/twist")
def rests(session):
    """Look at the last sample."""
    end = session.run("drive", lambda: drive(session))[-1]
    if end.v or end.w:
        raise Wrong("a robot at rest", f"{end.v:.2f} m/s", hint="publish Twist() at the end")
