"""C29 to C33: the program as a class, and its end while it drives."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from tutorial_check import (
    Note,
    Submission,
    Wrong,
    cause_of,
    check,
    check_file,
    crash,
    last_lines,
    must_be_launchable,
    must_be_one_program,
    must_pass,
    traceback_of,
    without_name,
)

from ..driving import behaviour
from ..driving.main_script import check_manifest
from ..task import PACKAGE
from .class_text import CPP_DIAGNOSES, PYTHON_DIAGNOSES, ClassProgram, program
from .lack_of_zero import lack_of_zero
from .record import KILL, LAUNCH, End, Endings, alone, endings

NAMES_IT = re.compile(r"not defined|NameError")  # without the import
ENDS = "ended while it drives, it sends an all-zero Twist and is gone within 3 s"
AFTER_KILL = "at rosnode kill roscpp closes the topics before the program knows of it"
REPORTS = re.compile(r"Traceback|Error\b|Exception|not defined|exceeded|\[(?:ERROR|FATAL|WARN)\]")


@check("C29", "the program is a class", "6.2", needs="C12", look="rosrun {n.package} THE_CLASS",
       timeless=True)  # fmt: skip
def is_class(submission: Submission) -> Note | str | None:
    made = program(submission)
    must_be_one_program(submission.package(PACKAGE).folder, Path(made.script).name)
    check_file(submission, PACKAGE, made.script)
    check_manifest(submission, made.script)
    diagnoses = PYTHON_DIAGNOSES if made.facts.is_python else CPP_DIAGNOSES
    return must_pass(diagnoses, made) or f"{made.node.name} in {made.path}"


@check("C30", "the class does what the functions did", "6.2", needs=is_class,
       look="rostopic echo {n.cmd_vel}")  # fmt: skip
def behaves(submission: Submission) -> Note | str | None:
    script = program(submission).script
    notes: list[object] = [behaviour.displays(submission, script, few_are_enough=True)]
    behaviours = (behaviour.topics, behaviour.mapping, behaviour.rate)
    notes += [judge(submission, script) for judge in behaviours]
    return next((note for note in notes if isinstance(note, Note)), None)


def _endings(submission: Submission) -> Endings:
    must_be_launchable(submission)
    made = program(submission)
    seen = submission.recording(endings, made.script)
    if seen.program:
        how = "by a launch file" if seen.failed == LAUNCH else "under another name"
        expected = f"the class drives, started {how} as well"
        raise crash(submission, PACKAGE, seen.program, expected, made.words.arguments)
    return seen


@dataclass(frozen=True)
class DrivingEnd:
    """One way to end the class, with its result and its text."""

    submission: Submission
    made: ClassProgram
    way: str
    end: End

    def __str__(self) -> str:
        zero_after_s = self.end.zero_after_s
        zero = "no zero" if zero_after_s is None else f"zero after {1000 * zero_after_s:.0f} ms"
        return f"{self.way}: {zero}, gone after {self.end.took_s:.1f} s"

    @property
    def may_lack_zero(self) -> bool:
        """roscpp answers rosnode kill itself: it closes the topics before the program knows."""
        return self.way == KILL and not self.made.facts.is_python

    @property
    def is_registered(self) -> bool:
        return "on_shutdown" in self.made.facts.calls

    @property
    def where(self) -> str:
        lines = self.made.facts.lines("on_shutdown")
        return self.made.at(lines[0]) if lines else self.made.path

    def wrong(self, seen: str, hint: str, sure: bool = False) -> Wrong:
        return Wrong(ENDS, f"after {self.way}: {seen}", self.where, hint, sure)

    def with_cause(self, wrong: Wrong) -> Wrong:
        """Add the cause to the Wrong for a zero that did not come in time; return it."""
        facts = self.made.facts
        called = facts.called_by("on_shutdown", 0)
        sleep, publish = (min(called.get(name, [0])) for name in ("sleep", "publish"))
        early = (sleep if sleep < publish else 0) if facts.is_python else facts.ending.sleep_first
        if early:
            wrong.where = self.made.at(early)
            wrong.hint = "in shutdown first the zero, then the sleep"
        trace = traceback_of(self.submission, PACKAGE, self.end.output)
        if trace:
            name = Path(self.made.path).name
            place, wrong.hint = cause_of(self.submission, PACKAGE, trace, name)
            wrong.seen, wrong.where = f"after {self.way}: {trace.error}", place or wrong.where
            wrong.sure = wrong.sure or trace.error.startswith(("NameError", "TypeError"))
        return wrong


def no_zero(ending: DrivingEnd) -> Wrong | None:
    if ending.end.zero_after_s is not None or ending.may_lack_zero:
        return None
    facts, hint = ending.made.facts, ending.made.words.stops_robot
    # If it has exited and registers no shutdown, it will not send a zero next time, either.
    sure = ending.end.took_s is not None and not ending.is_registered
    if not facts.is_python:
        line, cause = lack_of_zero(facts)
        wrong = ending.wrong("no zero comes: the robot drives on", cause or hint, sure)
        wrong.where = ending.made.at(line) if line else wrong.where
        return wrong
    if ending.is_registered:
        hint = "shutdown has to publish Twist(), all zero, with the publisher of the callback"
    return ending.with_cause(ending.wrong("no zero comes: the robot drives on", hint, sure))


def late_zero(ending: DrivingEnd) -> Wrong | None:
    if ending.end.in_time:
        return None
    hint = "in shutdown first the zero, then the rest"
    return ending.with_cause(ending.wrong("the zero comes more than 2 s late", hint))


def still_running(ending: DrivingEnd) -> Wrong | None:
    if ending.end.took_s is not None:
        return None
    facts, hint = ending.made.facts, "does shutdown end? one second of rest is enough"
    if not facts.is_python and "signal_shutdown" not in facts.calls:
        hint = "your handler replaces roscpp's: after the zero it has to call ros::shutdown()"
    return ending.wrong("it still runs 3 s later", hint)


@check("C31", "ended, it stops the robot", "6.2", needs=behaves,
       look="rostopic echo {n.cmd_vel}; Ctrl-C in the node's terminal")  # fmt: skip
def stops(submission: Submission) -> Note | str | None:
    made, seen = program(submission), _endings(submission)
    cases = [DrivingEnd(submission, made, way, end) for way, end in seen.ends.items()]
    for ending in cases:
        must_pass((no_zero, late_zero, still_running), ending)
    if not seen.robot_rests:
        expected = "the robot stands within a second of the end of the node"
        hint = "does another node publish, which the program has started? rostopic info "
        hint += submission.task.answers.cmd_vel
        rides = "the node has ended, and the robot still drives"
        raise Wrong(expected, rides, cases[0].where, hint)
    words = ", ".join(map(str, cases))
    lacks_zero = seen.ends[KILL].zero_after_s is None
    return Note(f"{words}; {AFTER_KILL}", cases[0].where) if lacks_zero else words


@check("C32", "nothing follows the zero", "6.2", needs=stops, look="rostopic echo {n.cmd_vel}")
def nothing_after(submission: Submission) -> Note | str | None:
    """Note moving Twists after the zero; they are allowed, as the handout's listing sends some."""
    zeros = (end for end in _endings(submission).ends.values() if end.zero_after_s is not None)
    most = max(end.after_zero for end in zeros)
    if not most:
        return None
    seen = f"{most} moving Twists followed the zero:"
    seen += " the callback goes on during shutdown (the handout's does, too)"
    made = program(submission)
    return Note(seen, made.path, made.words.unsubscribes)


@check("C33", "its errors are seen", "6.2", needs=behaves,
       look="rosrun {n.package} THE_CLASS, without a joystick")  # fmt: skip
def errors_are_seen(submission: Submission) -> Note | str | None:
    made = program(submission)
    # A copy that lacks the import is for Python alone: in C++ it is not built.
    is_python = made.facts.is_python
    text = without_name(submission.text(PACKAGE, made.script), "Joy") if is_python else ""
    seen, excepts = submission.recording(alone, made.script, text or ""), made.facts.broad_excepts
    where = made.at(excepts[0].lineno) if excepts else made.path
    output = seen.program.output
    if seen.ended and not REPORTS.search(output):
        words = f"nobody publishes on {submission.task.names.joy}, and it ends; it printed: "
        words += last_lines(output) or "nothing"
        hint = made.words.waits
        expected = "without a joystick it waits for one, or reports what is missing"
        raise Wrong(expected, words, where, hint)
    if not NAMES_IT.search(seen.broken.output) if seen.broken and seen.broken_ended else excepts:
        words = "except: hides every mistake, a misspelt name as well as Ctrl-C"
        return Note(words, where, "except rospy.ROSInterruptException:")
    if seen.ended:
        return Note(f"without a joystick it ends: {last_lines(output, 1)}", where)
    return None
