"""Runs of the handout's launch files, beside a robot and with a gamepad."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Callable, Dict, Tuple

from tutorial_check import ODOM, CannotCheck, Launch, Ran, RosSession, Workspace

if TYPE_CHECKING:  # checks need no gamepad
    from tutorial_check import VirtualGamepad

START_S = 20.0  # for all nodes of a launch on a busy machine
UP_S = 6.0  # for the effect, once all nodes are up
NEAR_M = 0.15  # least distance to drive


@dataclass(frozen=True)
class Plan:
    """How to run a launch file, and its topics and nodes."""

    path: str  # within src
    joys: str  # topic of the Joys; twists: of the velocities
    twists: str
    nodes: Tuple[str, ...]  # names at the master
    joysticks: Tuple[str, ...] = ()  # those of joy_node
    device: str = ""  # that one of the joysticks names


@dataclass(frozen=True)
class LaunchRun:
    """A run of a launch file beside a robot."""

    program: Ran
    has_died: bool  # roslaunch reported a node as dead
    drives: bool  # the robot, as far as it should
    counts: Dict[str, int]  # {topic: messages}, of Joys, velocities and odometry
    moved_m: float
    last_words: Tuple[str, ...]  # the last lines of nodes without output="screen"
    loops: bool = False  # Joys continue after the end of the bag
    rests: bool = True  # once the stick is released
    active: Tuple[str, ...] = field(default=())  # sources that the multiplexer named


class RunningLaunch(Launch):
    """A launch file that runs, and its messages."""

    def __init__(self, workspace: Workspace, ros: RosSession, plan: Plan) -> None:
        self._workspace, self.ros, self.plan = workspace, ros, plan
        for topic, kind in ((plan.joys, "Joy"), (plan.twists, "Twist"), (ODOM, "Odometry")):
            ros.peer.listen(topic, kind)
        super().__init__(ros, plan.path)

    def wait(self, condition: Callable[[], object]) -> bool:
        """Wait for a condition, the end of the launch, or a timeout; return the condition."""

        def is_up() -> bool:
            return set(self.plan.nodes) <= set(self.nodes)

        self.ros.wait(lambda: condition() or self.is_over or is_up(), START_S)
        self.ros.wait(lambda: condition() or self.is_over, UP_S)
        return bool(condition())

    @property
    def died(self) -> Tuple[str, ...]:
        """roslaunch's lines on nodes that died; RViz and rqt_graph need a screen, and may die."""
        lines = (line for line in self.program.output.splitlines() if "has died" in line)
        return tuple(line for line in lines if "rviz" not in line and "rqt" not in line)

    def moved_m(self) -> float:
        """Return the length of the robot's path."""
        path = [value[1:3] for _, _, value in self.ros.peer.received(ODOM)]
        return sum(map(math.dist, path, path[1:]))

    def run(
        self, drives: bool, loops: bool = False, rests: bool = True, active: Tuple[str, ...] = ()
    ) -> LaunchRun:
        topics = (self.plan.joys, self.plan.twists, ODOM)
        counts = {topic: self.ros.peer.count(topic) for topic in topics}
        words = () if drives else tuple(self._last_words())
        about = self.program.ran, bool(self.died), drives, counts, self.moved_m(), words
        return LaunchRun(*about, loops, rests, active)

    def _last_words(self) -> list[str]:
        folder = Path(self.ros.environment["ROS_LOG_DIR"])
        logs = map(self._workspace.read, sorted(folder.rglob("*-stdout.log")))
        return [line for log in logs for line in log.splitlines()[-1:] if "INFO" not in line]


def plug_in_for(workspace: Workspace, ros: RosSession, plan: Plan) -> VirtualGamepad:
    """Plug in a joystick where the launch file's joy_node looks for it."""
    if plan.device and not workspace.order.sandbox.in_namespaces:
        name = Path(plan.path).name
        raise CannotCheck(f"the system grants no {plan.device} to try {name} with")
    gamepad, path = ros.plug_in(*filter(None, [plan.device]))
    for node in plan.joysticks if not workspace.order.sandbox.in_namespaces else ():
        ros.peer.set_parameter(f"{node}/dev", str(path))
    return gamepad


def drives_forwards(
    ros: RosSession, gamepad: VirtualGamepad, launch: RunningLaunch, *signs: str
) -> bool:
    """Push the stick forwards once these topics have messages; return whether the robot moves."""
    plan = launch.plan

    def ready() -> bool:
        counts = [ros.peer.publishers(topic) for topic in (plan.joys, plan.twists, ODOM)]
        return gamepad.connected() and all(counts + [ros.peer.count(sign) for sign in signs])

    def moves() -> bool:
        return launch.moved_m() > NEAR_M

    def touch(move: Callable[..., None], *where: float) -> None:
        before = ros.peer.count(plan.joys)
        move(*where)
        ros.wait(lambda: launch.is_over or ros.peer.count(plan.joys) > before, 1.0)

    launch.wait(ready)
    # Press and release LB: a joy_node with autorepeat_rate 0 sends nothing until something moves.
    touch(gamepad.push, 0.0, 0.0)
    touch(gamepad.release)
    # A robot that has just started obeys only after some zero velocities.
    ros.wait(lambda: launch.is_over, 0.6)
    gamepad.push(0.0, 1.0)
    ros.wait(lambda: moves() or launch.is_over, 4.0 if ready() else 0.0)
    return moves()
