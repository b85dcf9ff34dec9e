"""Exercise 5: a program that drives turtle1 to a goal by its pose."""

import math
from dataclasses import dataclass
from typing import Tuple

from tutorial_course.common import moves, path_of, recorded, start_turtles

from tutorial_check.course import check
from tutorial_check.course_kit.client import Client
from tutorial_check.isolation.program import Ran
from tutorial_check.judge.scripts import crash

PACKAGE, PROGRAM = "turtlesim_cleaner", "gotogoal.py"
GOALS = ((9.0, 8.0), (2.0, 4.0), (8.0, 2.5))
TOLERANCE_M, MARGIN_M = 0.3, 0.05
LONGEST_S = 12.0
# As the page reads them, on standard input; and as parameters.
TYPED = 'printf "%s\\n%s\\n%s\\n" "$1" "$2" "$3" | "$4" "_x:=$1" "_y:=$2" "_tolerance:=$3"'


@dataclass(frozen=True)
class Drive:
    """The program, each pose of turtle1, and the topics of velocities."""

    program: Ran
    path: Tuple[Tuple[float, ...], ...]
    topics: Tuple[str, ...]

    def gaps(self, x, y):
        """Return the distance to the goal at each pose [m]."""
        return [math.dist(pose[:2], (x, y)) for pose in self.path]


def drive(ground, script, x: float, y: float) -> Drive:
    """Give the program a goal, and wait until the turtle rests."""
    with ground.stage() as stage:
        client = Client(stage)
        start_turtles(stage, client)
        numbers = map(str, (x, y, TOLERANCE_M))
        words = ["bash", "-c", TYPED, "bash", *numbers, *ground.command(PACKAGE, script)]
        program = stage.launch(words)
        stage.wait_for_start(lambda: program.ended or moves(client))
        topics = tuple(topic for topic in stage.call("state")[0] if "cmd_vel" in topic)
        stage.wait(lambda: not moves(client), LONGEST_S)
        return Drive(program.ran, path_of(client), topics)


@check("W11", "it reaches the goal", "5", look="rostopic echo /turtle1/pose")
def reaches(session):
    """Look how near each drive comes to its goal, and on which way."""
    for x, y in GOALS:
        found, blame = recorded(session, PACKAGE, PROGRAM, drive, x, y)
        expected = f"turtle1 comes within {TOLERANCE_M} m of ({x}, {y})"
        gaps = found.gaps(x, y)
        if not found.topics:
            raise crash(session, PACKAGE, found.program, expected)
        if found.topics != ("/turtle1/cmd_vel",):
            seen = f"it publishes on {', '.join(found.topics)}"
            raise blame.wrong("Publisher(", expected, seen, "turtle1/cmd_vel")
        near = next((k for k, gap in enumerate(gaps) if gap < TOLERANCE_M + MARGIN_M), None)
        if near is None:
            hint = "atan2(goal y - y, goal x - x) - theta is the angle to turn by"
            raise blame.wrong("atan2( angular.z", expected, f"only {min(gaps):.1f} m", hint)
        way = sum(math.dist(a[:2], b[:2]) for a, b in zip(found.path[:near], found.path[1:]))
        if way > 2.5 * gaps[0]:
            hint = "from -pi to pi it is the short way round; and no faster than it turns"
            raise blame.wrong("angular.z", f"a way of {gaps[0]:.0f} m or so", f"{way:.0f} m", hint)


@check("W12", "it rests there", "5", "W11", look="rostopic echo /turtle1/cmd_vel")
def stops(session):
    """Look at the end of each drive."""
    for x, y in GOALS:
        found, blame = recorded(session, PACKAGE, PROGRAM, drive, x, y)
        (*_, speed, turn), gap = found.path[-1], found.gaps(x, y)[-1]
        if speed or turn or gap > 2 * TOLERANCE_M:
            seen = f"{gap:.1f} m from it, {speed:.1f} m/s, {turn:.1f} rad/s"
            words, hint = "while publish(", "once it is there, publish Twist()"
            raise blame.wrong(words, f"at rest at ({x}, {y})", seen, hint)
