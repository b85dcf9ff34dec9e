"""Sections 4.2, 4.4 and 4.5: recordings, the simulated robot, a virtual joystick."""

from __future__ import annotations

import math
import statistics
from dataclasses import dataclass
from typing import Optional, Tuple

from tutorial_check import (
    ODOM,
    START_S,
    CannotCheck,
    Program,
    Ran,
    RosSession,
    SimulatedRobot,
    SubmissionFiles,
    Workspace,
)

from ..driving.evidence import ANGULAR, LINEAR
from ..driving.record import CMD_VEL, JOY, NEUTRAL
from ..task import LB, PACKAGE, Joy

FORWARDS, LEFT = 0.5, 0.8  # positions of the stick
SLOW_S = 4.0  # for a program that sleeps in its callback to answer what has gathered
REST_S = 0.5  # for a Twist at rest; not every program sends one
FASTEST = {LINEAR: 0.7, ANGULAR: math.pi}  # [m/s, rad/s] that the robot can do
LOOKS = 3  # at the robot's speed: a busy machine may stutter once
SAMPLES, SAMPLES_S = 40, 4.0  # one look takes so many messages of odometry, in at most so long


@dataclass(frozen=True)
class Bag:
    """A file of rosbag's."""

    error: str = ""  # why it cannot be read
    topics: Tuple[str, ...] = ()
    axes: Optional[int] = None  # the first Joy has so many; None: there is no Joy


@dataclass(frozen=True)
class Follow:
    """The simulated robot, driven forwards, then turned."""

    program: Ran
    ready: bool
    publishers: Tuple[str, ...]  # nodes that publish on /cmd_vel
    v: float = 0.0  # [m/s] of the robot
    w: float = 0.0  # [rad/s]
    told_v: Optional[float] = None  # what the last Twist said
    told_w: Optional[float] = None


@dataclass(frozen=True)
class Stick:
    """joy_node with a virtual F710, its switch at D, then Joys as at X."""

    program: Ran
    drives: bool
    v: float = 0.0  # linear.x of the last Twist [m/s]
    survives_eight_axes: bool = False


def held(submission: SubmissionFiles, left: float, forwards: float) -> Joy:
    """Return a Joy with LB held, as the student's task has it."""
    buttons = (*NEUTRAL[1][:LB], 1, *NEUTRAL[1][LB + 1 :])
    joy: Joy = submission.task.joy(((left, forwards, 0.0, 0.0, 0.0, 0.0), buttons))
    return joy


def rest(ros: RosSession, *topics: str, joys: str = JOY) -> None:
    """Send Joys at rest until a Twist answers, or for a while: some drive only after it."""
    ros.peer.stream(joys, [NEUTRAL], 20.0, True)
    ros.wait(lambda: any(ros.peer.count(topic) for topic in topics), REST_S)
    ros.peer.end_stream(joys)


def bag(workspace: Workspace, path: str) -> Bag:
    """Read a recording. path: within src."""
    import rosbag  # noqa: PLC0415

    try:
        with rosbag.Bag(str(workspace.source / path)) as opened:
            topics = tuple(opened.get_type_and_topic_info().topics)
            _, joy, _ = next(opened.read_messages(topics=[JOY, "joy"]), (None, None, None))
    except (rosbag.ROSBagException, OSError, ValueError, KeyError, EOFError) as error:
        return Bag(str(error) or type(error).__name__)
    return Bag("", topics, None if joy is None else len(getattr(joy, "axes", ())))


def follow(workspace: Workspace, script: str) -> Follow:
    with workspace.ros_session() as ros:
        ros.peer.listen(CMD_VEL, "Twist")
        ros.peer.advertise(JOY, "Joy")
        program = ros.start(PACKAGE, script)
        robot = SimulatedRobot(ros)
        ready = ros.wait(lambda: program.ended or ros.peer.listeners(JOY), START_S)
        rest(ros, CMD_VEL)
        if ready:  # its Publisher may be made in the callback
            ready = ros.wait(lambda: program.ended or ros.peer.publishers(CMD_VEL), START_S)
        ready = bool(ready) and not program.ended
        publishers = tuple(sorted(set(ros.peer.state()[0].get(workspace.task.topic(CMD_VEL), []))))
        if not ready or len(publishers) != 1:
            return Follow(program.ran, ready, publishers)
        (v, _), told_v = _driven(ros, robot, held(workspace, 0.0, FORWARDS), LINEAR)
        (_, w), told_w = _driven(ros, robot, held(workspace, LEFT, 0.0), ANGULAR)
        workspace.runner.end(program, 0.5)
    return Follow(program.ran, True, publishers, v, w, told_v, told_w)


def _speeds(ros: RosSession, robot: SimulatedRobot) -> tuple[float, float]:
    """Return (speed [m/s], rate of turn [rad/s]) of the robot in a while of even driving."""
    before = ros.peer.count(ODOM)
    ros.wait(lambda: ros.peer.count(ODOM) >= before + SAMPLES, SAMPLES_S)
    path = robot.path[before:]
    mean = statistics.fmean if path else lambda _: 0.0
    return mean([sample.v for sample in path]), mean([sample.w for sample in path])


def agree(measured: float, wanted: float, field: int) -> bool:
    """Return whether the robot does what a Twist says, as far as it can."""
    most = FASTEST[field]
    return wanted > 0 and abs(measured - min(wanted, most)) <= 0.1 * min(wanted, most)


def _driven(
    ros: RosSession, robot: SimulatedRobot, joy: object, field: int
) -> tuple[tuple[float, float], float | None]:
    """Return (the robot's speed and rate of turn, a field of the last Twist) in a drive."""
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


def stick(workspace: Workspace, script: str) -> Stick:
    with workspace.ros_session() as ros:
        ros.peer.listen(JOY, "Joy")
        ros.peer.listen(CMD_VEL, "Twist")
        gamepad, path = ros.plug_in()
        node = ros.start_ours("gamepad", "joy_node", f"_dev:={path}", "_autorepeat_rate:=20")
        program = ros.start(PACKAGE, script)

        def has_ended() -> bool:
            return program.ended or node.ended

        def drives() -> bool:
            return any(abs(speed) > 0.01 for speed in _speeds_told(ros))

        def is_up() -> bool:
            return bool(ros.peer.count(JOY) and ros.peer.publishers(CMD_VEL))

        ros.wait(lambda: is_up() or has_ended(), START_S)
        gamepad.push(0.0, 0.6)
        ros.wait(lambda: drives() or has_ended(), 3.0)
        if not ros.peer.count(JOY):
            raise CannotCheck(f"the joystick driver does not start: {node.output[-200:]}")
        if program.ended or not drives():
            return Stick(program.ran, drives=False)
        v = _speeds_told(ros)[-1]
        if v < 0:
            return Stick(program.ran, True, v)
        workspace.runner.end(node)
        survives = _survives_eight_axes(workspace, ros, program)
    return Stick(program.ran, True, v, survives)


def _speeds_told(ros: RosSession, since: int = 0) -> list[float]:
    return [value[0] for _, _, value in ros.peer.received(CMD_VEL, since)]


def _survives_eight_axes(workspace: Workspace, ros: RosSession, program: Program) -> bool:
    ros.peer.advertise(JOY, "Joy")
    # Our own Subscriber is one of them.
    ros.wait(lambda: ros.peer.listeners(JOY) > 1 or program.ended, START_S)

    def drive_backwards() -> None:
        """Only this does; once it shows, all that was sent before has been answered."""
        index = ros.peer.count(CMD_VEL)
        ros.peer.send(JOY, held(workspace, 0.1, -0.5))
        ros.wait(lambda: min(_speeds_told(ros, index), default=0.0) < 0 or program.ended, SLOW_S)

    drive_backwards()
    before, failed = ros.peer.count(CMD_VEL), program.output.count("Traceback")
    for k in range(5):
        axes = (0.1, 0.2 + 0.1 * k, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        joy = axes, (0,) * LB + (1,) + (0,) * 6
        ros.peer.send(JOY, workspace.task.joy(joy))
    drive_backwards()
    has_failed = program.ended or program.output.count("Traceback") != failed
    return not has_failed and max(_speeds_told(ros, before), default=0.0) > 0
