"""Section 4.4: a recorder that drives the simulated robot forwards, then turns it."""

from __future__ import annotations

import math
import statistics
from dataclasses import dataclass
from typing import Optional, Tuple

from tutorial_check import ODOM, START_S, Ran, RosSession, SimulatedTurtleBot, Workspace

from ..driving.evidence import ANGULAR, LINEAR
from ..driving.record import rest
from ..task import CMD_VEL, JOY, PACKAGE

FORWARDS, LEFT = 0.5, 0.8  # positions of the stick
FASTEST = {LINEAR: 0.7, ANGULAR: math.pi}  # [m/s, rad/s] limits of the robot
LOOKS = 3  # measurements of the speed, because a busy machine may stutter
SAMPLES, SAMPLES_S = 40, 4.0  # messages of odometry for a measurement, and its timeout


@dataclass(frozen=True)
class Follow:
    """A run with the simulated robot, driven forwards, then turned."""

    program: Ran
    ready: bool
    publishers: Tuple[str, ...]  # nodes that publish on /cmd_vel
    v: float = 0.0  # [m/s] of the robot
    w: float = 0.0  # [rad/s]
    told_v: Optional[float] = None  # from the last Twist
    told_w: Optional[float] = None


def follow(workspace: Workspace, script: str) -> Follow:
    with workspace.ros_session() as ros:
        ros.peer.listen(CMD_VEL, "Twist")
        ros.peer.advertise(JOY, "Joy")
        program = ros.start(PACKAGE, script)
        robot = SimulatedTurtleBot(ros)
        ready = ros.wait(lambda: program.ended or ros.peer.listeners(JOY), START_S)
        rest(ros, CMD_VEL)
        if ready:  # it may create its Publisher in the callback
            ready = ros.wait(lambda: program.ended or ros.peer.publishers(CMD_VEL), START_S)
        ready = bool(ready) and not program.ended
        publishers = tuple(sorted(set(ros.peer.state()[0].get(workspace.task.topic(CMD_VEL), []))))
        if not ready or len(publishers) != 1:
            return Follow(program.ran, ready, publishers)
        (v, _), told_v = _driven(ros, robot, workspace.task.held(0.0, FORWARDS), LINEAR)
        (_, w), told_w = _driven(ros, robot, workspace.task.held(LEFT, 0.0), ANGULAR)
        workspace.runner.end(program, 0.5)
    return Follow(program.ran, True, publishers, v, w, told_v, told_w)


def _speeds(ros: RosSession, robot: SimulatedTurtleBot) -> tuple[float, float]:
    """Return the robot's mean (speed [m/s], rate of turn [rad/s])."""
    before = ros.peer.count(ODOM)
    ros.wait(lambda: ros.peer.count(ODOM) >= before + SAMPLES, SAMPLES_S)
    path = robot.path[before:]
    mean = statistics.fmean if path else lambda _: 0.0
    return mean([sample.v for sample in path]), mean([sample.w for sample in path])


def agree(measured: float, wanted: float, field: int) -> bool:
    """Return whether the robot follows a Twist, up to its limits."""
    most = FASTEST[field]
    return wanted > 0 and abs(measured - min(wanted, most)) <= 0.1 * min(wanted, most)


def _driven(
    ros: RosSession, robot: SimulatedTurtleBot, joy: object, field: int
) -> tuple[tuple[float, float], float | None]:
    """Drive; return (the robot's speed and rate of turn, a field of the last Twist)."""
    before = ros.peer.count(CMD_VEL)

    def wanted() -> list[float]:
        return [value[field] for _, _, value in ros.peer.received(CMD_VEL, before)]

    ros.peer.stream(JOY, [joy], 20.0, True)
    ros.wait(lambda: any(abs(value) > 0.01 for value in wanted()), 3.0)
    moving = ros.peer.count(ODOM)
    ros.wait(lambda: ros.peer.count(ODOM) > moving + 8, 3.0)
    for _ in range(LOOKS):
        speeds, last = _speeds(ros, robot), next(iter(wanted()[-1:]), None)
        if last is not None and agree(speeds[field == ANGULAR], last, field):
            break
    ros.peer.end_stream(JOY)
    return speeds, last
