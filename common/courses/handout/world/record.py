"""Lesson 7: recorders of bumper.py, stop_before_wall.py and wander.py in a simulated room."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Dict, Optional, Sequence, Tuple

from tutorial_check import (
    BUMPER,
    TRUTH,
    Heard,
    PoseSample,
    Program,
    Ran,
    RosSession,
    SimulatedTurtleBot,
    Topics,
    Workspace,
)

from ..task import BEGINNER, CMD_VEL

SIDES = ("left", "center", "right")  # kobuki_msgs/BumperEvent: 0, 1, 2
ANSWER_S = 2.0  # for a line on the screen
STAMP = re.compile(r"\[[^\]]*\]")  # rospy.loginfo's prefix
# The wall is at x = 4 m; at 0.1 m/s the robot needs some seconds.
START_X_M = 2.9
WANDER_S, LONGEST_PUSH_S = 60.0, 1.0


@dataclass(frozen=True)
class Presses:
    """A run of bumper.py; each bumper is pressed once, up to the first that it does not show."""

    connected: bool
    program: Ran
    shown: Tuple[str, ...]  # what it displayed at each press
    subscribers: Topics
    types: Dict[str, str]


@dataclass(frozen=True)
class RoomDrive:
    """A program that drives the simulated robot in the room."""

    program: Ran
    path: Tuple[PoseSample, ...]
    bumps: Tuple[Heard, ...]  # (bumper, state) of each event
    ended_s: float  # when the last pose came, on the events' clock
    last_twist: Optional[Tuple[float, ...]]
    publishers: Topics
    types: Dict[str, str]


def wanted(number: int) -> str:
    """Return a regular expression for the line that shows the press of a bumper."""
    return rf"(?i){SIDES[number]}|\b{number}\b" + "|centre" * (number == 1)


def presses(workspace: Workspace, script: str) -> Presses:
    shown: list[str] = []
    with workspace.ros_session() as ros:
        ros.peer.advertise(BUMPER, "BumperEvent")
        program = ros.start(BEGINNER, script)
        connected = ros.meet(program, BUMPER) and not program.ended
        subscribers, types = ros.peer.state()[1], ros.peer.types()
        for number in range(len(SIDES)) if connected else ():
            shown.append(_press(ros, program, number))
            if not re.search(wanted(number), shown[-1]):
                break
    return Presses(connected, program.ran, tuple(shown), subscribers, types)


def _press(ros: RosSession, program: Program, number: int) -> str:
    """Press a bumper; return what the program then displays."""
    since = len(program.output)

    def shown() -> str:
        return STAMP.sub("", program.output[since:]).strip(": \n")

    ros.peer.send(BUMPER, (number, 1))
    ros.wait(lambda: program.ended or re.search(wanted(number), shown()), ANSWER_S)
    return shown()


def towards_the_wall(workspace: Workspace, script: str, speed: float) -> RoomDrive:
    """Record a drive until it rests. speed: its parameter ~speed [m/s]."""
    return _driven(workspace, script, f"_speed:={speed}")


def wandering(workspace: Workspace, script: str) -> RoomDrive:
    """Record a drive of a minute, or until it pushes for too long."""
    return _driven(workspace, script)


def _driven(workspace: Workspace, script: str, *arguments: str) -> RoomDrive:
    with workspace.ros_session() as ros:
        robot = SimulatedTurtleBot(ros, "_world:=room", f"_initial_x:={START_X_M}")
        ros.peer.listen(CMD_VEL, "Twist")
        program = ros.start(BEGINNER, script, *arguments)

        def now_s() -> float:
            return ros.peer.received(TRUTH, -1)[0][0]

        def pushes() -> bool:
            return longest_push_s(ros.peer.received(BUMPER), now_s()) > LONGEST_PUSH_S

        if arguments:
            robot.drive(program)
        else:
            ros.wait(lambda: program.ended or pushes(), WANDER_S)
        publishers, types = ros.peer.state()[0], ros.peer.types()
        path, bumps, ended_s = robot.path, ros.peer.received(BUMPER), now_s()
        last = ros.peer.received(CMD_VEL, -1)
    twist = last[0][2] if last else None
    return RoomDrive(program.ran, path, tuple(bumps), ended_s, twist, publishers, types)


def longest_push_s(events: Sequence[Heard], now_s: float) -> float:
    """Return the longest time [s] that a bumper was pressed."""
    pressed: set[float] = set()
    longest_s = began_s = 0.0
    for when_s, _, (number, state) in [*events, (now_s, "", (-1, 0))]:
        longest_s = max(longest_s, when_s - began_s if pressed else 0.0)
        began_s = began_s if pressed else when_s
        (pressed.add if state else pressed.discard)(number)
    return longest_s
