"""C31 and C32: the class is ended while it drives, in each of the ways there are."""

from __future__ import annotations

import time
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tutorial_check import student_files
from tutorial_check.course import check
from tutorial_check.exercises.classes import program
from tutorial_check.exercises.driving import CMD_VEL, JOY, NEUTRAL
from tutorial_check.exercises.joystick_task import PACKAGE
from tutorial_check.exercises.robot import ODOM, held
from tutorial_check.manifests import must_be_launchable
from tutorial_check.model import CannotCheck, Note, Wrong
from tutorial_check.scripts import cause_of, crash
from tutorial_check.tracebacks import first_traceback

if TYPE_CHECKING:
    from tutorial_check.python_facts import PythonFacts
    from tutorial_check.session import Session


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
ARGUMENTS_HINT = (
    "roslaunch gives it arguments such as __name:=...; rospy.myargv() is sys.argv without those"
)


@dataclass
class End:
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

    def _start(self, way: Any) -> Any:
        name = NODES[way][1:]
        if way != LAUNCH:
            return self._stage.start(PACKAGE, self._script, f"__name:={name}")
        file = self._session.folder / "tmp" / "ended.launch"
        program_name = Path(self._script).name
        package = self._session.task.named(PACKAGE)
        text = LAUNCH_FILE.format(package=package, program=program_name, name=name)
        student_files.put(self._session.folder, file, text)
        return self._stage.launch(["roslaunch", str(file)])

    def _twists(self, since: int = 0) -> Any:
        """{way: [(when, six values)]} that they have sent."""
        sent: dict[str, list[Any]] = {name: [] for name in NODES.values()}
        for when, caller, value in self._stage.call("heard", CMD_VEL, since):
            if caller in sent:
                sent[caller].append((when, value))
        return {way: sent[name] for way, name in NODES.items()}

    def _robot_stands(self) -> Any:
        last = self._stage.call("heard", ODOM, -1)
        return bool(last) and max(map(abs, last[0][2][5:])) < 0.01

    def _drive(self) -> None:
        """Return once they all drive the robot. Raises Wrong."""
        stage, programs = self._stage, self._programs

        def one_has_ended() -> bool:
            return any(each.ended for each in programs.values())

        def have_sent(count: int, which: Any) -> bool:
            return all(sum(map(which, sent)) >= count for sent in self._twists().values())

        def moves(twist: Any) -> Any:
            return twist[1] != ZERO

        stage.wait_for_start(
            lambda: (
                one_has_ended()
                or (
                    stage.call("listeners", JOY) >= len(programs)
                    and stage.call("speakers", CMD_VEL) >= len(programs)
                    and stage.call("count", ODOM)
                )
            )
        )
        # The robot obeys whoever has told it to rest before.
        stage.call("stream", JOY, [NEUTRAL], 50.0, True)
        stage.wait(lambda: one_has_ended() or have_sent(5, bool), 0.5)
        stage.call("end_stream", JOY)
        stage.call("stream", JOY, [held(self._session, 0.2, 0.3)], 50.0, True)
        stage.wait(
            lambda: one_has_ended() or (have_sent(10, moves) and not self._robot_stands()), 4.0
        )
        sent = self._twists()
        for way, each in programs.items():
            if each.ended or not any(map(moves, sent[way])):
                how = "started by a launch file" if way == LAUNCH else "started under another name"
                expected = f"the class drives, {how} as well"
                raise crash(self._session, PACKAGE, each, expected, ARGUMENTS_HINT)

    def _end(self) -> None:
        stage, box = self._stage, self._session.box
        launched = stage.call("node_process", NODES[LAUNCH])
        index = stage.call("count", CMD_VEL)
        began_s = time.monotonic()  # one clock for all processes
        took_s, in_time = dict.fromkeys(NODES), dict.fromkeys(NODES, False)
        box.interrupt(self._programs[CTRL_C])
        box.interrupt(self._programs[LAUNCH])
        stage.call("kill_node", NODES[KILL])

        def all_gone() -> bool:
            for way, each in self._programs.items():
                # A launch takes its time, also when its nodes are gone.
                left = way == LAUNCH and launched and not Path(f"/proc/{launched}").exists()
                if (each.ended or left) and took_s[way] is None:
                    took_s[way] = time.monotonic() - began_s
            return all(took_s.values())

        def all_stopped() -> bool:
            all_gone()
            for way, sent in self._twists(index).items():
                in_time[way] = bool(took_s[way]) or any(value == ZERO for _, value in sent)
            return all(in_time.values())

        before_s = box.patience.now()
        stage.wait(all_stopped, STOP_S)
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
                took_s=took_s[way],
                after_zero=sum(value != ZERO for _, value in sent[first or 0 :]),
                output=self._programs[way].output,
            )


def _endings(session: Session) -> Any:
    return session.run("endings", lambda: Endings(session, program(session)[0]))


@check(
    "C31",
    "ended, it stops the robot",
    "6.2",
    "C30",
    look="rostopic echo /cmd_vel; Ctrl-C in the node's terminal",
)
def stops(session: Session) -> Note | str | None:
    """Judge whether it stops the robot at its end."""
    _, path, _ = program(session)
    endings = _endings(session)
    call = session.scripts(PACKAGE)[path].first("on_shutdown")
    where = f"{path}:{call.line}" if call else path
    expected = "ended while it drives, it sends an all-zero Twist and is gone within 3 s"
    for way, end in endings.ends.items():
        seen, hint = _complaint(end, bool(call))
        if not seen:
            continue
        late = _late_zero(session.scripts(PACKAGE)[path])
        if late and (end.zero_after_s is None or not end.in_time):
            where, hint = f"{path}:{late}", "in shutdown first the zero, then the sleep"
        # One that has gone, and whose text knows no shutdown, will not send a zero another time.
        sure = end.zero_after_s is None and end.took_s is not None and not call
        trace = first_traceback(end.output, str(session.package(PACKAGE).folder))
        if trace and (end.zero_after_s is None or not end.in_time):
            place, hint = cause_of(session, PACKAGE, Path(path).name, trace)
            seen, where = trace.error, place or where
            sure = sure or trace.error.startswith(("NameError", "TypeError"))  # no matter of time
        raise Wrong(expected, f"after {way}: {seen}", where=where, hint=hint, sure=sure)
    if not endings.stands:
        raise Wrong(
            "the robot stands within a second of the end of the node",
            "the node is gone, and the robot still drives",
            where=where,
            hint="whatever the program has started ends with it; who publishes? rostopic info /cmd_vel",
        )
    return ", ".join(
        f"{way}: zero after {1000 * end.zero_after_s:.0f} ms, gone after {end.took_s:.1f} s"
        for way, end in endings.ends.items()
    )


def _late_zero(facts: PythonFacts) -> Any:
    """Return the line of a sleep before the first publish at the end, or 0."""
    sleep, publish = (min(facts.at_end.get(name, [0])) for name in ("sleep", "publish"))
    return sleep if sleep < publish else 0


def _complaint(end: Any, is_registered: Any) -> Any:
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
    """Never a failure: the handout's listing does it."""
    most = max(end.after_zero for end in _endings(session).ends.values())
    if most:
        return Note(
            f"{most} moving Twists followed the zero: the callback goes on during shutdown (the handout's does, too)",
            program(session)[1],
            "self.sub = rospy.Subscriber(...) in __init__; in shutdown self.sub.unregister() first, then the zero",
        )
    return None
