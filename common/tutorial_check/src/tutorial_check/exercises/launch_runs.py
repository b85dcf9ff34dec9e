"""C23, C24 and C26: the launch files of section 5 at work."""

from __future__ import annotations

import math
import os
import re
from pathlib import Path
from typing import Any, Callable

from tutorial_check.course import check
from tutorial_check.exercises import launch_nodes
from tutorial_check.exercises.driving import CMD_VEL, JOY, NEUTRAL
from tutorial_check.exercises.joystick_task import PACKAGE
from tutorial_check.exercises.launch_files import BAG, STICK, LaunchFile
from tutorial_check.exercises.robot import held, plug_in
from tutorial_check.model import CannotCheck, Wrong
from tutorial_check.scripts import cause_of
from tutorial_check.session import Session
from tutorial_check.simulated_robot import ODOM
from tutorial_check.stage import Stage
from tutorial_check.tracebacks import first_traceback

BAG_S = 1.2  # length of the recording that takes the place of the student's, and is played again
ONCE_S = 60.0  # and of one that is not: like the student's it lasts until the others have started
LOOP = re.compile(r"--l(oop|oo|o)?|-[a-z]*l[a-z]*")  # of rosbag play, as it may be written
START_S = 20.0  # for all nodes of a launch on a busy machine
UP_S = 6.0  # for what they are there for, once all of them are
ERRORS = re.compile(r"^(?!.*(?:rviz|INFO)).*(?:ERROR|died|Invalid|cannot|Unable)", re.MULTILINE)


class Launch:
    """A launch file run on a stage, and what flowed."""

    def __init__(self, file: LaunchFile, stage: Stage, twists: str = CMD_VEL) -> None:
        """twists: the topic on which the velocities should come."""
        self.file, self.stage, self.twists = file, stage, twists
        kinds = (launch_nodes.is_joystick, launch_nodes.is_player)
        senders = [node for node in file.nodes if any(is_one(node) for is_one in kinds)]
        self.joys = launch_nodes.topic_of(senders[0], JOY) if senders else JOY
        for topic, kind in ((self.joys, "Joy"), (twists, "Twist"), (ODOM, "Odometry")):
            stage.call("listen", topic, kind)
        self.program = stage.launch(["roslaunch", str(file.path)])

    def wait(self, condition: Callable[[], Any]) -> Any:
        """Return condition(), as soon as it is true, the launch is over, or its nodes had their time."""
        self.stage.wait(lambda: condition() or self.is_over() or self._is_up(), START_S)
        self.stage.wait(lambda: condition() or self.is_over(), UP_S)
        return condition()

    def is_over(self) -> bool:
        """Return whether it has come to its end, or a node of it."""
        return self.program.ended or self.has_died

    @property
    def has_died(self) -> bool:
        """Return whether roslaunch said that a node has died; RViz, or rqt_graph, needs a screen, and may."""
        dead = (line for line in self.program.output.splitlines() if "has died" in line)
        return any("rviz" not in line and "rqt" not in line for line in dead)

    def _is_up(self) -> bool:
        """Return whether the master knows all of its nodes; each has /rosout."""
        there = self.stage.call("state")[0].get("/rosout", [])
        return all(
            node["namespace"] + node["name"] in there
            for node in self.file.nodes
            if not launch_nodes.is_viewer(node)
        )

    def moved(self) -> float:
        """Return how far the robot drove [m], along its way."""
        path = [value[1:3] for _, _, value in self.stage.call("heard", ODOM)]
        return sum(map(math.dist, path, path[1:]))

    def traced(self, expected: str) -> Wrong | None:
        """Return the Wrong for the first traceback that was printed, or None."""
        session = self.file.session
        output = re.sub(r"\x1b\[[0-9;]*m|\x1b\][^\x07]*\x07", "", self.program.output)
        trace = first_traceback(output, str(session.package(PACKAGE).folder))
        if not trace:
            return None
        where, hint = cause_of(session, PACKAGE, Path(trace.where.rpartition(":")[0]).name, trace)
        return Wrong(expected, trace.error, where, hint)

    def wrong(self, expected: str) -> Wrong:
        """Return the Wrong for a launch that does not do what it should, with the first cause there is."""
        traced = self.traced(expected)
        if traced:
            return traced
        hints = {
            self.joys: "does the recording, or joy_node, run? rostopic hz /joy",
            self.twists: f"does joy2twist run, and publish on {self.twists}? rosnode list",
            ODOM: f"does the simulated robot run? {launch_nodes.ROBOT_HINT}",
        }
        silent = [topic for topic in hints if not self.stage.call("count", topic)]
        seen, hint = f"the robot moved {self.moved():.2f} m", "rostopic echo /cmd_vel"
        if silent:
            seen, hint = f"nothing on {', '.join(silent)}", hints[silent[0]]
        for error in (ERRORS.findall(self.program.output) or self._last_words())[:1]:
            seen += f"; {error.strip()[:200]}"
        return Wrong(expected, seen, f"launch/{self.file.name}", hint)

    def _last_words(self) -> list[str]:
        """Return the last lines that nodes without output="screen" wrote."""
        folder = Path(self.stage.environment["ROS_LOG_DIR"])
        logs = map(self.file.session.read, sorted(folder.rglob("*-stdout.log")))
        return [line for log in logs for line in log.splitlines()[-1:] if "INFO" not in line]


def _own_bag(session: Session, path: Path, length_s: float) -> None:
    """Write a recording in place of the student's: rest with LB released, then forwards."""
    import rosbag  # noqa: PLC0415
    import rospy  # noqa: PLC0415
    from sensor_msgs.msg import Joy  # noqa: PLC0415

    mode = os.stat(path).st_mode
    os.unlink(path)
    with rosbag.Bag(str(path), "w") as bag:
        for k in range(int(length_s * 20)):
            stamp = rospy.Time(1_600_000_000 + k / 20)
            axes, buttons = held(session, 0.0, 1.0) if k > 4 else NEUTRAL
            joy = Joy(axes=axes, buttons=buttons)
            joy.header.stamp = stamp
            bag.write("/joy", joy, stamp)
    os.chmod(path, mode | 0o444)


def _bag_run(session: Session) -> Any:
    """Return (what is wrong or None, whether the recording begins again)."""
    bag, _ = launch_nodes.bag_of(session)
    file = LaunchFile(session, BAG)
    replaced = bag.startswith(str(session.source))
    player = next(filter(launch_nodes.is_player, file.nodes))
    by_words = any(LOOP.fullmatch(word) for word in file.words_of(player))
    loops = by_words or player["respawn"]
    if replaced:
        _own_bag(session, bag, BAG_S if loops else ONCE_S)
    with session.stage(renamed=False) as stage:
        launch = Launch(file, stage)
        # A robot that drives by another topic has not shown that /joy does it.
        if not launch.wait(lambda: launch.moved() > 0.3) or not stage.call("count", launch.joys):
            expected = "/joy, /cmd_vel and /odom flow, and the robot drives more than 0.3 m"
            return launch.wrong(expected), loops
        if by_words and replaced:
            end_s = stage.call("heard", launch.joys)[0][0] + BAG_S + 0.5
            loops = stage.wait(lambda: stage.call("heard", launch.joys)[-1][0] > end_s, BAG_S + 2.5)
        return None, bool(loops)


@check("C23", "launch_bag drives the robot", "5.1", "C22 C16",
       look="roslaunch joy2twist launch_bag.launch")  # fmt: skip
def bag_drives(session: Session) -> None:
    """Start launch_bag, with a recording of the checker's own."""
    wrong, _ = session.run("bag run", lambda: _bag_run(session))
    if wrong:
        raise wrong


@check("C24", "the recording begins again at its end", "5.1", "C23", look="rostopic hz /joy")
def bag_loops(session: Session) -> None:
    """Look at /joy after the end of that recording."""
    _, loops = session.run("bag run", lambda: _bag_run(session))
    if not loops:
        expected = "/joy flows on after the end of the recording"
        hint = "rosbag play --loop: in args= of that node"
        raise Wrong(expected, "it falls silent", launch_nodes.bag_of(session)[1], hint)


@check("C26", "launch_joy_node drives the robot", "5.1", "C25 C16",
       look="roslaunch joy2twist launch_joy_node.launch")  # fmt: skip
def stick_drives(session: Session) -> None:
    """Start launch_joy_node, push the stick and release it."""
    file = LaunchFile(session, STICK)
    with session.stage(renamed=False) as stage:
        pad = plug_in_for(file, stage)
        launch = Launch(file, stage)
        if not drives_forwards(stage, pad, launch):
            raise launch.wrong("the robot moves with the stick")
        pad.call("release")

        def stands() -> bool:
            return abs(stage.call("heard", ODOM, -1)[0][2][5]) <= 0.01

        if not stage.wait(stands, 3.0):
            raise Wrong("released, the robot stands", "it drives on", f"launch/{STICK}")


def plug_in_for(file: LaunchFile, stage: Stage) -> Any:
    """Put a joystick where the joy_node of a launch file will look for it."""
    nodes = list(filter(launch_nodes.is_joystick, file.nodes))
    named = [node["device"] for node in nodes if node["device"].startswith("/dev/input/")]
    session = file.session
    if named and not session.can_have_devices:
        raise CannotCheck(f"the system grants no {named[0]} to try {file.name} with")
    pad, path = plug_in(session, stage, *named[:1])
    if not session.can_have_devices:
        for node in nodes:
            stage.call("set_parameter", f"{node['namespace']}{node['name']}/dev", str(path))
    return pad


def drives_forwards(stage: Stage, pad: Any, launch: Launch, *signs: str) -> bool:
    """Push the stick forwards once everything runs; return whether the robot moves.

    signs: topics, listened to, on which a message comes as soon as their node works.
    """

    def ready() -> bool:
        topics = (launch.joys, launch.twists, ODOM)
        counts = [stage.call("speakers", topic) for topic in topics]
        return pad.call("connected") and all(counts + [stage.call("count", each) for each in signs])

    def moves() -> bool:
        return launch.moved() > 0.15

    def touch(*how: Any) -> None:
        before = stage.call("count", launch.joys)
        pad.call(*how)
        stage.wait(lambda: launch.is_over() or stage.call("count", launch.joys) > before, 1.0)

    launch.wait(ready)
    # LB alone, touched and let go: a joy_node with autorepeat_rate 0 is silent while nothing moves.
    touch("push", 0.0, 0.0)
    touch("release")
    # A new robot obeys only after a while of zero velocities; so does this check.
    stage.wait(launch.is_over, 0.6)
    pad.call("push", 0.0, 1.0)
    stage.wait(lambda: moves() or launch.is_over(), 4.0 if ready() else 0.0)
    return moves()
