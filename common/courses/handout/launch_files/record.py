"""Section 5, and 6.1: launch files read by roslaunch's own library, and at work."""

from __future__ import annotations

import json
import math
import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable, Dict, Optional, Tuple

from tutorial_check.processes.errors import CannotCheck
from tutorial_check.processes.program import Ran
from tutorial_check.recording import launch_facts
from tutorial_check.recording.ground import Ground
from tutorial_check.recording.ros_session import Stage
from tutorial_check.recording.simulated_robot import ODOM
from tutorial_check.submission.tracebacks import last_lines

from ..driving.record import NEUTRAL
from ..s4.record import held, plug_in

if TYPE_CHECKING:  # judges need no gamepad
    from tutorial_check.recording.gamepad import Gamepad

READ_S = 15.0  # for all four files
BAG_S = 1.2  # length of the recording that takes the place of the student's, and is played again
START_S = 20.0  # for all nodes of a launch on a busy machine
UP_S = 6.0  # for what they are there for, once all of them are
FAR_M, NEAR_M = 0.3, 0.15  # that the robot drives by a recording, and by the stick


@dataclass(frozen=True)
class Facts:
    """What roslaunch makes of launch files; see launch_facts."""

    files: Optional[Tuple[Dict[str, Any], ...]]  # None: reading them does not end


@dataclass(frozen=True)
class Plan:
    """A launch file to be run, and what should come of it."""

    path: str  # within src
    joys: str  # the topics of the Joys and of the velocities
    twists: str
    nodes: Tuple[str, ...]  # that the master will know
    joysticks: Tuple[str, ...] = ()  # those of joy_node
    device: str = ""  # that one of them names


@dataclass(frozen=True)
class Run:
    """A launch file that was run beside a robot."""

    program: Ran
    has_died: bool  # a node has, as roslaunch printed
    drives: bool  # the robot, as far as it should
    counts: Dict[str, int]  # how many messages came, of Joys, velocities and odometry
    moved_m: float
    last_words: Tuple[str, ...]  # the last lines of nodes without output="screen"
    loops: bool = False  # Joys go on after the end of the recording
    rests: bool = True  # once the stick is released
    active: Tuple[str, ...] = field(default=())  # what the multiplexer named


def facts_of_files(ground: Ground, *paths: str) -> Facts:
    """Read launch files as roslaunch does, and start nothing. paths: within src."""
    whole = [str(ground.source / path) for path in paths]
    command = ["/usr/bin/python3", launch_facts.__file__, *whole]
    program = ground.runner.start(command, ground.environment)
    ended = ground.runner.wait(lambda: program.ended, READ_S)
    ground.runner.end(program)
    if not ended and ground.runner.clock.strained():
        raise CannotCheck("launch files cannot be read in time: the machine is too busy")
    if not ended:
        return Facts(None)
    lines = (line for line in program.output.splitlines() if line.startswith(launch_facts.MARK))
    found = tuple(json.loads(line[len(launch_facts.MARK) :]) for line in lines)
    if sorted(one["path"] for one in found) != sorted(whole):
        raise CannotCheck(f"launch files cannot be read: {last_lines(program.output)}")
    return Facts(found)


class Launch:
    """A launch file run on a stage, and what flowed."""

    def __init__(self, ground: Ground, stage: Stage, plan: Plan) -> None:
        self._ground, self.stage, self.plan = ground, stage, plan
        for topic, kind in ((plan.joys, "Joy"), (plan.twists, "Twist"), (ODOM, "Odometry")):
            stage.driver.listen(topic, kind)
        self.program = stage.launch(["roslaunch", str(ground.source / plan.path)])

    def wait(self, condition: Callable[[], object]) -> bool:
        """Return condition(), once it is true, the launch is over, or its nodes had their time."""
        self.stage.wait(lambda: condition() or self.is_over() or self._is_up(), START_S)
        self.stage.wait(lambda: condition() or self.is_over(), UP_S)
        return bool(condition())

    def is_over(self) -> bool:
        """Return whether it has come to its end, or a node of it."""
        return self.program.ended or self.has_died

    @property
    def has_died(self) -> bool:
        """Whether roslaunch printed that a node died; RViz and rqt_graph need a screen, and may."""
        dead = (line for line in self.program.output.splitlines() if "has died" in line)
        return any("rviz" not in line and "rqt" not in line for line in dead)

    def _is_up(self) -> bool:
        """Return whether the master knows all of its nodes; each has /rosout."""
        there = self.stage.driver.state()[0].get("/rosout", ())
        return all(node in there for node in self.plan.nodes)

    def moved_m(self) -> float:
        """Return how far the robot drove, along its way."""
        path = [value[1:3] for _, _, value in self.stage.driver.received(ODOM)]
        return sum(map(math.dist, path, path[1:]))

    def run(
        self, drives: bool, loops: bool = False, rests: bool = True, active: Tuple[str, ...] = ()
    ) -> Run:
        topics = (self.plan.joys, self.plan.twists, ODOM)
        counts = {topic: self.stage.driver.count(topic) for topic in topics}
        words = () if drives else tuple(self._last_words())
        about = self.program.ran, self.has_died, drives, counts, self.moved_m(), words
        return Run(*about, loops, rests, active)

    def _last_words(self) -> list[str]:
        folder = Path(self.stage.environment["ROS_LOG_DIR"])
        logs = map(self._ground.read, sorted(folder.rglob("*-stdout.log")))
        return [line for log in logs for line in log.splitlines()[-1:] if "INFO" not in line]


def bag_run(ground: Ground, plan: Plan, bag: str, length_s: float, is_looped: bool) -> Run:
    """Run launch_bag. bag: within src, replaced by a recording of that length; or empty."""
    if bag:
        _own_bag(ground, ground.source / bag, length_s)
    with ground.stage(renamed=False) as stage:
        launch = Launch(ground, stage, plan)
        drives = launch.wait(lambda: launch.moved_m() > FAR_M)
        loops = is_looped
        # A robot that drives by another topic has not shown that /joy does it.
        if drives and is_looped and bag and stage.driver.count(plan.joys):
            end_s = stage.driver.received(plan.joys)[0][0] + length_s + 0.5
            loops = bool(
                stage.wait(lambda: stage.driver.received(plan.joys)[-1][0] > end_s, length_s + 2.5)
            )
        return launch.run(drives, loops=loops)


def _own_bag(ground: Ground, path: Path, length_s: float) -> None:
    """Write a recording in place of the student's: rest with LB released, then forwards."""
    import rosbag  # noqa: PLC0415
    import rospy  # noqa: PLC0415
    from sensor_msgs.msg import Joy  # noqa: PLC0415

    mode = os.stat(path).st_mode
    os.unlink(path)
    with rosbag.Bag(str(path), "w") as bag:
        for k in range(int(length_s * 20)):
            stamp = rospy.Time(1_600_000_000 + k / 20)
            axes, buttons = held(ground, 0.0, 1.0) if k > 4 else NEUTRAL
            joy = Joy(axes=axes, buttons=buttons)
            joy.header.stamp = stamp
            bag.write("/joy", joy, stamp)
    os.chmod(path, mode | 0o444)


def stick_run(ground: Ground, plan: Plan) -> Run:
    """Run launch_joy_node, push the stick and release it."""
    with ground.stage(renamed=False) as stage:
        gamepad = plug_in_for(ground, stage, plan)
        launch = Launch(ground, stage, plan)
        if not drives_forwards(stage, gamepad, launch):
            return launch.run(drives=False)
        gamepad.release()

        def rests() -> bool:
            return abs(stage.driver.received(ODOM, -1)[0][2][5]) <= 0.01

        return launch.run(drives=True, rests=bool(stage.wait(rests, 3.0)))


def plug_in_for(ground: Ground, stage: Stage, plan: Plan) -> Gamepad:
    """Put a joystick where the joy_node of a launch file will look for it."""
    if plan.device and not ground.order.apart:
        name = Path(plan.path).name
        raise CannotCheck(f"the system grants no {plan.device} to try {name} with")
    gamepad, path = plug_in(ground, stage, *filter(None, [plan.device]))
    for node in plan.joysticks if not ground.order.apart else ():
        stage.driver.set_parameter(f"{node}/dev", str(path))
    return gamepad


def drives_forwards(stage: Stage, gamepad: Gamepad, launch: Launch, *signs: str) -> bool:
    """Push the stick forwards once signs, topics, have a message; return whether it moves."""
    plan = launch.plan

    def ready() -> bool:
        counts = [stage.driver.publishers(topic) for topic in (plan.joys, plan.twists, ODOM)]
        return gamepad.connected() and all(counts + [stage.driver.count(each) for each in signs])

    def moves() -> bool:
        return launch.moved_m() > NEAR_M

    def touch(move: Callable[..., None], *where: float) -> None:
        before = stage.driver.count(plan.joys)
        move(*where)
        stage.wait(lambda: launch.is_over() or stage.driver.count(plan.joys) > before, 1.0)

    launch.wait(ready)
    # LB alone, touched and let go: a joy_node with autorepeat_rate 0 is silent while nothing moves.
    touch(gamepad.push, 0.0, 0.0)
    touch(gamepad.release)
    # A new robot obeys only after a while of zero velocities; so does this check.
    stage.wait(launch.is_over, 0.6)
    gamepad.push(0.0, 1.0)
    stage.wait(lambda: moves() or launch.is_over(), 4.0 if ready() else 0.0)
    return moves()
