"""A class at a glance: the table of --all as a page and as CSV, and what lies below it (pure)."""

from __future__ import annotations

import csv
import io
import re
from collections import Counter
from dataclasses import dataclass, field, replace
from html import escape
from pathlib import Path
from typing import Any, Iterable, Iterator, Mapping, Sequence
from urllib.parse import quote

from tutorial_check.examination import Outcome
from tutorial_check.hints import cause_of
from tutorial_check.model import NOTE, WRONG, Result
from tutorial_check.report import lines_of

# Where a spreadsheet begins a cell, whatever it takes for what separates two; and then a formula.
FORMULA = re.compile(r"(^|[;,|\t\r\n])(?=\s*[=+\-@])")
LEGEND = {
    "ok": "all checks of the exercise hold",
    "C16": "the first check that is wrong, and what was seen; the pointer shows the rest",
    "-": "not reached: what comes before it is wrong",
    "not done": "there was nothing to check",
    "?": "could not be checked, through no fault of the student's",
    "...": "is being checked",
}
LONGEST = 70  # characters of a cause in a cell
MOST_CAUSES = 10
WORDS = ("expected", "seen", "where", "hint")  # of a Result, in its order
# No script, no picture, nothing from elsewhere: whatever stands in a name or in an output.
POLICY = "default-src 'none'; style-src 'unsafe-inline'"
STYLE = """
body{font-family:sans-serif}td,th{padding:.2em .6em;border:1px solid #ccc;vertical-align:top}
table{border-collapse:collapse}.ok{background:#cfc}.wrong{background:#fcc}.no{color:#777}
small{display:block;max-width:16em;overflow-wrap:anywhere}.bar{background:#c66;height:.8em}
@media print{body{font-size:9pt}tr{break-inside:avoid}a{color:#000;text-decoration:none}
.wrong{font-weight:bold}.bar{border-top:.8em solid #555}}
"""
KINDS = {"ok": "ok", "-": "no", "?": "no", "not done": "no", "...": "no"}


@dataclass
class Student:
    """One workspace, or zip. before: what came of the last run, if there was one."""

    name: str
    path: Path
    outcomes: list[Outcome] = field(default_factory=list)
    trouble: str = ""  # why nothing could be checked
    seconds: float = 0.0
    before: list[Outcome] = field(default_factory=list)

    def cell(self, exercise: str) -> tuple[str, str]:
        """Return a word and details for an exercise: ok, the check that is wrong, -, ? or ... ."""
        if not self.outcomes:
            return ("?", self.trouble) if self.trouble else ("...", "")
        outcome = next(each for each in self.outcomes if each.id == exercise)
        if outcome.empty:
            return "not done", "nothing to check"
        if outcome.passed:
            return "ok", ""
        wrong = first_wrong(outcome)
        if wrong:
            return wrong.id, "\n".join(lines_of(wrong))
        return ("?", outcome.trouble) if outcome.trouble else ("-", "not reached")

    @property
    def done(self) -> str:
        """How many exercises, as "5 of 9"."""
        done = sum(outcome.passed and not outcome.empty for outcome in self.outcomes)
        return f"{done} of {len(self.outcomes)}" if self.outcomes else ""

    @property
    def notes(self) -> int:
        """How many checks hold with something worth knowing."""
        return sum(one.status == NOTE and not one.empty for one in _results([self]))

    @property
    def first(self) -> Result | None:
        """The first check that is wrong."""
        return next((one for one in _results([self]) if one.status == WRONG), None)


def first_wrong(outcome: Outcome) -> Result | None:
    """Return the first check of an exercise that is wrong."""
    return next((one for one in outcome.results if one.status == WRONG), None)


def _results(students: Iterable[Student]) -> Iterator[Result]:
    return (one for each in students for outcome in each.outcomes for one in outcome.results)


def table_csv(students: Iterable[Student], exercises: Sequence[str]) -> str:
    """Return one line a student, without what a spreadsheet would take for a formula."""
    lines = io.StringIO()
    table = csv.writer(lines)
    table.writerow(["student", *exercises, "done", "notes", "seconds", "first cause", "remark"])
    for student in students:
        cells = [student.cell(exercise)[0] for exercise in exercises]
        cause = student.first.seen if student.first else ""
        name, cause, remark = (
            FORMULA.sub(r"\1'", text) for text in (student.name, cause, student.trouble)
        )
        about = (cells.count("ok"), student.notes, f"{student.seconds:.1f}", cause, remark)
        table.writerow([name, *cells, *about])
    return lines.getvalue()


def table_html(
    students: Sequence[Student], exercises: Sequence[str], titles: Mapping[str, str]
) -> str:
    """Return the page. While students are still being checked it loads itself anew."""
    heads = ["student", *(f"{each}<small>{escape(titles[each])}</small>" for each in exercises)]
    rows = [_row((*heads, "done", "notes", "took"), "th")]
    for student in students:
        link = quote(f"{student.name}.txt", errors="surrogateescape")  # a name may be no UTF-8
        row = f'<td><a href="./{link}">{escape(student.name)}</a></td>'
        row += "".join(_cell(student, exercise) for exercise in exercises)
        about = (student.done, str(student.notes or ""), f"{student.seconds:.0f} s")
        rows.append(f"<tr>{row}{''.join(f'<td>{word}</td>' for word in about)}</tr>")
    runs = any(student.cell(exercises[0])[0] == "..." for student in students)
    head = '<meta charset="utf-8"><title>Exercises</title>'
    head += f'<meta http-equiv="Content-Security-Policy" content="{escape(POLICY)}">'
    head += '<meta http-equiv="refresh" content="5">' if runs else ""
    below = f"{_checks(students)}{_causes(students)}{_changes(students)}{_legend()}"
    page = f"{head}<style>{STYLE}</style><h1>Exercises</h1>{_table(rows)}{below}"
    return f'<!DOCTYPE html><html lang="en">{page}</html>\n'


def _row(words: Iterable[str], tag: str = "td") -> str:
    return f"<tr>{''.join(f'<{tag}>{word}</{tag}>' for word in words)}</tr>"


def _table(rows: Iterable[str]) -> str:
    return f"<table>{''.join(rows)}</table>"


def _cell(student: Student, exercise: str) -> str:
    word, details = student.cell(exercise)
    kind, cause = KINDS.get(word, "wrong"), ""
    if kind == "wrong":
        outcome = next(each for each in student.outcomes if each.id == exercise)
        wrong = first_wrong(outcome)
        cause = f"<small>{escape(_short(wrong.seen))}</small>" if wrong else ""
    return f'<td class="{kind}" title="{escape(details)}">{escape(word)}{cause}</td>'


def _short(text: str) -> str:
    line = " ".join(text.split())
    return line if len(line) <= LONGEST else f"{line[: LONGEST - 3]}..."


def failures(students: Iterable[Student]) -> list[tuple[str, str, int]]:
    """Return (check, its title, how many fail it), the most frequent first."""
    wrong = [(one.id, one.title) for one in _results(students) if one.status == WRONG]
    return [(*about, count) for about, count in Counter(wrong).most_common()]


def _checks(students: Sequence[Student]) -> str:
    rows = [
        _row((name, escape(title), str(count), f'<div class="bar" style="width:{count}em"></div>'))
        for name, title, count in failures(students)
    ]
    return f"<h2>How many fail each check</h2>{_table(rows)}" if rows else ""


def causes(students: Iterable[Student]) -> list[tuple[int, Result]]:
    """Return (how many, an example without the student's name) of the most frequent causes."""
    examples: dict[str, Result] = {}
    counts: Counter[str] = Counter()
    for student in students:
        for one in _results([student]):
            if one.status == WRONG:
                counts[cause_of(one)] += 1
                words: dict[str, Any] = {
                    name: _nameless(getattr(one, name), student.name) for name in WORDS
                }
                examples.setdefault(cause_of(one), replace(one, **words))
    return [(count, examples[cause]) for cause, count in counts.most_common(MOST_CAUSES)]


def _nameless(text: str, name: str) -> str:
    return re.sub(rf"\b{re.escape(name)}\b", "NAME", text, flags=re.IGNORECASE)


def _causes(students: Sequence[Student]) -> str:
    rows = [
        _row(
            (str(count), f"{one.id} {escape(one.title)}", *(escape(getattr(one, w)) for w in WORDS))
        )
        for count, one in causes(students)
    ]
    head = _row(("how many", "check", *WORDS), "th")
    return f"<h2>The most frequent causes</h2>{_table([head, *rows])}" if rows else ""


def changes(student: Student) -> dict[str, list[str]]:
    """Return what changed since the last run: exercises now done, no more done, stuck at a check."""
    found: dict[str, list[str]] = {"now done": [], "no more done": [], "stuck": []}
    earlier = {outcome.id: outcome for outcome in student.before}
    for outcome in student.outcomes:
        old = earlier.get(outcome.id)
        if old is None:
            continue
        wrong, was = first_wrong(outcome), first_wrong(old)
        if outcome.passed != old.passed:
            found["now done" if outcome.passed else "no more done"].append(outcome.id)
        elif wrong and was and wrong.id == was.id:
            found["stuck"].append(f"{wrong.id} {wrong.title}")
    return found


def _changes(students: Sequence[Student]) -> str:
    rows = []
    for student in students:
        found = changes(student)
        if any(found.values()):
            rows.append(
                _row((escape(student.name), *(escape(", ".join(w)) for w in found.values())))
            )
    head = _row(("student", "now done", "no more done", "stuck at the same check"), "th")
    return f"<h2>Since the last run</h2>{_table([head, *rows])}" if rows else ""


def _legend() -> str:
    rows = (_row((escape(word), escape(what))) for word, what in LEGEND.items())
    return f"<h2>Legend</h2>{_table(rows)}"
