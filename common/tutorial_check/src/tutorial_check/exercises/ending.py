"""C31 and C32: the class is ended while it drives, in each of the ways there are."""

from __future__ import annotations

import signal
import time
from pathlib import Path
from typing import Any, NamedTuple

from tutorial_check import student_files
from tutorial_check.box import Program
from tutorial_check.course import check
from tutorial_check.exercises.classes import program
from tutorial_check.exercises.driving import CMD_VEL, JOY, NEUTRAL
from tutorial_check.exercises.joystick_task import PACKAGE
from tutorial_check.exercises.robot import held
from tutorial_check.manifests import must_be_launchable
from tutorial_check.model import CannotCheck, Note, Wrong
from tutorial_check.python_facts import PythonFacts
from tutorial_check.scripts import cause_of, crash
from tutorial_check.session import Session
from tutorial_check.simulated_robot import ODOM
from tutorial_check.tracebacks import first_traceback

CTRL_C, KILL, LAUNCH = "Ctrl-C", "rosnode kill", "the end of a launch"
# One node for each way, all at once: each ends in its way, and the robot stands when all have gone.
NODES = {CTRL_C: "/ended_by_ctrl_c", KILL: "/ended_by_kill", LAUNCH: "/ended_with_its_launch"}
STOP_S, GONE_S = 2.0, 3.0  # for the zero, and for the end of the node
STANDS_S = 1.0  # after it, though the stick is still pushed; the robot itself forgets in 0.6 s
ZERO = (0.0,) * 6
LAUNCH_FILE = """<launch>
  <node pkg="{package}" type="{program}" name="{name}" output="screen"/>
</launch>
"""
ARGUMENTS_HINT = "roslaunch gives it arguments such as __name:=...; rospy.myargv() leaves those out"


class End(NamedTuple):
    """What came of ending it in one way."""

    zero_after_s: float | None  # None: it never came
    in_time: bool  # within STOP_S, if it came
    took_s: float | None  # None: it had to be killed
    after_zero: int  # Twists that moved the robot again
    output: str


class Endings:
    """The program, started once for each way, driven and ended."""

    def __init__(self, session: Session, script: str) -> None:
        self._session, self._script = session, script
        must_be_launchable(session)
        with session.stage() as stage:
            self._stage = stage
            robot = stage.start_ours("fake_turtlebot_sim", "fake_turtlebot.py")
            stage.call("advertise", JOY, "Joy")
            stage.call("listen", CMD_VEL, "Twist")
            stage.call("listen", ODOM, "Odometry")
            self._programs = {way: self._start(way) for way in NODES}
            self._drive()
            self._end()
            if robot.ended:
                raise CannotCheck(f"the simulated robot has ended: {robot.output[-200:]}")

    def _start(self, way: str) -> Program:
        name = NODES[way][1:]
        if way != LAUNCH:
            return self._stage.start(PACKAGE, self._script, f"__name:={name}")
        file = self._session.folder / "tmp" / "ended.launch"
        package, program = self._session.task.named(PACKAGE), Path(self._script).name
        text = LAUNCH_FILE.format(package=package, program=program, name=name)
        student_files.put(self._session.folder, file, text)
        return self._stage.launch(["roslaunch", str(file)])

    def _twists(self, since: int = 0) -> dict[str, list[tuple[float, Any]]]:
        """Return {way: [(when, six values)]} that they have sent."""
        heard = self._stage.call("heard", CMD_VEL, since)
        return {
            way: [(when, value) for when, caller, value in heard if caller == name]
            for way, name in NODES.items()
        }

    def _robot_stands(self) -> bool:
        last = self._stage.call("heard", ODOM, -1)
        return bool(last) and max(map(abs, last[0][2][5:])) < 0.01

    def _drive(self) -> None:
        """Return once they all drive the robot. Raises Wrong."""
        stage, programs = self._stage, self._programs

        def one_has_ended() -> bool:
            return any(each.ended for each in programs.values())

        def are_connected() -> bool:
            ends = stage.call("listeners", JOY), stage.call("speakers", CMD_VEL)
            return min(ends) >= len(programs) and bool(stage.call("count", ODOM))

        def moving() -> list[int]:
            return [sum(value != ZERO for _, value in sent) for sent in self._twists().values()]

        stage.wait_for_start(lambda: one_has_ended() or are_connected())
        # The robot obeys a node that has sent it zeros before.
        stage.call("stream", JOY, [NEUTRAL], 50.0, True)
        stage.wait(lambda: one_has_ended() or min(map(len, self._twists().values())) >= 5, 0.5)
        stage.call("end_stream", JOY)
        stage.call("stream", JOY, [held(self._session, 0.2, 0.3)], 50.0, True)
        stage.wait(
            lambda: one_has_ended() or (min(moving()) >= 10 and not self._robot_stands()), 4.0
        )
        for (way, each), count in zip(programs.items(), moving()):
            if each.ended or not count:
                how = "started by a launch file" if way == LAUNCH else "started under another name"
                expected = f"the class drives, {how} as well"
                raise crash(self._session, PACKAGE, each, expected, ARGUMENTS_HINT)

    def _end(self) -> None:
        stage, box = self._stage, self._session.box
        launched = stage.call("node_process", NODES[LAUNCH])
        index = stage.call("count", CMD_VEL)
        began_s = time.monotonic()  # one clock for all processes
        took_s: dict[str, float] = {}
        for way in (CTRL_C, LAUNCH):
            self._programs[way].signal(signal.SIGINT)
        stage.call("kill_node", NODES[KILL])

        def all_gone() -> bool:
            for way, each in self._programs.items():
                # A launch takes its time, also when its nodes are gone.
                left = way == LAUNCH and launched and not Path(f"/proc/{launched}").exists()
                if each.ended or left:
                    took_s.setdefault(way, time.monotonic() - began_s)
            return len(took_s) == len(NODES)

        def stopped() -> dict[str, bool]:
            all_gone()
            sent = self._twists(index)
            return {way: way in took_s or ZERO in [v for _, v in sent[way]] for way in NODES}

        before_s = box.patience.now()
        stage.wait(lambda: all(stopped().values()), STOP_S)
        in_time = stopped()
        stage.wait(all_gone, GONE_S + 0.5 - (box.patience.now() - before_s))
        self.stands = bool(stage.wait(self._robot_stands, STANDS_S)) or not all_gone()
        stage.call("end_stream", JOY)
        box.end_all(list(self._programs.values()), 0.2)
        stage.wait(lambda: not stage.call("speakers", CMD_VEL), 3.0)
        self.ends = {}
        for way, sent in self._twists(index).items():
            first = next((at for at, (_, value) in enumerate(sent) if value == ZERO), None)
            self.ends[way] = End(
                zero_after_s=None if first is None else max(0.0, sent[first][0] - began_s),
                in_time=in_time[way],
                took_s=took_s.get(way),
                after_zero=sum(value != ZERO for _, value in sent[first or 0 :]),
                output=self._programs[way].output,
            )


def _endings(session: Session) -> Any:
    return session.run("endings", lambda: Endings(session, program(session)[0]))


@check("C31", "ended, it stops the robot", "6.2", "C30",
       look="rostopic echo /cmd_vel; Ctrl-C in the node's terminal")  # fmt: skip
def stops(session: Session) -> Note | str | None:
    _, path, _ = program(session)
    endings, facts = _endings(session), session.scripts(PACKAGE)[path]
    call = facts.first("on_shutdown")
    where = f"{path}:{call.line}" if call else path
    expected = "ended while it drives, it sends an all-zero Twist and is gone within 3 s"
    for way, end in endings.ends.items():
        seen, hint = _complaint(end, bool(call))
        if not seen:
            continue
        no_zero = end.zero_after_s is None
        # One that has gone, and whose text knows no shutdown, will not send a zero another time.
        sure = no_zero and end.took_s is not None and not call
        if no_zero or not end.in_time:
            late = _late_zero(facts)
            if late:
                where, hint = f"{path}:{late}", "in shutdown first the zero, then the sleep"
            trace = first_traceback(end.output, str(session.package(PACKAGE).folder))
            if trace:
                place, hint = cause_of(session, PACKAGE, Path(path).name, trace)
                seen, where = trace.error, place or where
                sure = sure or trace.error.startswith(("NameError", "TypeError"))
        raise Wrong(expected, f"after {way}: {seen}", where, hint, sure)
    if not endings.stands:
        expected = "the robot stands within a second of the end of the node"
        hint = "what the program has started ends with it; who publishes? rostopic info /cmd_vel"
        raise Wrong(expected, "the node is gone, and the robot still drives", where, hint)
    return ", ".join(
        f"{way}: zero after {1000 * end.zero_after_s:.0f} ms, gone after {end.took_s:.1f} s"
        for way, end in endings.ends.items()
    )


def _late_zero(facts: PythonFacts) -> int:
    """Return the line of a sleep before the first publish at the end, or 0."""
    sleep, publish = (min(facts.at_end.get(name, [0])) for name in ("sleep", "publish"))
    return sleep if sleep < publish else 0


def _complaint(end: End, is_registered: bool) -> tuple[str, str]:
    """Return (what is wrong with an end, what to do); empty if nothing is."""
    if end.zero_after_s is None:
        hint = "rospy.on_shutdown(self.shutdown), and self.cmd_vel.publish(Twist()) in shutdown"
        if is_registered:
            hint = "shutdown has to publish Twist(), all zero, with the publisher of the callback"
        return "no zero comes: the robot drives on", hint
    if not end.in_time:
        return "the zero comes more than 2 s late", "in shutdown first the zero, then the rest"
    if end.took_s is None:
        hint = "does shutdown come to an end? one second of rest is enough"
        return "it still runs 3 s later", hint
    return "", ""


@check("C32", "nothing follows the zero", "6.2", "C31", look="rostopic echo /cmd_vel")
def nothing_after(session: Session) -> Note | str | None:
    """Note moving Twists after the zero; no failure, as the handout's listing sends some."""
    most = max(end.after_zero for end in _endings(session).ends.values())
    if not most:
        return None
    seen = f"{most} moving Twists followed the zero: the callback goes on during shutdown (the handout's does, too)"
    hint = "self.sub = rospy.Subscriber(...) in __init__; in shutdown self.sub.unregister() first, then the zero"
    return Note(seen, program(session)[1], hint)
