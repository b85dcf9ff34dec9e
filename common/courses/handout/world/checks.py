"""C35 to C37: our lesson 7, with bumper, laser and wandering in a simulated room."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Sequence

from tutorial_check import (
    BUMPER,
    PoseSample,
    Script,
    Submission,
    Topics,
    Wrong,
    check,
    crash,
    has_moved,
    must_pass,
    program_of,
)

from ..task import BEGINNER, CMD_VEL
from . import record
from .record import LONGEST_PUSH_S, SIDES, WANDER_S, RoomDrive

WALL_X_M, RADIUS_M = 4.0, 0.178
SPEEDS = (0.1, 0.3, 0.6)  # [m/s]
LEAST_GAP_M, MOST_GAP_M = 0.3, 0.5
LONGEST_STAND_S, STANDS_M = 20.0, 0.1  # a slow turn on the spot takes less
LEAST_WAY_M, LEAST_WIDTH_M = 3.0, 2.0


@check("C35", "the bumper is read", "7", needs="C2", look="rosrun beginner_tutorials bumper.py")
def reads_bumper(submission: Submission) -> str:
    script = program_of(submission, BEGINNER, "bumper.py")
    seen = submission.recording(record.presses, script)
    if not seen.connected:
        hint = "rospy.Subscriber('mobile_base/events/bumper', BumperEvent, callback)"
        expected, kind = f"it subscribes to {BUMPER}, until Ctrl-C", "kobuki_msgs/BumperEvent"
        wrong = crash(submission, BEGINNER, seen.program, expected, hint)
        raise _elsewhere(wrong, "subscribes to", BUMPER, kind, seen.subscribers, seen.types)
    for number, (side, shown) in enumerate(zip(SIDES, seen.shown)):
        # A traceback may also contain the number.
        if not re.search(record.wanted(number), re.split("bad callback|Traceback", shown)[0]):
            expected = f"the {side} bumper on the screen when it is pressed"
            hint = f"event.bumper is {number} (BumperEvent.{side.upper()}), event.state 1"
            if seen.program.ended or "Traceback" in shown:
                raise crash(submission, BEGINNER, seen.program, expected, hint)
            raise Wrong(expected, shown or "nothing", script, hint)
    if len(set(seen.shown)) < len(SIDES):
        hint = "event.bumper says which one: BumperEvent.LEFT, CENTER or RIGHT"
        expected = "a different line for each bumper"
        raise Wrong(expected, f"for all: {seen.shown[0]}", script, hint)
    return ", ".join(SIDES)


def _elsewhere(
    wrong: Wrong, does: str, topic: str, kind: str, topics: Topics, types: dict[str, str]
) -> Wrong:
    """Return the Wrong, with another topic of that type, if the program uses one."""
    for other in (name for name in topics if types.get(name) == kind and name != topic):
        wrong.seen = f"it {does} {other}, not {topic}"
        break
    return wrong


@check("C36", "it stops before a wall", "7", needs="C2",
       look="roslaunch fake_turtlebot_sim fake_turtlebot.launch world:=room;"
       " rosrun beginner_tutorials stop_before_wall.py _speed:=0.3")  # fmt: skip
def stops(submission: Submission) -> str:
    path = program_of(submission, BEGINNER, "stop_before_wall.py")
    script = Script(submission, BEGINNER, path)
    gaps = []
    for speed in SPEEDS:
        stop = Stop(script, speed, submission.recording(record.towards_the_wall, path, speed))
        diagnoses = (never_moved, program_failed, other_speed, no_zero, wrong_place)
        must_pass(diagnoses, stop)
        gaps.append(f"{stop.gap_m:.2f} m at {speed} m/s")
    return ", ".join(gaps)


@dataclass(frozen=True)
class Stop:
    """A drive towards the wall."""

    script: Script
    speed: float  # [m/s] that it should drive
    drive: RoomDrive

    @property
    def gap_m(self) -> float:
        """Its distance from the wall at the end."""
        return WALL_X_M - RADIUS_M - self.drive.path[-1].x

    @property
    def expected(self) -> str:
        return f"a stop {LEAST_GAP_M} to {MOST_GAP_M} m before the wall, with _speed:={self.speed}"

    @property
    def rests(self) -> bool:
        return not self.drive.bumps and not self.drive.path[-1].v

    @property
    def is_right(self) -> bool:
        return self.rests and LEAST_GAP_M <= self.gap_m <= MOST_GAP_M


def never_moved(stop: Stop) -> Wrong | None:
    drive = stop.drive
    if has_moved(drive.path):
        return None
    expected = f"the robot drives towards the wall with _speed:={stop.speed}"
    hint = "it publishes on cmd_vel for each LaserScan on scan"
    wrong = stop.script.crash(drive.program, expected, hint)
    kind = "geometry_msgs/Twist"
    return _elsewhere(wrong, "publishes on", CMD_VEL, kind, drive.publishers, drive.types)


def program_failed(stop: Stop) -> Wrong | None:
    program = stop.drive.program
    return stop.script.crash(program, stop.expected) if program.code else None


def other_speed(stop: Stop) -> Wrong | None:
    fastest = max(sample.v for sample in stop.drive.path)
    if abs(fastest - stop.speed) <= 0.2 * stop.speed:
        return None
    expected, hint = f"{stop.speed} m/s with _speed:={stop.speed}", "is the speed [m/s]"
    hint = f'rospy.get_param("~speed", 0.3) {hint}'
    return Wrong(expected, f"{fastest:.2f} m/s", stop.script.where, hint)


def no_zero(stop: Stop) -> Wrong | None:
    if stop.is_right or not stop.rests or not any(stop.drive.last_twist or ()):
        return None
    seen = f"{stop.gap_m:.2f} m: no zero came, and the base stopped 0.6 s after the last velocity"
    return Wrong(stop.expected, seen, stop.script.where, "near the wall publish a Twist of zero")


def wrong_place(stop: Stop) -> Wrong | None:
    if stop.is_right:
        return None
    seen = f"{stop.gap_m:.2f} m"
    seen = f"it still drives, {seen} before it" if stop.drive.path[-1].v else seen
    seen = "it drives into the wall" if stop.drive.bumps else seen
    hint = "ranges begin at the camera, 0.087 m behind the middle of the robot, whose radius is"
    hint += f" {RADIUS_M} m; too near is -inf, or NaN"
    return Wrong(stop.expected, seen, stop.script.where, hint)


@check("C37", "it wanders", "7", needs="C2",
       look="roslaunch fake_turtlebot_sim fake_turtlebot.launch world:=room;"
       " rosrun beginner_tutorials wander.py")  # fmt: skip
def wanders(submission: Submission) -> str:
    script = program_of(submission, BEGINNER, "wander.py")
    drive = submission.recording(record.wandering, script)
    expected = f"it drives about for {WANDER_S:.0f} s"
    expected += f" and never pushes for {LONGEST_PUSH_S:.0f} s or longer"
    if drive.program.ended:
        hint = "does it loop, or rospy.spin()?"
        raise crash(submission, BEGINNER, drive.program, expected, hint)
    push_s = record.longest_push_s(drive.bumps, drive.ended_s)
    if push_s > LONGEST_PUSH_S:
        hint = "with BumperEvent.PRESSED go back: linear.x < 0; no scan shows what is beside it"
        seen = f"it pushed for {push_s:.1f} s at ({drive.path[-1].x:.1f}, {drive.path[-1].y:.1f})"
        raise Wrong(expected, seen, script, hint)
    path = [(sample.x, sample.y) for sample in drive.path]
    way_m = sum(math.dist(a, b) for a, b in zip(path, path[1:]))
    width_m = max(max(places) - min(places) for places in zip(*path))
    if way_m < LEAST_WAY_M or width_m < LEAST_WIDTH_M:
        hint = "ahead while min(scan.ranges) is large enough, else turn until it is"
        raise Wrong(expected, f"{way_m:.1f} m in a place {width_m:.1f} m wide", script, hint)
    stand_s = longest_stand_s(drive.path)
    if stand_s > LONGEST_STAND_S:
        hint = "where nothing is free ahead, turn until min(scan.ranges) is large again"
        raise Wrong(expected, f"it did not move for {stand_s:.0f} s", script, hint)
    return f"{way_m:.1f} m"


def longest_stand_s(samples: Sequence[PoseSample]) -> float:
    """Return the longest time [s] that the robot stayed within STANDS_M of a place."""
    longest_s, since = 0.0, samples[0]
    for sample in samples:
        if math.dist((sample.x, sample.y), (since.x, since.y)) > STANDS_M:
            since = sample
        longest_s = max(longest_s, sample.at_s - since.at_s)
    return longest_s
