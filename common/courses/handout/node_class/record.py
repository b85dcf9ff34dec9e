"""Section 6.2: the class without a joystick, and ended while it drives, in each possible way."""

from __future__ import annotations

import signal
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Dict, Optional

from tutorial_check.processes.errors import CannotCheck
from tutorial_check.processes.program import Program, Ran
from tutorial_check.recording.data import Heard
from tutorial_check.recording.ground import Ground
from tutorial_check.recording.ros_session import Stage
from tutorial_check.recording.simulated_robot import ODOM
from tutorial_check.submission import student_files

from ..driving.record import CMD_VEL, JOY, NEUTRAL
from ..s4.record import held
from ..task import PACKAGE

CTRL_C, KILL, LAUNCH = "Ctrl-C", "rosnode kill", "the end of a launch"
# One node for each way, all at once: each ends in its way, and the robot stands when all have gone.
NODES = {CTRL_C: "/ended_by_ctrl_c", KILL: "/ended_by_kill", LAUNCH: "/ended_with_its_launch"}
STOP_S, GONE_S = 2.0, 3.0  # for the zero, and for the end of the node
STANDS_S = 1.0  # after it, though the stick is still pushed; the robot itself forgets in 0.6 s
ALONE_S = 1.5  # without a joystick
ZERO = (0.0,) * 6
LAUNCH_FILE = """<launch>
  <node pkg="{package}" type="{program}" name="{name}" output="screen"/>
</launch>
"""


@dataclass(frozen=True)
class Alone:
    """The program without a joystick, and a copy of it that lacks an import."""

    program: Ran
    ended: bool
    broken: Optional[Ran] = None
    broken_ended: bool = False


@dataclass(frozen=True)
class End:
    """What came of ending it in one way."""

    zero_after_s: Optional[float]  # None: it never came
    in_time: bool  # within STOP_S, if it came
    took_s: Optional[float]  # None: it had to be killed
    after_zero: int  # Twists that moved the robot again
    output: str


@dataclass(frozen=True)
class Endings:
    """The program, started once for each way, driven and ended."""

    failed: str = ""  # the first way in which it did not drive, and that program
    program: Optional[Ran] = None
    ends: Dict[str, End] = field(default_factory=dict)  # by way
    robot_rests: bool = True  # when all have gone


def alone(ground: Ground, script: str, text: str) -> Alone:
    """Start it without a joystick. text: of the copy; empty: there is none."""
    joy = ground.task.topic(JOY)
    with ground.stage() as stage:
        program, broken = stage.start(PACKAGE, script), None
        if text:
            copy = ground.sibling(PACKAGE, script, text)
            broken = stage.start(PACKAGE, copy, "__name:=broken")
        stage.wait_for_start(lambda: program.ended or joy in stage.driver.state()[1])
        stage.wait(lambda: program.ended, ALONE_S)
        stage.wait_for_start(lambda: broken is None or broken.ended)
        ended, broken_ended = program.ended, broken is not None and broken.ended
    return Alone(program.ran, ended, broken.ran if broken else None, broken_ended)


def endings(ground: Ground, script: str) -> Endings:
    with ground.stage() as stage:
        robot = stage.start_ours("fake_turtlebot_sim", "fake_turtlebot.py")
        stage.driver.advertise(JOY, "Joy")
        stage.driver.listen(CMD_VEL, "Twist")
        stage.driver.listen(ODOM, "Odometry")
        programs = {way: _start(ground, stage, script, way) for way in NODES}
        failed = _drive(ground, stage, programs)
        if failed:
            return Endings(failed, programs[failed].ran)
        found = _end(ground, stage, programs)
        if robot.ended:
            raise CannotCheck(f"the simulated robot has ended: {robot.output[-200:]}")
    return found


def _start(ground: Ground, stage: Stage, script: str, way: str) -> Program:
    name = NODES[way][1:]
    if way != LAUNCH:
        return stage.start(PACKAGE, script, f"__name:={name}")
    file = ground.folder / "tmp" / "ended.launch"
    package, program = ground.task.named(PACKAGE), Path(script).name
    text = LAUNCH_FILE.format(package=package, program=program, name=name)
    student_files.put(ground.folder, file, text)
    return stage.launch(["roslaunch", str(file)])


def _twists(stage: Stage, since: int = 0) -> dict[str, list[Heard]]:
    """Return {way: what that node has sent}."""
    received = stage.driver.received(CMD_VEL, since)
    return {way: [one for one in received if one[1] == name] for way, name in NODES.items()}


def _robot_rests(stage: Stage) -> bool:
    last = stage.driver.received(ODOM, -1)
    return bool(last) and max(map(abs, last[0][2][5:])) < 0.01


def _drive(ground: Ground, stage: Stage, programs: dict[str, Program]) -> str:
    """Drive until they all move the robot; return the first way in which one does not."""

    def one_has_ended() -> bool:
        return any(each.ended for each in programs.values())

    def are_connected() -> bool:
        ends = stage.driver.listeners(JOY), stage.driver.publishers(CMD_VEL)
        return min(ends) >= len(programs) and bool(stage.driver.count(ODOM))

    def moving() -> list[int]:
        return [sum(one[2] != ZERO for one in sent) for sent in _twists(stage).values()]

    stage.wait_for_start(lambda: one_has_ended() or are_connected())
    # The robot obeys a node that has sent it zeros before.
    stage.driver.stream(JOY, [NEUTRAL], 50.0, True)
    stage.wait(lambda: one_has_ended() or min(map(len, _twists(stage).values())) >= 5, 0.5)
    stage.driver.end_stream(JOY)
    stage.driver.stream(JOY, [held(ground, 0.2, 0.3)], 50.0, True)
    stage.wait(lambda: one_has_ended() or (min(moving()) >= 10 and not _robot_rests(stage)), 4.0)
    counts = zip(programs.items(), moving())
    return next((way for (way, each), count in counts if each.ended or not count), "")


def _end(ground: Ground, stage: Stage, programs: dict[str, Program]) -> Endings:
    runner = ground.runner
    launched = stage.driver.node_process(NODES[LAUNCH])
    index = stage.driver.count(CMD_VEL)
    began_s = time.monotonic()  # one clock for all processes
    took_s: dict[str, float] = {}
    for way in (CTRL_C, LAUNCH):
        programs[way].signal(signal.SIGINT)
    stage.driver.kill_node(NODES[KILL])

    def all_gone() -> bool:
        for way, each in programs.items():
            # A launch takes its time, also when its nodes are gone.
            left = way == LAUNCH and launched and not Path(f"/proc/{launched}").exists()
            if each.ended or left:
                took_s.setdefault(way, time.monotonic() - began_s)
        return len(took_s) == len(NODES)

    def stopped() -> dict[str, bool]:
        all_gone()
        sent = _twists(stage, index)
        return {way: way in took_s or ZERO in [one[2] for one in sent[way]] for way in NODES}

    before_s = runner.clock.now()
    stage.wait(lambda: all(stopped().values()), STOP_S)
    in_time = stopped()
    stage.wait(all_gone, GONE_S + 0.5 - (runner.clock.now() - before_s))
    rests = bool(stage.wait(lambda: _robot_rests(stage), STANDS_S)) or not all_gone()
    stage.driver.end_stream(JOY)
    runner.end_all(list(programs.values()), 0.2)
    stage.wait(lambda: not stage.driver.publishers(CMD_VEL), 3.0)
    ends = {}
    for way, sent in _twists(stage, index).items():
        first = next((at for at, (_, _, value) in enumerate(sent) if value == ZERO), None)
        ends[way] = End(
            zero_after_s=None if first is None else max(0.0, sent[first][0] - began_s),
            in_time=in_time[way],
            took_s=took_s.get(way),
            after_zero=sum(value != ZERO for _, _, value in sent[first or 0 :]),
            output=programs[way].output,
        )
    return Endings(ends=ends, robot_rests=rests)
