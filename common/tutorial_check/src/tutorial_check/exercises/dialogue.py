"""A Drive of a program beside its text: the facts from which conversation says what is wrong."""

from __future__ import annotations

import collections
import contextlib
import functools
import re
from typing import TYPE_CHECKING, Any, Dict, Iterable

from tutorial_check.causes import with_import
from tutorial_check.changed_programs import unmasked
from tutorial_check.exercises.driving import CMD_VEL, JOY, PACKAGE, drive
from tutorial_check.exercises.files import check_file, crash, silent_end
from tutorial_check.model import Wrong
from tutorial_check.python_text import python_lines

if TYPE_CHECKING:
    from tutorial_check.exercises.driving import Drive
    from tutorial_check.python_facts import PythonFacts
    from tutorial_check.session import Session


STRAYS = 2  # zeros in a row of Joys that may be


class Places(Dict[str, str]):
    """{name of a function: where its first call stands}."""

    def __init__(self, script: str, facts: PythonFacts) -> None:
        super().__init__({name: f"{script}:{each[0].line}" for name, each in facts.calls.items()})
        self._script = script

    def __missing__(self, name: str) -> Any:
        return self._script


class Conversation:
    """A Drive beside the text of its program: the facts of the rows below."""

    def __init__(self, session: Session, seen: Drive) -> None:
        self.session, self.seen, self.script = session, seen, seen.script
        self.facts = session.scripts(PACKAGE)[seen.script]
        self.at = Places(self.script, self.facts)
        self.complaint, self.remark, self.hint = "", "", ""
        self.joy_line = with_import("rospy.Subscriber('/joy', Joy, callback)", "Joy", self.facts)
        self.twist_line = with_import(
            "rospy.Publisher('/cmd_vel', Twist, queue_size=10)", "Twist", self.facts
        )

    # ------------------------------------------------------------------- places in the program

    def _at_line(self, line: int) -> Any:
        return f"{self.script}:{line}" if line else self.script

    @property
    def loop(self) -> Any:
        """Where a loop publishes, or else a Timer or Rate is made."""
        timers = [
            call.line for name in ("Timer", "Rate") for call in self.facts.calls.get(name, [])
        ]
        return self._at_line(next(iter(self.facts.publishing_loops or timers), 0))

    @property
    def second(self) -> Any:
        """Where a second Twist may come from: a second publish in a callback, or a second Subscriber."""
        publishes = self.facts.called_back.get("publish", [])
        subscribers = [call.line for call in self.facts.calls.get("Subscriber", [])]
        lines = (lines[1] for lines in (publishes, subscribers) if len(lines) > 1)
        return self._at_line(next(lines, 0))

    @property
    def sleep(self) -> Any:
        """Where the callback sleeps."""
        return self._at_line(next(iter(self.seen.sleep_lines), 0))

    # ------------------------------------------------------------------------- what was seen

    @property
    def wanted(self) -> Any:
        """The type that the first Subscriber asks for."""
        call = self.facts.first("Subscriber")
        return call.words[1] if call and len(call.words) > 1 else "another type"

    @property
    def carried(self) -> Any:
        """The type on /cmd_vel, if it is no Twist."""
        kind = self.seen.types.get(CMD_VEL)
        refused = any("datatype" in line and CMD_VEL in line for line in self.seen.warnings)
        return kind if kind != "geometry_msgs/Twist" or refused else ""

    def other_topic(self, topics: Iterable[str]) -> Any:
        """Return the first of the topics that is not the one asked for."""
        return next(iter(sorted(set(topics) - {"/rosout", "/clock", JOY})), "")

    @property
    def with_publisher(self) -> Any:
        """Another program of the package that has a Publisher, which the first one lacks."""
        if self.facts.first("Publisher"):
            return ""
        scripts = self.session.scripts(PACKAGE).items()
        return next((path for path, each in scripts if "Publisher" in each.calls), "")

    @property
    def first_version(self) -> Any:
        """The handout's first version in a file of its own, if that displays every Joy."""
        for other, facts in self.session.scripts(PACKAGE).items():
            is_first = "Subscriber" in facts.calls and "Publisher" not in facts.calls
            if other != self.script and is_first and "checked_" not in other:
                with contextlib.suppress(Wrong):
                    check_file(self.session, PACKAGE, other)
                    return other if drive(self.session, other, wants_twist=False).all_shown else ""
                return ""
        return ""

    @property
    def throttled(self) -> Any:
        """The line of a loginfo_throttle that displays Joys now and then; 0 if there is none."""
        calls = (each[0] for name, each in self.facts.calls.items() if name.endswith("_throttle"))
        return next((call.line for call in calls if self.seen.shows_numbers), 0)

    @property
    def found_values(self) -> Any:
        """How many of the six values of one Joy were displayed."""
        values = [f"{abs(axis):.2f}" for axis in self.seen.joys[3][0]]
        return sum(value in self.seen.output for value in values)

    @property
    def calls(self) -> Any:
        """The names of what it calls."""
        return self.facts.calls

    @property
    def has_latch(self) -> bool:
        """Whether its Publisher is latched."""
        publishers = self.facts.calls.get("Publisher", [])
        return any(call.names.get("latch") == "True" for call in publishers)

    @functools.cached_property
    def repeated(self) -> Any:
        """How many Twists came for each Joy, and whether they differ; see repetition()."""
        seen = self.seen
        if seen.has_clock or not seen.samples:
            return 1, False
        return repetition([twist for _, twist in seen.samples], seen.twists)

    @property
    def has_strays(self) -> Any:
        """Whether zeros come between the answers; an odd answer may be such a zero."""
        seen = self.seen
        has_both = len({any(twist) for twist in seen.twists}) == 2
        return seen.strays > STRAYS or (self.complaint and seen.has_clock and has_both)

    # ------------------------------------------------------------------------ why it failed

    def crash(self, hint: str = "") -> Any:
        """Return the Wrong for a program that failed; with an except that hides the cause taken away."""
        session, seen, excepts = self.session, self.seen, self.facts.broad_excepts
        if excepts and not seen.program.spins and (seen.ended_early or not seen.trouble):
            text = unmasked(session.text(PACKAGE, self.script))
            key = ("unmasked", self.script)
            if text:
                copy = session.memo(key, lambda: session.sibling(PACKAGE, self.script, text))
                shown = drive(session, copy)
                if shown.trouble:
                    return self._hidden(shown, crash(session, PACKAGE, shown.program, "", hint))
        return crash(session, PACKAGE, seen.program, "", hint)

    def _hidden(self, shown: Any, wrong: Any) -> Any:
        """Return the same Wrong, with the except that hid it."""
        failed = int(wrong.where.rpartition(":")[2] or 0)
        line = min(self.facts.broad_excepts, key=lambda each: (each < failed, each))
        text = python_lines(self.session.text(PACKAGE, self.script))[line - 1].strip()
        wrong.where = wrong.where.replace(shown.script, self.script)
        wrong.seen += f" (hidden by `{text}` in line {line})"
        return wrong

    @functools.cached_property
    def hidden_crash(self) -> Any:
        """The Wrong for an error that an except hides, or None."""
        wrong = self.crash() if self.facts.broad_excepts else None
        return wrong if wrong and wrong.where else None

    def end(self) -> Any:
        """Return the Wrong for a program that ends at once without an error."""
        wrong = self.crash()
        place, hint = silent_end(self.facts, self.script)
        wrong.where, wrong.hint = wrong.where or place, wrong.hint or hint
        return wrong

    def odd(self) -> Any:
        """Return the Wrong for answers of another rule, at the line that sets the field."""
        line, hint = self._line_of(self.complaint)
        sure = not self.seen.missing and not self.seen.unasked
        return Wrong("", self.complaint, line or self.at["publish"], hint or self.hint, sure)

    def _line_of(self, complaint: str) -> Any:
        """(where the field is set that the complaint names, what to do if the line says that)."""
        field = re.search(r"(linear|angular)\.[xyz]", complaint)
        name = re.escape(field[0]) if field else r"(?:linear\.x|angular\.z)"
        lines = python_lines(self.session.text(PACKAGE, self.script))
        for number, line in enumerate(lines, 1):
            if re.search(name + r"\s*=.*\bbuttons\b(?!.*\baxes\b)", line):
                return f"{self.script}:{number}", "the stick is data.axes, not data.buttons"
            if field and re.search(name + r"\s*[-+*/]?=", line):
                return f"{self.script}:{number}", ""
        return "", ""


def repetition(answers: Any, twists: Any) -> Any:
    """(how many Twists came for each Joy, whether they differ); (1, False) if no such number is clear.

    answers: one Twist for each Joy; twists: all that came meanwhile. Which of them belong to one Joy
    is not looked at, as one may come late: it is counted how often each came.
    """
    count = round(len(twists) / len(answers))
    if count < 2 or abs(len(twists) - count * len(answers)) > 0.1 * len(answers):
        return 1, False
    often = collections.Counter(twists).values()
    return count, sum(times < count for times in often) > 0.5 * len(often)
