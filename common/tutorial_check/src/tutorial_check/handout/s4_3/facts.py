"""A Drive of a program beside its text: the facts from which diagnoses says what is wrong."""

from __future__ import annotations

import collections
import contextlib
import functools
import re
from typing import Sequence

from tutorial_check.handout.changed_programs import unmasked
from tutorial_check.handout.s3.judge import other_topic
from tutorial_check.handout.s4_3 import probes
from tutorial_check.handout.s4_3.drive import Drive, Twist
from tutorial_check.handout.s4_3.record import CMD_VEL, COLOUR, COUNT, JOY, drive
from tutorial_check.handout.task import PACKAGE
from tutorial_check.judge.causes import with_import
from tutorial_check.judge.scripts import check_file, crash, with_end
from tutorial_check.model import Wrong
from tutorial_check.record.session import Session
from tutorial_check.source.python_facts import shows
from tutorial_check.source.python_text import python_lines
from tutorial_check.source.tracebacks import first_traceback

STRAYS = 2  # zeros in a row of Joys that may be


class Facts:
    """A Drive beside the text of its program: the facts of the rows of diagnoses."""

    def __init__(self, session: Session, seen: Drive) -> None:
        self.session, self.seen, self.script = session, seen, seen.script
        self.facts = facts = session.scripts(PACKAGE)[seen.script]
        calls = facts.calls
        self.complaint, self.remark, self.hint = "", "", ""
        self.n, self.a = session.task.names, session.task.answers  # for the texts of the rows
        self.joy, self.cmd_vel = map(session.task.topic, (JOY, CMD_VEL))  # in its program
        # {name of a function: where it is called first}
        places = {name: f"{self.script}:{each[0].line}" for name, each in calls.items()}
        self.at = collections.defaultdict(lambda: self.script, places)

    def _first(self, lines: Sequence[int]) -> str:
        return f"{self.script}:{lines[0]}" if lines else self.script

    @property
    def joy_line(self) -> str:
        line = f"rospy.Subscriber('{self.a.joy}', Joy, callback)"
        return with_import(line, "Joy", self.facts)

    @property
    def twist_line(self) -> str:
        line = f"rospy.Publisher('{self.a.cmd_vel}', Twist, queue_size=10)"
        return with_import(line, "Twist", self.facts)

    @property
    def loop(self) -> str:
        """Where a loop publishes, or else a Timer or Rate is made."""
        timers = [
            call.line for name in ("Timer", "Rate") for call in self.facts.calls.get(name, [])
        ]
        return self._first(self.facts.publishing_loops or timers)

    @property
    def second(self) -> str:
        """Where a second Twist may come from: a second publish in a callback, or a second Subscriber."""
        publishes = self.facts.called_back.get("publish", [])
        subscribers = [call.line for call in self.facts.calls.get("Subscriber", [])]
        return self._first([each[1] for each in (publishes, subscribers) if len(each) > 1])

    @property
    def sleep(self) -> str:
        return self._first(self.seen.sleep_lines)

    @property
    def wanted(self) -> str:
        """The type that its Subscriber asks for."""
        call = self.facts.first("Subscriber")
        return call.words[1] if call and len(call.words) > 1 else "another type"

    @property
    def carried(self) -> str | None:
        """The type of its velocities, if that is another; or empty."""
        kind, warnings = self.seen.types.get(self.cmd_vel), self.seen.warnings
        refused = any("datatype" in line and self.cmd_vel in line for line in warnings)
        return kind if kind != "geometry_msgs/Twist" or refused else ""

    @property
    def heard_on(self) -> str:
        return other_topic(self.seen.subscribers, self.joy, self.seen.types, "sensor_msgs/Joy")

    @property
    def sent_on(self) -> str:
        return other_topic(self.seen.publishers, self.joy, self.seen.types, "geometry_msgs/Twist")

    @property
    def drivers(self) -> list[str]:
        return sorted(set(self.seen.publishers.get(self.cmd_vel, ())))

    @property
    def has_latch(self) -> bool:
        return any(
            call.names.get("latch") == "True" for call in self.facts.calls.get("Publisher", [])
        )

    @property
    def first_version(self) -> str:
        """The separate file with the handout's first version, if that displays every Joy."""
        for other, facts in self.session.scripts(PACKAGE).items():
            is_first = "Subscriber" in facts.calls and "Publisher" not in facts.calls
            if other != self.script and is_first and "checked_" not in other:
                with contextlib.suppress(Wrong):
                    check_file(self.session, PACKAGE, other)
                    seen = self.session.recording(drive, other, False)
                    return other if seen.all_shown else ""
                return ""
        return ""

    @property
    def throttled(self) -> int:
        """The line of a loginfo_throttle that displays Joys now and then; 0 if there is none."""
        calls = (each[0] for name, each in self.facts.calls.items() if name.endswith("_throttle"))
        return next((call.line for call in calls if self.seen.shows_numbers), 0)

    def found_values(self, within: float = probes.ROUNDED) -> int:
        return probes.values_shown(
            probes.numbered_joys(COUNT), COLOUR.sub("", self.seen.output), within
        )

    @functools.cached_property
    def repeated(self) -> tuple[int, bool]:
        seen = self.seen
        if seen.has_clock or not seen.samples:
            return 1, False
        return repetition([twist for _, twist in seen.samples], seen.twists)

    @property
    def has_strays(self) -> bool:
        """Return whether zeros come between the answers; an odd answer may be such a zero."""
        seen = self.seen
        has_both = len({any(twist) for twist in seen.twists}) == 2
        return seen.strays > STRAYS or bool(self.complaint and seen.has_clock and has_both)

    # ------------------------------------------------------------------------ why it failed

    def crash(self) -> Wrong:
        session, seen = self.session, self.seen
        text = unmasked(session.text(PACKAGE, self.script))
        if text and not seen.program.spins and (seen.ended_early or not seen.trouble):
            shown = session.recording(drive, self.script, True, text)
            if shown.trouble:
                return self._hidden(shown, crash(session, PACKAGE, shown.program, ""))
        return crash(session, PACKAGE, seen.program, "")

    def _hidden(self, shown: Drive, wrong: Wrong) -> Wrong:
        """Return the same Wrong, with the except if that is what hid it."""
        wrong.where = wrong.where.replace(shown.script, self.script)
        trace = first_traceback(shown.output, str(self.session.package(PACKAGE).folder))
        catcher = self.facts.catcher(trace.lines_of(shown.script)) if trace else None
        if trace and catcher and trace.message not in self.seen.output:
            text = python_lines(self.session.text(PACKAGE, self.script))[catcher.lineno - 1].strip()
            how = "{} shows another text" if shows(catcher) else "hidden by {}"
            wrong.seen += f" ({how.format(f'`{text}` in line {catcher.lineno}')})"
        return wrong

    @functools.cached_property
    def hidden_crash(self) -> Wrong | None:
        wrong = self.crash() if self.facts.broad_excepts else None
        return wrong if wrong and wrong.where else None

    def end(self) -> Wrong:
        return with_end(self.crash(), self.facts, self.script)

    def odd(self) -> Wrong:
        """Return the Wrong for answers of another rule, at the line that sets the field."""
        where, hint = self.at["publish"], self.hint
        field = re.search(r"(linear|angular)\.[xyz]", self.complaint)
        name = re.escape(field[0]) if field else r"(?:linear\.x|angular\.z)"
        for number, line in enumerate(python_lines(self.session.text(PACKAGE, self.script)), 1):
            if re.search(name + r"\s*=.*\bbuttons\b(?!.*\baxes\b)", line):
                where, hint = f"{self.script}:{number}", "the stick is data.axes, not data.buttons"
                break
            if field and re.search(name + r"\s*[-+*/]?=", line):
                where = f"{self.script}:{number}"
                break
        sure = not (self.seen.missing or self.seen.unasked)
        return Wrong("", self.complaint, where, hint, sure)


def repetition(answers: Sequence[Twist], twists: Sequence[Twist]) -> tuple[int, bool]:
    """Return (how many Twists came for each Joy, whether they differ); (1, False) if unclear.

    answers: one Twist for each Joy; twists: all that came meanwhile. Which of them belong to one Joy
    is not looked at, as one may come late: it is counted how often each came.
    """
    count = round(len(twists) / len(answers))
    if count < 2 or abs(len(twists) - count * len(answers)) > 0.1 * len(answers):
        return 1, False
    often = collections.Counter(twists).values()
    return count, sum(times < count for times in often) > 0.5 * len(often)
