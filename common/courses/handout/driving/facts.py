"""A Drive of a program beside its text: the facts from which the judge says what is wrong."""

from __future__ import annotations

import collections
import contextlib
import functools
import re
from typing import Sequence

from tutorial_check import (
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
from . import probes
from .record import COLOUR, COUNT, drive
from .run import Drive, Twist


class Facts:
    """A Drive beside the text of its program: the facts of the rows of the judge."""

    def __init__(self, submission: Submission, seen: Drive) -> None:
        self.submission, self.seen = submission, seen
        self.facts = facts = submission.scripts(PACKAGE)[seen.script]
        self.complaint, self.hint = "", ""  # as rules.judge() returns them
        self.n, self.a = submission.task.names, submission.task.answers  # for the texts of the rows
        subscriber = f"rospy.Subscriber('{self.a.joy}', Joy, callback)"
        publisher = f"rospy.Publisher('{self.a.cmd_vel}', Twist, queue_size=10)"
        lines = {"Joy": subscriber, "Twist": publisher}  # to be written
        self.line = {kind: with_import(line, kind, facts) for kind, line in lines.items()}
        # {name of a function, or what else a row blames: its lines, the first of which is named}
        blamed: dict[str, Sequence[int]] = {name: facts.lines(name) for name in facts.calls}
        blamed["loop"] = facts.publishing_loops or facts.lines("Timer", "Rate")
        blamed["sleep"] = seen.sleep_lines
        # Where a second Twist may come from: another publish in a callback, or another Subscriber.
        several = (facts.called_back.get("publish", []), facts.lines("Subscriber"))
        blamed["second"] = [each[1] for each in several if len(each) > 1]
        places = {name: f"{seen.script}:{found[0]}" for name, found in blamed.items() if found}
        self.at = collections.defaultdict(lambda: seen.script, places)
        self.elsewhere = {
            "Joy": other_topic(seen.subscribers, self.a.joy, seen.types, "sensor_msgs/Joy"),
            "Twist": other_topic(seen.publishers, self.a.joy, seen.types, "geometry_msgs/Twist"),
        }
        self.drivers = sorted(set(seen.publishers.get(self.a.cmd_vel, ())))
        self.repeated = (1, False)  # how many Twists for each Joy, and whether they differ
        if seen.samples and not seen.has_clock:
            self.repeated = repetition([twist for _, twist in seen.samples], seen.twists)

    @property
    def wanted(self) -> str:
        """The type of message that its Subscriber asks for."""
        asked = self.facts.first("Subscriber")
        return asked.words[1] if asked and len(asked.words) > 1 else "another type"

    @property
    def carried(self) -> str:
        """The type of its velocities, if that is another; rospy says whose types differ."""
        kind = self.seen.types.get(self.a.cmd_vel, "")
        refused = "".join(each for each in self.seen.warnings if "datatype" in each)
        return kind if kind != "geometry_msgs/Twist" or self.a.cmd_vel in refused else ""

    @property
    def first_version(self) -> str:
        """The separate file with the handout's first version, if that displays every Joy."""
        for other, facts in self.submission.scripts(PACKAGE).items():
            is_first = "Subscriber" in facts.calls and "Publisher" not in facts.calls
            if other != self.seen.script and is_first:
                with contextlib.suppress(Wrong):
                    check_file(self.submission, PACKAGE, other)
                    return other if self.submission.recording(drive, other, False).all_shown else ""
                break
        return ""

    def found_values(self, within: float = probes.ROUNDED) -> int:
        output = COLOUR.sub("", self.seen.output)
        return probes.values_shown(probes.numbered_joys(COUNT), output, within)

    def crash(self) -> Wrong:
        submission, seen = self.submission, self.seen
        text = unmasked(submission.text(PACKAGE, seen.script))
        if text and not seen.program.spins and (seen.ended_early or not seen.trouble):
            shown = submission.recording(drive, seen.script, True, text)
            if shown.trouble:
                wrong = crash(submission, PACKAGE, shown.program, "")
                wrong.seen += self._hidden_by(shown)
                return wrong
        return crash(submission, PACKAGE, seen.program, "")

    def _hidden_by(self, shown: Drive) -> str:
        """Return which except hid the error that a changed program shows; empty if none did."""
        trace = first_traceback(shown.output, str(self.submission.package(PACKAGE).folder))
        catcher = self.facts.catcher(trace.lines_of(shown.script)) if trace else None
        if not trace or not catcher or trace.message in self.seen.output:
            return ""
        text = f"`{self.facts.text[catcher.lineno].strip()}` in line {catcher.lineno}"
        return f" ({text} shows another text)" if shows(catcher) else f" (hidden by {text})"

    @functools.cached_property
    def hidden_crash(self) -> Wrong | None:
        wrong = self.crash() if self.facts.broad_excepts else None
        return wrong if wrong and wrong.where else None

    def end(self) -> Wrong:
        return Script(self.submission, PACKAGE, self.seen.script).with_end(self.crash())

    def odd(self) -> Wrong:
        """Return the Wrong for answers of another rule, at the line that sets the field."""
        where, hint = self.at["publish"], self.hint
        field = re.search(r"(linear|angular)\.[xyz]", self.complaint)
        name = re.escape(field[0]) if field else r"(?:linear\.x|angular\.z)"
        for number, line in self.facts.text.items():
            takes_buttons = re.search(name + r"\s*=.*\bbuttons\b(?!.*\baxes\b)", line)
            if takes_buttons or (field and re.search(name + r"\s*[-+*/]?=", line)):
                where = f"{self.seen.script}:{number}"
                hint = "the stick is data.axes, not data.buttons" if takes_buttons else hint
                break
        return Wrong("", self.complaint, where, hint, not (self.seen.missing or self.seen.unasked))


def repetition(answers: Sequence[Twist], twists: Sequence[Twist]) -> tuple[int, bool]:
    """Return (how many Twists came for each Joy, whether they differ); (1, False) if unclear.

    answers: one for each Joy; twists: all. One may come late: so it is counted how often each came.
    """
    count = round(len(twists) / len(answers))
    if count < 2 or abs(len(twists) - count * len(answers)) > 0.1 * len(answers):
        return 1, False
    often = collections.Counter(twists).values()
    return count, sum(times < count for times in often) > 0.5 * len(often)
