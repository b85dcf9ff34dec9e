"""A run of a program together with its text, for the diagnoses."""

from __future__ import annotations

import collections
import contextlib
import functools
import re
from typing import Sequence

from tutorial_check import (
    Note,
    Script,
    Submission,
    Wrong,
    check_file,
    crash,
    first_traceback,
    shows,
    unmasked,
    with_import,
)

from ..task import PACKAGE, other_topic
from .field_diagnoses import rule_verdict
from .joy2twist_run import Joy2TwistRun, Twist
from .joys import ROUNDED, numbered_joys, values_displayed
from .probe_diagnoses import probe_verdict
from .record import drive

DISPLAYS = re.compile(r"log|print")


class Joy2TwistNode:
    """A run of a program together with its text."""

    def __init__(self, submission: Submission, run: Joy2TwistRun) -> None:
        self.submission, self.run, self.script = submission, run, run.script
        facts = submission.facts_of(PACKAGE, run.script)
        assert facts, run.script
        self.source = facts
        # The task's values in messages: by name, or in hints as they are.
        self.names, self.answers = submission.task.names, submission.task.answers
        self.graph = graph = run.connections
        joy, types = self.answers.joy, graph.types
        self.joys_elsewhere = other_topic(graph.subscribers, joy, types, "sensor_msgs/Joy")
        self.twists_elsewhere = other_topic(graph.publishers, joy, types, "geometry_msgs/Twist")
        self.drivers = sorted(set(graph.publishers.get(self.answers.cmd_vel, ())))
        self.repeated = (1, False)  # (Twists for each Joy, whether they differ)
        if run.numbered.samples and not run.numbered.has_clock:
            answers = [twist for _, twist in run.numbered.samples]
            self.repeated = repetition(answers, run.numbered.twists)

    def at(self, lines: Sequence[int]) -> str:
        """Return FILE:LINE of the first of the lines, or the file."""
        return self.source.place(self.script, lines[0] if lines else 0)

    def at_call(self, name: str) -> str:
        return self.at(self.source.lines(name))

    def private(self, kind: str, seen: str) -> Wrong | None:
        """Return the Wrong for a Publisher or Subscriber of a private NodeHandle, or None."""
        line = dict(self.source.oddities.private).get(kind, 0)
        hint = 'NodeHandle("~") puts the node\'s name before a topic: ros::NodeHandle n; for topics'
        return Wrong("", seen, self.at([line]), hint) if line else None

    @property
    def loop(self) -> str:
        """Where it publishes at a fixed rate."""
        return self.at(self.source.publishing_loops or self.source.lines("Timer", "Rate"))

    @property
    def display(self) -> str:
        """Where its callback displays something."""
        called = self.source.called_back.items()
        return self.at([n for name, lines in called if DISPLAYS.match(name) for n in lines])

    @property
    def callback(self) -> str:
        """Where its callback begins."""
        functions = (name for _, name in self.source.given("Subscriber", 2))
        return self.at([self.source.functions.get(name, 0) for name in functions])

    @property
    def second_publish(self) -> str:
        """Where a second Twist may come from: another publish() or Subscriber."""
        several = (self.source.called_back.get("publish", []), self.source.lines("Subscriber"))
        seconds = [lines[1:] for lines in several if len(lines) > 1]
        return self.at(seconds[-1] if seconds else [])

    @property
    def subscriber(self) -> str:
        """The line to write that subscribes to Joys."""
        line = self.source.idioms.subscriber(self.answers.joy, "Joy")
        return with_import(line, "Joy", self.source)

    @property
    def publisher(self) -> str:
        line = self.source.idioms.publisher(self.answers.cmd_vel, "Twist")
        return with_import(line, "Twist", self.source)

    @functools.cached_property
    def rule_verdict(self) -> Wrong | Note | None:
        """The Wrong for the rule of its answers, or a Note on it."""
        task = self.submission.task
        verdict = rule_verdict(self.run.evidence(task))
        if isinstance(verdict, Wrong):
            return verdict
        return probe_verdict(self.run.replies(task)) or verdict

    @property
    def is_odd(self) -> bool:
        return isinstance(self.rule_verdict, Wrong)

    @property
    def carried(self) -> str:
        """The type of its velocities, if it is wrong; rospy warns of types that differ."""
        cmd_vel = self.answers.cmd_vel
        kind = self.graph.types.get(cmd_vel, "")
        refused = "".join(line for line in self.graph.warnings if "datatype" in line)
        return kind if kind != "geometry_msgs/Twist" or cmd_vel in refused else ""

    @property
    def first_version(self) -> str:
        """The separate file with the handout's first version, if it displays every Joy."""
        for script, source in self.submission.programs(PACKAGE).items():
            is_first = "Subscriber" in source.calls and "Publisher" not in source.calls
            if script != self.script and is_first:
                with contextlib.suppress(Wrong):
                    check_file(self.submission, PACKAGE, script)
                    run = self.submission.recording(drive, script, False)
                    return script if run.numbered.all_displayed else ""
                break
        return ""

    def values_displayed(self, within: float = ROUNDED) -> int:
        return values_displayed(numbered_joys(), self.run.ending.output, within)

    def crash(self) -> Wrong:
        """Return the Wrong for its end or traceback, even if an except hides it."""
        submission, run = self.submission, self.run
        text = unmasked(submission.text(PACKAGE, self.script)) if self.source.is_python else None
        if text and not run.program.spins and (run.ending.early or not run.has_traceback):
            bare = submission.recording(drive, self.script, True, text)
            if bare.has_traceback:
                wrong = crash(submission, PACKAGE, bare.program, "")
                wrong.seen += self._hidden_by(bare)
                return wrong
        return crash(submission, PACKAGE, run.program, "")

    def _hidden_by(self, bare: Joy2TwistRun) -> str:
        """Return words for the except that hid the error of a changed program; "" if none did."""
        folder = str(self.submission.package(PACKAGE).folder)
        trace = first_traceback(bare.ending.output, folder)
        catcher = self.source.catcher(trace.lines_of(bare.script)) if trace else None
        if not trace or not catcher or trace.message in self.run.ending.output:
            return ""
        text = f"`{self.source.text[catcher.lineno].strip()}` in line {catcher.lineno}"
        return f" ({text} shows another text)" if shows(catcher) else f" (hidden by {text})"

    @functools.cached_property
    def hidden_crash(self) -> Wrong | None:
        wrong = self.crash() if self.source.broad_excepts else None
        return wrong if wrong and wrong.where else None

    def end(self) -> Wrong:
        return Script(self.submission, PACKAGE, self.script).with_end(self.crash())


def repetition(answers: Sequence[Twist], twists: Sequence[Twist]) -> tuple[int, bool]:
    """Return (Twists for each Joy, whether they differ); (1, False) if that is unclear.

    answers: one for each Joy. twists: all. Because a Twist may be late, equal Twists are counted.
    """
    count = round(len(twists) / len(answers))
    if count < 2 or abs(len(twists) - count * len(answers)) > 0.1 * len(answers):
        return 1, False
    often = collections.Counter(twists).values()
    return count, sum(times < count for times in often) > 0.5 * len(often)
