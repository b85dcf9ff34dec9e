"""C31 and C32: the class is ended while it drives."""

from __future__ import annotations

from pathlib import Path

from tutorial_check.course import check
from tutorial_check.handout.s6_2.judge import program
from tutorial_check.handout.s6_2.record import LAUNCH, End, Endings, endings
from tutorial_check.handout.task import PACKAGE
from tutorial_check.judge.scripts import cause_of, crash
from tutorial_check.model import Note, Wrong
from tutorial_check.record.session import Session
from tutorial_check.source.python_facts import PythonFacts
from tutorial_check.source.tracebacks import first_traceback

ARGUMENTS_HINT = "roslaunch gives it arguments such as __name:=...; rospy.myargv() leaves those out"


def _endings(session: Session) -> Endings:
    session.must_be_launchable()
    found = session.recording(endings, program(session)[0])
    if found.program:
        started = (
            "started by a launch file" if found.failed == LAUNCH else "started under another name"
        )
        expected = f"the class drives, {started} as well"
        raise crash(session, PACKAGE, found.program, expected, ARGUMENTS_HINT)
    return found


@check("C31", "ended, it stops the robot", "6.2", "C30",
       look="rostopic echo {n.cmd_vel}; Ctrl-C in the node's terminal")  # fmt: skip
def stops(session: Session) -> Note | str | None:
    _, path, _ = program(session)
    seen, facts = _endings(session), session.scripts(PACKAGE)[path]
    call = facts.first("on_shutdown")
    where = f"{path}:{call.line}" if call else path
    expected = "ended while it drives, it sends an all-zero Twist and is gone within 3 s"
    for way, end in seen.ends.items():
        words, hint = _complaint(end, bool(call))
        if not words:
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
                words, where = trace.error, place or where
                sure = sure or trace.error.startswith(("NameError", "TypeError"))
        raise Wrong(expected, f"after {way}: {words}", where, hint, sure)
    if not seen.robot_rests:
        expected = "the robot stands within a second of the end of the node"
        hint = "what the program has started ends with it; who publishes? rostopic info "
        hint += session.task.answers.cmd_vel
        raise Wrong(expected, "the node is gone, and the robot still drives", where, hint)
    return ", ".join(
        f"{way}: zero after {1000 * (end.zero_after_s or 0.0):.0f} ms, gone after {end.took_s:.1f} s"
        for way, end in seen.ends.items()
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


@check("C32", "nothing follows the zero", "6.2", "C31", look="rostopic echo {n.cmd_vel}")
def nothing_after(session: Session) -> Note | str | None:
    """Note moving Twists after the zero; no failure, as the handout's listing sends some."""
    most = max(end.after_zero for end in _endings(session).ends.values())
    if not most:
        return None
    seen = f"{most} moving Twists followed the zero: the callback goes on during shutdown (the handout's does, too)"
    hint = "self.sub = rospy.Subscriber(...) in __init__; in shutdown self.sub.unregister() first, then the zero"
    return Note(seen, program(session)[1], hint)
