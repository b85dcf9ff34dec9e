"""Sections 4.2, 4.4 and 4.5: recordings, the simulated robot, a virtual joystick."""

from __future__ import annotations

import math
import statistics
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Optional, Tuple

from tutorial_check.processes.errors import CannotCheck
from tutorial_check.processes.program import Program, Ran
from tutorial_check.recording.ground import Ground
from tutorial_check.recording.ros_session import START_S, Stage
from tutorial_check.recording.simulated_robot import ODOM, SimulatedRobot
from tutorial_check.submission.files import Session

from ..driving.evidence import ANGULAR, LINEAR
from ..driving.record import CMD_VEL, JOY, NEUTRAL
from ..task import LB, PACKAGE, Joy

if TYPE_CHECKING:  # judges need no gamepad
    from tutorial_check.recording.gamepad import Gamepad

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


def held(session: Session, left: float, forwards: float) -> Joy:
    """Return a Joy with LB held, as the student's task has it."""
    buttons = (*NEUTRAL[1][:LB], 1, *NEUTRAL[1][LB + 1 :])
    joy: Joy = session.task.joy(((left, forwards, 0.0, 0.0, 0.0, 0.0), buttons))
    return joy


def rest(stage: Stage, *topics: str, joys: str = JOY) -> None:
    """Send Joys at rest until a Twist answers, or for a while: some drive only after it."""
    stage.driver.stream(joys, [NEUTRAL], 20.0, True)
    stage.wait(lambda: any(stage.driver.count(topic) for topic in topics), REST_S)
    stage.driver.end_stream(joys)


def bag(ground: Ground, path: str) -> Bag:
    """Read a recording. path: within src."""
    import rosbag  # noqa: PLC0415

    try:
        with rosbag.Bag(str(ground.source / path)) as opened:
            topics = tuple(opened.get_type_and_topic_info().topics)
            _, joy, _ = next(opened.read_messages(topics=[JOY, "joy"]), (None, None, None))
    except (rosbag.ROSBagException, OSError, ValueError, KeyError, EOFError) as error:
        return Bag(str(error) or type(error).__name__)
    return Bag("", topics, None if joy is None else len(getattr(joy, "axes", ())))


def follow(ground: Ground, script: str) -> Follow:
    with ground.stage() as stage:
        stage.driver.listen(CMD_VEL, "Twist")
        stage.driver.advertise(JOY, "Joy")
        program = stage.start(PACKAGE, script)
        robot = SimulatedRobot(stage)
        ready = stage.wait(lambda: program.ended or stage.driver.listeners(JOY), START_S)
        rest(stage, CMD_VEL)
        if ready:  # its Publisher may be made in the callback
            ready = stage.wait(lambda: program.ended or stage.driver.publishers(CMD_VEL), START_S)
        ready = bool(ready) and not program.ended
        publishers = tuple(sorted(set(stage.driver.state()[0].get(ground.task.topic(CMD_VEL), []))))
        if not ready or len(publishers) != 1:
            return Follow(program.ran, ready, publishers)
        (v, _), told_v = _driven(stage, robot, held(ground, 0.0, FORWARDS), LINEAR)
        (_, w), told_w = _driven(stage, robot, held(ground, LEFT, 0.0), ANGULAR)
        ground.runner.end(program, 0.5)
    return Follow(program.ran, True, publishers, v, w, told_v, told_w)


def _speeds(stage: Stage, robot: SimulatedRobot) -> tuple[float, float]:
    """Return (speed [m/s], rate of turn [rad/s]) of the robot in a while of even driving."""
    before = stage.driver.count(ODOM)
    stage.wait(lambda: stage.driver.count(ODOM) >= before + SAMPLES, SAMPLES_S)
    path = robot.path[before:]
    mean = statistics.fmean if path else lambda _: 0.0
    return mean([sample.v for sample in path]), mean([sample.w for sample in path])


def agree(measured: float, wanted: float, field: int) -> bool:
    """Return whether the robot does what a Twist says, as far as it can."""
    most = FASTEST[field]
    return wanted > 0 and abs(measured - min(wanted, most)) <= 0.1 * min(wanted, most)


def _driven(
    stage: Stage, robot: SimulatedRobot, joy: object, field: int
) -> tuple[tuple[float, float], float | None]:
    """Return (the robot's speed and rate of turn, a field of the last Twist) in a drive."""
    before = stage.driver.count(CMD_VEL)

    def wanted() -> list[float]:
        return [value[field] for _, _, value in stage.driver.received(CMD_VEL, before)]

    stage.driver.stream(JOY, [joy], 20.0, True)
    stage.wait(lambda: any(abs(value) > 0.01 for value in wanted()), 3.0)
    moving = stage.driver.count(ODOM)
    stage.wait(lambda: stage.driver.count(ODOM) > moving + 8, 3.0)
    for _ in range(LOOKS):
        speeds, last = _speeds(stage, robot), next(iter(wanted()[-1:]), None)
        if last is not None and agree(speeds[field == ANGULAR], last, field):
            break
    stage.driver.end_stream(JOY)
    return speeds, last


def plug_in(ground: Ground, stage: Stage, device: str = "/dev/input/js0") -> tuple[Gamepad, Path]:
    """Make a virtual F710 behind a device, or a FIFO where that cannot be; (Gamepad, path)."""
    from tutorial_check.recording.gamepad import Gamepad  # noqa: PLC0415

    path = Path(device) if ground.order.apart else ground.folder / "js0"
    gamepad = stage.help(lambda: Gamepad(str(path), ground.task.joy)).remote
    gamepad.connected()
    return gamepad, path


def stick(ground: Ground, script: str) -> Stick:
    with ground.stage() as stage:
        stage.driver.listen(JOY, "Joy")
        stage.driver.listen(CMD_VEL, "Twist")
        gamepad, path = plug_in(ground, stage)
        node = stage.start_ours("gamepad", "joy_node", f"_dev:={path}", "_autorepeat_rate:=20")
        program = stage.start(PACKAGE, script)

        def has_ended() -> bool:
            return program.ended or node.ended

        def drives() -> bool:
            return any(abs(speed) > 0.01 for speed in _speeds_told(stage))

        def is_up() -> bool:
            return bool(stage.driver.count(JOY) and stage.driver.publishers(CMD_VEL))

        stage.wait(lambda: is_up() or has_ended(), START_S)
        gamepad.push(0.0, 0.6)
        stage.wait(lambda: drives() or has_ended(), 3.0)
        if not stage.driver.count(JOY):
            raise CannotCheck(f"the joystick driver does not start: {node.output[-200:]}")
        if program.ended or not drives():
            return Stick(program.ran, drives=False)
        v = _speeds_told(stage)[-1]
        if v < 0:
            return Stick(program.ran, True, v)
        ground.runner.end(node)
        survives = _survives_eight_axes(ground, stage, program)
    return Stick(program.ran, True, v, survives)


def _speeds_told(stage: Stage, since: int = 0) -> list[float]:
    return [value[0] for _, _, value in stage.driver.received(CMD_VEL, since)]


def _survives_eight_axes(ground: Ground, stage: Stage, program: Program) -> bool:
    stage.driver.advertise(JOY, "Joy")
    # Our own Subscriber is one of them.
    stage.wait(lambda: stage.driver.listeners(JOY) > 1 or program.ended, START_S)

    def drive_backwards() -> None:
        """Only this does; once it shows, all that was sent before has been answered."""
        index = stage.driver.count(CMD_VEL)
        stage.driver.send(JOY, held(ground, 0.1, -0.5))
        stage.wait(
            lambda: min(_speeds_told(stage, index), default=0.0) < 0 or program.ended, SLOW_S
        )

    drive_backwards()
    before, failed = stage.driver.count(CMD_VEL), program.output.count("Traceback")
    for k in range(5):
        axes = (0.1, 0.2 + 0.1 * k, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        joy = axes, (0,) * LB + (1,) + (0,) * 6
        stage.driver.send(JOY, ground.task.joy(joy))
    drive_backwards()
    has_failed = program.ended or program.output.count("Traceback") != failed
    return not has_failed and max(_speeds_told(stage, before), default=0.0) > 0
