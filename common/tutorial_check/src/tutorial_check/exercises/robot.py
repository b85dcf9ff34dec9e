"""C11, C19, C20: a recording, the simulated robot, the joystick."""

from __future__ import annotations

import math
import shlex
import statistics
from pathlib import Path
from typing import Any

from tutorial_check.box import Program
from tutorial_check.course import check
from tutorial_check.exercises.driving import CMD_VEL, JOY, NEUTRAL
from tutorial_check.exercises.joy2twist import main_script
from tutorial_check.exercises.joystick_task import LB, PACKAGE
from tutorial_check.exercises.mapping import ANGULAR, LINEAR
from tutorial_check.exercises.pad import Pad
from tutorial_check.model import CannotCheck, Note, Wrong
from tutorial_check.scripts import crash
from tutorial_check.session import Session
from tutorial_check.simulated_robot import ODOM, SimulatedRobot
from tutorial_check.stage import START_S, Stage

FORWARDS, LEFT = 0.5, 0.8  # positions of the stick
COPY_BAG = 'cp "$(rospack find gamepad)/bag/joy.bag" .'
SLOW_S = 4.0  # for a program that sleeps in its callback to answer what has gathered
REST_S = 0.5  # for a Twist at rest; not every program sends one
FASTEST = {LINEAR: 0.7, ANGULAR: math.pi}  # [m/s, rad/s] that the robot can do
LOOKS = 3  # at the robot's speed: a busy machine may stutter once
SAMPLES, SAMPLES_S = 40, 4.0  # of odometry for one look, 50 a second; and how long they may take


def held(session: Session, left: float, forwards: float) -> Any:
    """Return a Joy with LB held, as the student's task has it."""
    buttons = (*NEUTRAL[1][:LB], 1, *NEUTRAL[1][LB + 1 :])
    return session.task.joy(((left, forwards, 0.0, 0.0, 0.0, 0.0), buttons))


def rest(stage: Stage, *topics: str, joys: str = JOY) -> None:
    """Send Joys at rest until a Twist answers, or for a while: some programs drive only after it.

    A Subscriber with queue_size=1 that is still busy may lose one; so, several.
    """
    stage.call("stream", joys, [NEUTRAL], 20.0, True)
    stage.wait(lambda: any(stage.call("count", topic) for topic in topics), REST_S)
    stage.call("end_stream", joys)


class NoJoy(Wrong):
    """A recording of something else."""


@check("C11", "a recording of /joy", "4.2", look="rosbag info joy.bag")
def recording(session: Session) -> Note | str | None:
    """Take the first of the recordings that can be played to joy2twist; there may be others."""
    ours = session.package(PACKAGE)
    bags = session.source.rglob("*.bag") if ours or session.package("beginner_tutorials") else []
    bags = sorted(bags, key=lambda each: (each.name != "joy.bag", each))
    if not bags:
        seen = "no bag in the workspace; look at /joy with rosbag play and rostopic echo /joy"
        return Note(seen, hint=f"the recording: {COPY_BAG}", empty=True)
    spoilt: list[Wrong] = []
    others: list[Wrong] = []
    for bag in bags:
        name = str(bag.relative_to(session.source))
        try:
            return f"{name}: {', '.join(check_recording(bag, name))}"
        except Wrong as wrong:
            meant = bag.name == "joy.bag" or (ours and ours.folder in bag.parents)
            (spoilt if meant and not isinstance(wrong, NoJoy) else others).append(wrong)
    if spoilt:
        raise spoilt[0]
    return Note(f"no recording of /joy; {others[0].seen}", others[0].where, others[0].hint, True)


def check_recording(bag: Any, name: str) -> Any:
    """Return the topics of a recording that can be played to joy2twist. name: as the student knows it. Raises Wrong."""
    import rosbag  # noqa: PLC0415

    try:
        with rosbag.Bag(str(bag)) as opened:
            topics = opened.get_type_and_topic_info().topics
            _, joy, _ = next(opened.read_messages(topics=[JOY, "joy"]), (None, None, None))
    except (rosbag.ROSBagException, OSError, ValueError, KeyError, EOFError) as error:
        seen = str(error) or type(error).__name__
        hint = f"copy it anew: {COPY_BAG[:-1]}{shlex.quote(str(bag))}"
        raise Wrong("a recording that rosbag can read", seen, name, hint) from None
    if joy is None:
        seen = f"topics: {', '.join(topics) or 'none'}"
        hint = f"rosbag record /joy; or copy ours: {COPY_BAG}"
        raise NoJoy("sensor_msgs/Joy on /joy", seen, name, hint)
    axes = len(getattr(joy, "axes", ()))
    if axes < 2:
        raise Wrong("at least two axes", f"{axes}", name)
    return list(topics)


def _speeds(stage: Stage, robot: SimulatedRobot) -> tuple[float, float]:
    """Return (speed [m/s], rate of turn [rad/s]) of the robot in a while of even driving."""
    begun = stage.call("count", ODOM)
    stage.wait(lambda: stage.call("count", ODOM) >= begun + SAMPLES, SAMPLES_S)
    path = robot.path[begun:]
    mean = statistics.fmean if path else lambda _: 0.0
    return mean([sample.v for sample in path]), mean([sample.w for sample in path])


def _agree(measured: float, wanted: float, most: float) -> bool:
    return wanted > 0 and abs(measured - min(wanted, most)) <= 0.1 * min(wanted, most)


@check("C19", "the simulated robot follows", "4.4", "C16",
       look="rostopic echo /odom/pose/pose/position")  # fmt: skip
def simulated(session: Session) -> Note | str | None:
    """Drive the simulated robot forwards, then turn it, and compare with the Twists."""
    script = main_script(session)
    with session.stage() as stage:
        program, robot = _beside_the_robot(session, stage, script)
        (v, _), told_v = _driven(stage, robot, held(session, 0.0, FORWARDS), LINEAR)
        (_, w), told_w = _driven(stage, robot, held(session, LEFT, 0.0), ANGULAR)
        session.box.end(program, 0.5)
    if told_v is None or told_w is None:
        raise Wrong("Twists that the robot obeys", "none came")
    seen = f"{v:.2f} m/s, then {w:.2f} rad/s"
    if not _agree(v, told_v, FASTEST[LINEAR]) or not _agree(w, told_w, FASTEST[ANGULAR]):
        expected = f"forwards with {told_v:.2f} m/s, then turning left with {told_w:.2f} rad/s"
        hint = "linear.x = axes[1], angular.z = axes[0], for every Joy"
        raise Wrong(expected, seen, script, hint)
    return seen


def _beside_the_robot(
    session: Session, stage: Stage, script: str
) -> tuple[Program, SimulatedRobot]:
    """Return the program and the simulated robot, which it alone drives. Raises Wrong."""
    stage.call("listen", CMD_VEL, "Twist")
    stage.call("advertise", JOY, "Joy")
    program = stage.start(PACKAGE, script)
    robot = SimulatedRobot(stage)
    ready = stage.wait(lambda: program.ended or stage.call("listeners", JOY), START_S)
    rest(stage, CMD_VEL)
    # Its Publisher may be made in the callback.
    ready = ready and stage.wait(lambda: program.ended or stage.call("speakers", CMD_VEL), START_S)
    if not ready or program.ended:
        raise crash(session, PACKAGE, program, "the node runs beside the simulated robot")
    publishers = stage.call("state")[0].get(CMD_VEL, [])
    if len(set(publishers)) != 1:
        seen = f"{len(set(publishers))}: {', '.join(publishers)}"
        hint = "end the older version: rosnode list"
        raise Wrong("one node publishes on /cmd_vel", seen, hint=hint)
    return program, robot


def _driven(
    stage: Stage, robot: SimulatedRobot, joy: Any, field: int
) -> tuple[tuple[float, float], float | None]:
    """Return (speed and rate of turn of the robot, what the last Twist has in a field) in a drive."""
    before = stage.call("count", CMD_VEL)

    def wanted() -> list[float]:
        return [value[field] for _, _, value in stage.call("heard", CMD_VEL, before)]

    stage.call("stream", JOY, [joy], 20.0, True)
    stage.wait(lambda: any(abs(value) > 0.01 for value in wanted()), 3.0)
    moving = stage.call("count", ODOM)
    stage.wait(lambda: stage.call("count", ODOM) > moving + 8, 3.0)
    for _ in range(LOOKS):
        speeds, last = _speeds(stage, robot), next(iter(wanted()[-1:]), None)
        if last is not None and _agree(speeds[field == ANGULAR], last, FASTEST[field]):
            break
    stage.call("end_stream", JOY)
    return speeds, last


def plug_in(session: Session, stage: Stage, device: str = "/dev/input/js0") -> Any:
    """Make a virtual F710 behind a device, or a FIFO where that cannot be; (Pad, path)."""
    path = Path(device) if session.can_have_devices else session.folder / "js0"
    pad = stage.help(lambda: Pad(str(path), session.task.joy))
    pad.call("connected")
    return pad, path


@check("C20", "a joystick drives it", "4.5", "C16", look="rostopic echo /joy/axes[1]")
def joystick(session: Session) -> Note | str | None:
    """Drive with a virtual F710, its switch at D; then send Joys as with the switch at X."""
    script = main_script(session)
    with session.stage() as stage:
        stage.call("listen", JOY, "Joy")
        stage.call("listen", CMD_VEL, "Twist")
        pad, path = plug_in(session, stage)
        node = stage.start_ours("gamepad", "joy_node", f"_dev:={path}", "_autorepeat_rate:=20")
        program = stage.start(PACKAGE, script)

        def has_ended() -> bool:
            return program.ended or node.ended

        def speeds(since: int = 0) -> list[float]:
            return [value[0] for _, _, value in stage.call("heard", CMD_VEL, since)]

        def drives() -> bool:
            return any(abs(speed) > 0.01 for speed in speeds())

        def is_up() -> bool:
            return bool(stage.call("count", JOY) and stage.call("speakers", CMD_VEL))

        stage.wait(lambda: is_up() or has_ended(), START_S)
        pad.call("push", 0.0, 0.6)
        stage.wait(lambda: drives() or has_ended(), 3.0)
        if not stage.call("count", JOY):
            raise CannotCheck(f"the joystick driver does not start: {node.output[-200:]}")
        if program.ended or not drives():
            expected = "the stick pushed forwards moves the robot: linear.x > 0"
            raise crash(session, PACKAGE, program, expected)
        if speeds()[-1] < 0:
            expected = "the stick pushed forwards moves the robot forwards"
            raise Wrong(expected, "linear.x < 0", script)
        session.box.end(node)
        survives = _survives_eight_axes(stage, program, speeds)
    if survives:
        return "switch at D and at X"
    seen = "with the switch at X (eight axes) it fails; the handout's does, too"
    hint = 'as many as there are: ", ".join("%.2f" % axis for axis in data.axes)'
    return Note(seen, script, hint)


def _survives_eight_axes(stage: Stage, program: Any, speeds: Any) -> Any:
    """Return whether Joys as of the switch at X are answered. speeds(since): linear.x of the Twists."""
    stage.call("advertise", JOY, "Joy")
    # Our own Subscriber is one of them.
    stage.wait(lambda: stage.call("listeners", JOY) > 1 or program.ended, START_S)

    def drive_backwards() -> None:
        """Only this does; once it shows, all that was sent before has been answered."""
        index = stage.call("count", CMD_VEL)
        stage.call("send", JOY, held(stage.session, 0.1, -0.5))
        stage.wait(lambda: min(speeds(index), default=0.0) < 0 or program.ended, SLOW_S)

    drive_backwards()
    before, failed = stage.call("count", CMD_VEL), program.output.count("Traceback")
    for k in range(5):
        axes = (0.1, 0.2 + 0.1 * k, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        joy = axes, (0,) * LB + (1,) + (0,) * 6
        stage.call("send", JOY, stage.session.task.joy(joy))
    drive_backwards()
    has_failed = program.ended or program.output.count("Traceback") != failed
    return not has_failed and max(speeds(before), default=0.0) > 0
