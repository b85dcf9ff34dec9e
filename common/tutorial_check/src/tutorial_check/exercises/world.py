"""C35 to C37: the seventh lesson, ours: bumper, laser and wandering in a simulated room."""

from __future__ import annotations

import math
import re
from functools import partial
from typing import Any, Sequence

from tutorial_check.box import Program
from tutorial_check.course import check
from tutorial_check.exercises.driving import CMD_VEL
from tutorial_check.exercises.talking import PACKAGE
from tutorial_check.model import Wrong
from tutorial_check.scripts import crash, program_of
from tutorial_check.session import Session
from tutorial_check.simulated_robot import BUMPER, TRUTH, Sample, SimulatedRobot
from tutorial_check.stage import Stage

PUBLISHES, SUBSCRIBES = "publishes on", "subscribes to"
SIDES = ("left", "center", "right")  # kobuki_msgs/BumperEvent: 0, 1, 2
ANSWER_S = 2.0  # for a line on the screen
STAMP = re.compile(r"\[[^\]]*\]")  # what rospy.loginfo puts before a text
# Towards the wall of the room at x = 4 m, from where 0.1 m/s takes some seconds.
START_X, WALL_X, RADIUS_M = 2.9, 4.0, 0.178
SPEEDS = (0.1, 0.3, 0.6)  # [m/s]
LEAST_GAP_M, MOST_GAP_M = 0.3, 0.5
WANDER_S, LONGEST_PUSH_S = 60.0, 1.0
LONGEST_STAND_S, STANDS_M = 20.0, 0.1  # within so few metres; a slow turn on the spot is shorter
LEAST_WAY_M, LEAST_WIDTH_M = 3.0, 2.0


@check("C35", "the bumper is read", "7", "C2", look="rosrun beginner_tutorials bumper.py")
def reads_bumper(session: Session) -> str:
    """Press each bumper, and look for its name, or its number, on the screen."""
    script = program_of(session, PACKAGE, "bumper.py")
    with session.stage() as stage:
        stage.call("advertise", BUMPER, "BumperEvent")
        program = stage.start(PACKAGE, script)
        if not stage.meet(program, BUMPER) or program.ended:
            hint = "rospy.Subscriber('mobile_base/events/bumper', BumperEvent, callback)"
            expected = f"it subscribes to {BUMPER}, until Ctrl-C"
            wrong = crash(session, PACKAGE, program, expected, hint)
            raise _elsewhere(wrong, stage, SUBSCRIBES, BUMPER, "kobuki_msgs/BumperEvent")
        lines = set()
        for number, side in enumerate(SIDES):
            wanted = rf"(?i){side}|\b{number}\b" + "|centre" * (number == 1)
            shown = partial(_shown, program, len(program.output))
            stage.call("send", BUMPER, (number, 1))
            stage.wait(lambda: program.ended or re.search(wanted, shown()), ANSWER_S)  # noqa: B023
            if not re.search(wanted, shown()):
                expected = f"the {side} bumper on the screen when it is pressed"
                hint = f"event.bumper is {number} (BumperEvent.{side.upper()}), event.state 1"
                if program.ended or "Traceback" in shown():
                    raise crash(session, PACKAGE, program, expected, hint)
                raise Wrong(expected, shown() or "nothing", script, hint)
            lines.add(shown())
    if len(lines) < len(SIDES):
        hint = "event.bumper says which one: BumperEvent.LEFT, CENTER or RIGHT"
        raise Wrong("a different line for each bumper", f"for all: {lines.pop()}", script, hint)
    return ", ".join(SIDES)


def _elsewhere(wrong: Wrong, stage: Stage, does: str, topic: str, kind: str) -> Wrong:
    """Return the Wrong; where the program uses another topic of that type, that was seen."""
    topics, types = stage.call("state")[does == SUBSCRIBES], stage.call("types")
    others = [one for one in topics if types.get(one) == kind and one != topic]
    if others:
        wrong.seen = f"it {does} {others[0]}, not {topic}"
    return wrong


def _shown(program: Program, since: int) -> str:
    """Return what a program has displayed since it had printed so many characters."""
    return STAMP.sub("", program.output[since:]).strip(": \n")


@check("C36", "it stops before a wall", "7", "C2",
       look="roslaunch fake_turtlebot_sim fake_turtlebot.launch world:=room;"
       " rosrun beginner_tutorials stop_before_wall.py _speed:=0.3")  # fmt: skip
def stops(session: Session) -> str:
    script = program_of(session, PACKAGE, "stop_before_wall.py")
    gaps = [_gap(session, script, speed) for speed in SPEEDS]
    return ", ".join(f"{gap:.2f} m at {speed} m/s" for gap, speed in zip(gaps, SPEEDS))


def _gap(session: Session, script: str, speed: float) -> float:
    """Return how far [m] before the wall it stops. Raises Wrong."""
    with session.stage() as stage:
        robot = SimulatedRobot(stage, "_world:=room", f"_initial_x:={START_X}")
        stage.call("listen", CMD_VEL, "Twist")
        program = stage.start(PACKAGE, script, f"_speed:={speed}")
        try:
            path = robot.drive(
                session, PACKAGE, program,
                f"the robot drives towards the wall with _speed:={speed}",
                "it publishes on cmd_vel for each LaserScan on scan",
            )  # fmt: skip
        except Wrong as wrong:
            raise _elsewhere(wrong, stage, PUBLISHES, CMD_VEL, "geometry_msgs/Twist") from None
        pressed, last = bool(robot.bumps), stage.call("heard", CMD_VEL, -1)
        failed = program.ended and program.process.returncode
    fastest, gap = max(sample.v for sample in path), WALL_X - RADIUS_M - path[-1].x
    expected = f"a stop {LEAST_GAP_M} to {MOST_GAP_M} m before the wall, with _speed:={speed}"
    if failed:
        raise crash(session, PACKAGE, program, expected)
    if abs(fastest - speed) > 0.2 * speed:
        hint = 'rospy.get_param("~speed", 0.3) is the speed [m/s]'
        raise Wrong(f"{speed} m/s with _speed:={speed}", f"{fastest:.2f} m/s", script, hint)
    if not pressed and not path[-1].v and LEAST_GAP_M <= gap <= MOST_GAP_M:
        return gap
    if not pressed and not path[-1].v and last and any(last[0][2]):
        seen = f"{gap:.2f} m: no zero came, and the base stopped 0.6 s after the last velocity"
        raise Wrong(expected, seen, script, "near the wall publish a Twist of zero")
    seen = f"it still drives, {gap:.2f} m before it" if path[-1].v else f"{gap:.2f} m"
    seen = "it drives into the wall" if pressed else seen
    hint = "ranges begin at the camera, 0.087 m behind the middle of the robot, whose radius is"
    raise Wrong(expected, seen, script, f"{hint} {RADIUS_M} m; too near is -inf, or NaN")


@check("C37", "it wanders", "7", "C2",
       look="roslaunch fake_turtlebot_sim fake_turtlebot.launch world:=room;"
       " rosrun beginner_tutorials wander.py")  # fmt: skip
def wanders(session: Session) -> str:
    script = program_of(session, PACKAGE, "wander.py")
    with session.stage() as stage:
        robot = SimulatedRobot(stage, "_world:=room", f"_initial_x:={START_X}")
        program = stage.start(PACKAGE, script)

        def longest_push() -> float:
            return push_of(stage.call("heard", BUMPER), stage.call("heard", TRUTH)[-1][0])

        stage.wait(lambda: program.ended or longest_push() > LONGEST_PUSH_S, WANDER_S)
        samples = robot.path
        push, ended = longest_push(), program.ended
    path = [(sample.x, sample.y) for sample in samples]
    way = sum(math.dist(a, b) for a, b in zip(path, path[1:]))
    width = max(max(places) - min(places) for places in zip(*path))
    expected = f"it drives about for {WANDER_S:.0f} s and never pushes for {LONGEST_PUSH_S:.0f} s or longer"
    if ended:
        raise crash(session, PACKAGE, program, expected, "does it loop, or rospy.spin()?")
    if push > LONGEST_PUSH_S:
        hint = "with BumperEvent.PRESSED go back: linear.x < 0; what is beside it no scan shows"
        x, y = path[-1]
        raise Wrong(expected, f"it pushed for {push:.1f} s at ({x:.1f}, {y:.1f})", script, hint)
    if way < LEAST_WAY_M or width < LEAST_WIDTH_M:
        hint = "ahead while min(scan.ranges) is large enough, else turn until it is"
        raise Wrong(expected, f"{way:.1f} m in a place {width:.1f} m wide", script, hint)
    stand = stand_of(samples)
    if stand > LONGEST_STAND_S:
        hint = "where nothing is free ahead, turn until min(scan.ranges) is large again"
        raise Wrong(expected, f"it stood for {stand:.0f} s", script, hint)
    return f"{way:.1f} m"


def stand_of(samples: Sequence[Sample]) -> float:
    """Return how long [s] the robot stayed within STANDS_M of a place, at most."""
    longest, since = 0.0, samples[0]
    for one in samples:
        if math.dist((one.x, one.y), (since.x, since.y)) > STANDS_M:
            since = one
        longest = max(longest, one.at_s - since.at_s)
    return longest


def push_of(events: Any, now: float) -> float:
    """Return how long [s] a bumper was pressed at a time, at most; events: heard of BUMPER."""
    pressed: set[int] = set()
    longest = began = 0.0
    for when, _, (number, state) in [*events, (now, 0, (-1, 0))]:
        longest = max(longest, when - began if pressed else 0.0)
        began = began if pressed else when
        (pressed.add if state else pressed.discard)(number)
    return longest
