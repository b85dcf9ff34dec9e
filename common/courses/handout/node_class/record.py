"""Section 6.2: recorders of the class without a joystick, and ended while it drives."""

from __future__ import annotations

import signal
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Dict, Optional

from tutorial_check import ODOM, CannotCheck, Heard, Program, Ran, RosSession, Workspace, put_file

from ..task import CMD_VEL, JOY, NEUTRAL, PACKAGE

CTRL_C, KILL, LAUNCH = "Ctrl-C", "rosnode kill", "the end of a launch"
# {way to end: a node that is ended so}: all run at once; when all have ended, the robot must stand.
NODES = {CTRL_C: "/ended_by_ctrl_c", KILL: "/ended_by_kill", LAUNCH: "/ended_with_its_launch"}
STOP_S, GONE_S = 2.0, 3.0  # until the zero; until the node exits
STANDS_S = 1.0  # after that, though the stick is still pushed; the robot's own timeout is 0.6 s
ALONE_S = 1.5  # without a joystick
ZERO = (0.0,) * 6
LAUNCH_FILE = """<launch>
  <node pkg="{package}" type="{program}" name="{name}" output="screen"/>
</launch>
"""


@dataclass(frozen=True)
class Alone:
    """A run of the program without a joystick, and in Python of a copy that lacks an import."""

    program: Ran
    ended: bool
    broken: Optional[Ran] = None
    broken_ended: bool = False


@dataclass(frozen=True)
class End:
    """The result of ending it in one way."""

    zero_after_s: Optional[float]  # None: none came
    in_time: bool  # within STOP_S, or it exited
    took_s: Optional[float]  # None: it had to be killed
    after_zero: int  # Twists that moved the robot again
    output: str


@dataclass(frozen=True)
class Endings:
    """A run of the program, started once for each way, driven and ended."""

    failed: str = ""  # the first way whose program did not drive; program: that one
    program: Optional[Ran] = None
    ends: Dict[str, End] = field(default_factory=dict)  # by way
    robot_rests: bool = True  # when all have ended


def alone(workspace: Workspace, script: str, text: str) -> Alone:
    """Start it without a joystick. text: of the copy; empty: no copy."""
    joy = workspace.task.topic(JOY)
    with workspace.ros_session() as ros:
        program, broken = ros.start(PACKAGE, script), None
        if text:
            copy = workspace.sibling(PACKAGE, script, text)
            broken = ros.start(PACKAGE, copy, "__name:=broken")
        ros.wait_for_start(lambda: program.ended or joy in ros.peer.state()[1])
        ros.wait(lambda: program.ended, ALONE_S)
        ros.wait_for_start(lambda: broken is None or broken.ended)
        ended, broken_ended = program.ended, broken is not None and broken.ended
    return Alone(program.ran, ended, broken.ran if broken else None, broken_ended)


def endings(workspace: Workspace, script: str) -> Endings:
    with workspace.ros_session() as ros:
        robot = ros.start_ours("fake_turtlebot_sim", "fake_turtlebot.py")
        ros.peer.advertise(JOY, "Joy")
        ros.peer.listen(CMD_VEL, "Twist")
        ros.peer.listen(ODOM, "Odometry")
        programs = {way: _start(workspace, ros, script, way) for way in NODES}
        failed = _drive(workspace, ros, programs)
        if failed:
            return Endings(failed, programs[failed].ran)
        ended = _end(workspace, ros, programs)
        if robot.ended:
            raise CannotCheck(f"the simulated robot has ended: {robot.output[-200:]}")
    return ended


def _start(workspace: Workspace, ros: RosSession, script: str, way: str) -> Program:
    name = NODES[way][1:]
    if way != LAUNCH:
        return ros.start(PACKAGE, script, f"__name:={name}")
    file = workspace.folder / "tmp" / "ended.launch"
    package = workspace.task.name_of(PACKAGE)
    program = Path(workspace.command(PACKAGE, script)[0]).name
    text = LAUNCH_FILE.format(package=package, program=program, name=name)
    put_file(workspace.folder, file, text)
    return ros.launch(["roslaunch", str(file)])


def _twists(ros: RosSession, since: int = 0) -> dict[str, list[Heard]]:
    """Return {way: the Twists of that node}."""
    received = ros.peer.received(CMD_VEL, since)
    return {way: [twist for twist in received if twist[1] == name] for way, name in NODES.items()}


def _robot_rests(ros: RosSession) -> bool:
    last = ros.peer.received(ODOM, -1)
    return bool(last) and max(map(abs, last[0][2][5:])) < 0.01


def _drive(workspace: Workspace, ros: RosSession, programs: dict[str, Program]) -> str:
    """Drive until all move the robot; return the first way whose program does not, or ""."""

    def has_ended() -> bool:
        return any(program.ended for program in programs.values())

    def are_connected() -> bool:
        ends = ros.peer.listeners(JOY), ros.peer.publishers(CMD_VEL)
        return min(ends) >= len(programs) and bool(ros.peer.count(ODOM))

    def moving() -> list[int]:
        return [sum(value != ZERO for _, _, value in sent) for sent in _twists(ros).values()]

    ros.wait_for_start(lambda: has_ended() or are_connected())
    # The robot obeys only after zeros.
    ros.peer.stream(JOY, [NEUTRAL], 50.0, True)
    ros.wait(lambda: has_ended() or min(map(len, _twists(ros).values())) >= 5, 0.5)
    ros.peer.end_stream(JOY)
    ros.peer.stream(JOY, [workspace.task.held(0.2, 0.3)], 50.0, True)
    ros.wait(lambda: has_ended() or (min(moving()) >= 10 and not _robot_rests(ros)), 4.0)
    counts = zip(programs.items(), moving())
    return next((way for (way, program), count in counts if program.ended or not count), "")


def _end(workspace: Workspace, ros: RosSession, programs: dict[str, Program]) -> Endings:
    runner = workspace.runner
    launched = ros.peer.node_process(NODES[LAUNCH])
    index = ros.peer.count(CMD_VEL)
    began_s = time.monotonic()  # one clock for all processes
    took_s: dict[str, float] = {}
    for way in (CTRL_C, LAUNCH):
        programs[way].signal(signal.SIGINT)
    ros.peer.kill_node(NODES[KILL])

    def all_gone() -> bool:
        for way, program in programs.items():
            # roslaunch takes a while to exit after its nodes.
            left = way == LAUNCH and launched and not Path(f"/proc/{launched}").exists()
            if program.ended or left:
                took_s.setdefault(way, time.monotonic() - began_s)
        return len(took_s) == len(NODES)

    def stopped() -> dict[str, bool]:
        all_gone()
        sent = _twists(ros, index)
        return {way: way in took_s or ZERO in [value for _, _, value in sent[way]] for way in NODES}

    before_s = runner.clock.now()
    ros.wait(lambda: all(stopped().values()), STOP_S)
    in_time = stopped()
    ros.wait(all_gone, GONE_S + 0.5 - (runner.clock.now() - before_s))
    rests = bool(ros.wait(lambda: _robot_rests(ros), STANDS_S)) or not all_gone()
    ros.peer.end_stream(JOY)
    runner.end_all(list(programs.values()), 0.2)
    ros.wait(lambda: not ros.peer.publishers(CMD_VEL), 3.0)
    ends = {}
    for way, sent in _twists(ros, index).items():
        first = next((at for at, (_, _, value) in enumerate(sent) if value == ZERO), None)
        ends[way] = End(
            zero_after_s=None if first is None else max(0.0, sent[first][0] - began_s),
            in_time=in_time[way],
            took_s=took_s.get(way),
            after_zero=sum(value != ZERO for _, _, value in sent[first or 0 :]),
            output=programs[way].output,
        )
    return Endings(ends=ends, robot_rests=rests)
