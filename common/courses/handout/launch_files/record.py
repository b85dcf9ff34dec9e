"""Section 5, and 6.1: launch files read by roslaunch's own library, and at work."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Callable, Dict, Tuple

from tutorial_check import ODOM, CannotCheck, Ran, RosSession, Workspace

from ..task import NEUTRAL

if TYPE_CHECKING:  # judges need no gamepad
    from tutorial_check import Gamepad

BAG_S = 1.2  # length of the recording that takes the place of the student's, and is played again
START_S = 20.0  # for all nodes of a launch on a busy machine
UP_S = 6.0  # for what they are there for, once all of them are
FAR_M, NEAR_M = 0.3, 0.15  # that the robot drives by a recording, and by the stick


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


class Launch:
    """A launch file run on a ros, and what flowed."""

    def __init__(self, workspace: Workspace, ros: RosSession, plan: Plan) -> None:
        self._workspace, self.ros, self.plan = workspace, ros, plan
        for topic, kind in ((plan.joys, "Joy"), (plan.twists, "Twist"), (ODOM, "Odometry")):
            ros.peer.listen(topic, kind)
        self.program = ros.launch(["roslaunch", str(workspace.source / plan.path)])

    def wait(self, condition: Callable[[], object]) -> bool:
        """Return condition(), once it is true, the launch is over, or its nodes had their time."""
        self.ros.wait(lambda: condition() or self.is_over() or self._is_up(), START_S)
        self.ros.wait(lambda: condition() or self.is_over(), UP_S)
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
        there = self.ros.peer.state()[0].get("/rosout", ())
        return all(node in there for node in self.plan.nodes)

    def moved_m(self) -> float:
        """Return how far the robot drove, along its way."""
        path = [value[1:3] for _, _, value in self.ros.peer.received(ODOM)]
        return sum(map(math.dist, path, path[1:]))

    def run(
        self, drives: bool, loops: bool = False, rests: bool = True, active: Tuple[str, ...] = ()
    ) -> Run:
        topics = (self.plan.joys, self.plan.twists, ODOM)
        counts = {topic: self.ros.peer.count(topic) for topic in topics}
        words = () if drives else tuple(self._last_words())
        about = self.program.ran, self.has_died, drives, counts, self.moved_m(), words
        return Run(*about, loops, rests, active)

    def _last_words(self) -> list[str]:
        folder = Path(self.ros.environment["ROS_LOG_DIR"])
        logs = map(self._workspace.read, sorted(folder.rglob("*-stdout.log")))
        return [line for log in logs for line in log.splitlines()[-1:] if "INFO" not in line]


def bag_run(workspace: Workspace, plan: Plan, bag: str, length_s: float, is_looped: bool) -> Run:
    """Run launch_bag. bag: within src, replaced by a recording of that length; or empty."""
    if bag:
        _own_bag(workspace, workspace.source / bag, length_s)
    with workspace.ros_session(renamed=False) as ros:
        launch = Launch(workspace, ros, plan)
        drives = launch.wait(lambda: launch.moved_m() > FAR_M)
        loops = is_looped
        # A robot that drives by another topic has not shown that /joy does it.
        if drives and is_looped and bag and ros.peer.count(plan.joys):
            end_s = ros.peer.received(plan.joys)[0][0] + length_s + 0.5
            loops = bool(
                ros.wait(lambda: ros.peer.received(plan.joys)[-1][0] > end_s, length_s + 2.5)
            )
        return launch.run(drives, loops=loops)


def _own_bag(workspace: Workspace, path: Path, length_s: float) -> None:
    """Write a recording in place of the student's: rest with LB released, then forwards."""
    import rosbag  # noqa: PLC0415
    import rospy  # noqa: PLC0415
    from sensor_msgs.msg import Joy  # noqa: PLC0415

    mode = os.stat(path).st_mode
    os.unlink(path)
    with rosbag.Bag(str(path), "w") as bag:
        for k in range(int(length_s * 20)):
            stamp = rospy.Time(1_600_000_000 + k / 20)
            axes, buttons = workspace.task.held(0.0, 1.0) if k > 4 else NEUTRAL
            joy = Joy(axes=axes, buttons=buttons)
            joy.header.stamp = stamp
            bag.write("/joy", joy, stamp)
    os.chmod(path, mode | 0o444)


def stick_run(workspace: Workspace, plan: Plan) -> Run:
    """Run launch_joy_node, push the stick and release it."""
    with workspace.ros_session(renamed=False) as ros:
        gamepad = plug_in_for(workspace, ros, plan)
        launch = Launch(workspace, ros, plan)
        if not drives_forwards(ros, gamepad, launch):
            return launch.run(drives=False)
        gamepad.release()

        def rests() -> bool:
            return abs(ros.peer.received(ODOM, -1)[0][2][5]) <= 0.01

        return launch.run(drives=True, rests=bool(ros.wait(rests, 3.0)))


def plug_in_for(workspace: Workspace, ros: RosSession, plan: Plan) -> Gamepad:
    """Put a joystick where the joy_node of a launch file will look for it."""
    if plan.device and not workspace.order.in_namespaces:
        name = Path(plan.path).name
        raise CannotCheck(f"the system grants no {plan.device} to try {name} with")
    gamepad, path = ros.plug_in(*filter(None, [plan.device]))
    for node in plan.joysticks if not workspace.order.in_namespaces else ():
        ros.peer.set_parameter(f"{node}/dev", str(path))
    return gamepad


def drives_forwards(ros: RosSession, gamepad: Gamepad, launch: Launch, *signs: str) -> bool:
    """Push the stick forwards once signs, topics, have a message; return whether it moves."""
    plan = launch.plan

    def ready() -> bool:
        counts = [ros.peer.publishers(topic) for topic in (plan.joys, plan.twists, ODOM)]
        return gamepad.connected() and all(counts + [ros.peer.count(each) for each in signs])

    def moves() -> bool:
        return launch.moved_m() > NEAR_M

    def touch(move: Callable[..., None], *where: float) -> None:
        before = ros.peer.count(plan.joys)
        move(*where)
        ros.wait(lambda: launch.is_over() or ros.peer.count(plan.joys) > before, 1.0)

    launch.wait(ready)
    # LB alone, touched and let go: a joy_node with autorepeat_rate 0 is silent while nothing moves.
    touch(gamepad.push, 0.0, 0.0)
    touch(gamepad.release)
    # A new robot obeys only after a while of zero velocities; so does this check.
    ros.wait(launch.is_over, 0.6)
    gamepad.push(0.0, 1.0)
    ros.wait(lambda: moves() or launch.is_over(), 4.0 if ready() else 0.0)
    return moves()
