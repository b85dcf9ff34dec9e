"""A class at a glance: the table of --all as a page and as CSV, and the tables below it."""

from __future__ import annotations

import csv
import io
import re
from collections import Counter
from dataclasses import dataclass, field, replace
from html import escape
from pathlib import Path
from string import Template
from typing import Any, Iterable, Iterator, Mapping, Sequence
from urllib.parse import quote

from tutorial_check.checking.results import NOTE, UNREACHED, Outcome, Result
from tutorial_check.report.text import lines_of

# The start of a cell, for any separator, followed by a formula.
FORMULA = re.compile(r"(^|[;,|\t\r\n])(?=\s*[=+\-@])")
KINDS = {"ok": "ok", "-": "no", "?": "no", "not done": "no", "...": "no"}  # word: CSS class
LONGEST = 70  # characters of a cause in a cell
MOST_CAUSES = 10
BAR = "\u2588"  # one student
WORDS = ("expected", "seen", "where", "hint")  # a Result's fields, in its order
# No script, picture or other content loads, whatever a name or an output contains.
POLICY = "default-src 'none'; style-src 'unsafe-inline'"
PAGE = Template(Path(__file__).with_name("class_page.html").read_text(encoding="utf-8"))


@dataclass
class Student:
    """A student's workspace or zip. before: the outcomes of the last run."""

    name: str
    path: Path
    outcomes: list[Outcome] = field(default_factory=list)
    trouble: str = ""  # why nothing could be checked
    seconds: float = 0.0
    before: list[Outcome] = field(default_factory=list)
    digest: str = ""  # of the submission and of the checks

    def cell(self, exercise: str) -> tuple[str, str, str]:
        """Return (word of the page's legend, short cause, details) for an exercise."""
        if not self.outcomes:
            return ("?", "", self.trouble) if self.trouble else ("...", "", "")
        outcome = next(outcome for outcome in self.outcomes if outcome.id == exercise)
        if outcome.empty:
            return "not done", "", "nothing to check"
        if outcome.passed:
            return "ok", "", ""
        for wrong in outcome.wrong:
            return wrong.id, _short(wrong.seen), "\n".join(lines_of(wrong))
        if outcome.trouble:
            return "?", "", outcome.trouble
        unreached = (result for result in outcome.results if result.status == UNREACHED)
        why = next((result.seen for result in unreached), "")
        return "-", _short(why), "not reached"

    @property
    def done(self) -> str:
        """How many exercises are done, as "5 of 9"."""
        solved = sum(outcome.solved for outcome in self.outcomes)
        return f"{solved} of {len(self.outcomes)}" if self.outcomes else ""

    @property
    def notes(self) -> int:
        """How many checks hold with a remark."""
        results = [result for outcome in self.outcomes for result in outcome.results]
        return sum(result.status == NOTE and not result.empty for result in results)

    @property
    def remark(self) -> str:
        """Why there is no verdict, or how programs were isolated, if not by bubblewrap."""
        return self.trouble or next((outcome.remark for outcome in self.outcomes), "")

    @property
    def wrong(self) -> list[Result]:
        return [result for outcome in self.outcomes for result in outcome.wrong]


def cause_of(result: Result) -> str:
    """Return a key that equal failures share: the check and its words, without numbers."""
    return f"{result.id} {re.sub('[0-9.]+', '#', result.seen)}"


def _short(text: str) -> str:
    line = " ".join(text.split())
    return line if len(line) <= LONGEST else f"{line[: LONGEST - 3]}..."


def table_csv(students: Iterable[Student], exercises: Sequence[str]) -> str:
    """Return one line per student, with nothing that a spreadsheet would take for a formula."""
    lines = io.StringIO()
    table = csv.writer(lines)
    table.writerow(["student", *exercises, "done", "notes", "seconds", "first cause", "remark"])
    for student in students:
        cells = [student.cell(exercise)[0] for exercise in exercises]
        cause = student.wrong[0].seen if student.wrong else ""
        texts = (student.name, cause, student.remark)
        name, cause, remark = (FORMULA.sub(r"\1'", text) for text in texts)
        about = (cells.count("ok"), student.notes, f"{student.seconds:.1f}", cause, remark)
        table.writerow([name, *cells, *about])
    return lines.getvalue()


def table_html(
    students: Sequence[Student], exercises: Sequence[str], titles: Mapping[str, str], about: str
) -> str:
    """Return the page, which reloads itself while students are still being checked.

    about: its subtitle.
    """
    heads = ["student", *(f"{name}<small>{escape(titles[name])}</small>" for name in exercises)]
    rows = [_row((*heads, "done", "notes", "took"), "th")]
    for student in students:
        row = f"<tr><th>{_link(student)}</th>"
        for word, cause, details in map(student.cell, exercises):
            small = f"<small>{escape(cause)}</small>" if cause else ""
            kind = KINDS.get(word, "wrong")
            row += f'<td class="{kind}" title="{escape(details)}">{escape(word)}{small}</td>'
        last = (student.done, str(student.notes or ""), f"{student.seconds:.0f} s")
        rows.append(row + "".join(f"<td>{word}</td>" for word in last) + "</tr>")
    rows.append(_total(students, exercises))
    runs = any(student.cell(exercises[0])[0] == "..." for student in students)
    refresh = '<meta http-equiv="refresh" content="5">' if runs else ""
    body = f'<table class="class">{"".join(rows)}</table>{"".join(_below(students))}'
    return PAGE.substitute(policy=escape(POLICY), refresh=refresh, about=escape(about), body=body)


def _link(student: Student) -> str:
    """Return a student's name as a link to the report."""
    path = quote(f"{student.name}.txt", errors="surrogateescape")  # a name may not be UTF-8
    return f'<a href="./{path}">{escape(student.name)}</a>'


def _total(students: Sequence[Student], exercises: Sequence[str]) -> str:
    """Return the last row: how many students have done each exercise."""
    checked = [student for student in students if student.outcomes]
    done = (sum(student.cell(name)[0] == "ok" for student in checked) for name in exercises)
    counts = (f"<td>{count} of {len(checked)}</td>" for count in done)
    notes = sum(student.notes for student in checked) or ""
    took = f"{sum(student.seconds for student in students):.0f} s"
    all_done = sum(all(outcome.solved for outcome in student.outcomes) for student in checked)
    total = f"<td>{all_done} of {len(checked)}</td><td>{notes}</td><td>{took}</td>"
    return f"<tr><th>all {len(students)}</th>{''.join(counts)}{total}</tr>"


def _row(cells: Iterable[str], tag: str = "td") -> str:
    return f"<tr>{''.join(f'<{tag}>{cell}</{tag}>' for cell in cells)}</tr>"


def _below(students: Sequence[Student]) -> Iterator[str]:
    """Yield the tables below the class's, each with its heading, except empty ones."""
    failed = (
        (check, escape(title), str(count), BAR * count)
        for check, title, count in failures(students)
    )
    yield _section("How many fail each check", ("check", "", "how many", ""), failed)
    frequent = (
        (", ".join(map(_link, those)), *(escape(words) for words in _words(example)))
        for those, example in causes(students)
    )
    yield _section("The most frequent causes", ("students", "check", *WORDS), frequent)
    changed = ((student, [*map(", ".join, changes(student).values())]) for student in students)
    head = ("student", "now done", "no longer done", "stuck at the same check")
    rows = ((_link(student), *map(escape, cells)) for student, cells in changed if any(cells))
    yield _section("Since the last run", head, rows)
    remarked = (student for student in students if student.remark)
    remarks = ((_link(student), escape(student.remark)) for student in remarked)
    yield _section("Remarks", ("student", "remark"), remarks)


def _words(result: Result) -> Iterator[str]:
    yield f"{result.id} {result.title}"
    yield from (getattr(result, word) for word in WORDS)


def _section(title: str, head: Sequence[str], rows: Iterable[Iterable[str]]) -> str:
    """Return a table with its heading. rows: in HTML."""
    lines = [*map(_row, rows)]
    return f"<h2>{title}</h2><table>{_row(head, 'th')}{''.join(lines)}</table>" if lines else ""


def failures(students: Iterable[Student]) -> list[tuple[str, str, int]]:
    """Return (check, its title, how many fail it), the most frequent first."""
    wrong = Counter((result.id, result.title) for student in students for result in student.wrong)
    return [(*about, count) for about, count in wrong.most_common()]


def causes(students: Iterable[Student]) -> list[tuple[list[Student], Result]]:
    """Return (students, an example without their name) for each of the most frequent causes."""
    examples: dict[str, Result] = {}
    whose: dict[str, list[Student]] = {}
    for student in students:
        name = re.compile(rf"\b{re.escape(student.name)}\b", re.IGNORECASE)
        for wrong in student.wrong:
            whose.setdefault(cause_of(wrong), []).append(student)
            words: dict[str, Any] = {word: name.sub("NAME", getattr(wrong, word)) for word in WORDS}
            examples.setdefault(cause_of(wrong), replace(wrong, **words))
    frequent = sorted(whose, key=lambda cause: -len(whose[cause]))[:MOST_CAUSES]
    return [(whose[cause], examples[cause]) for cause in frequent]


def changes(student: Student) -> dict[str, list[str]]:
    """Return the changes since the last run: exercises done, no longer done, stuck at a check."""
    pairs = [(new, old) for new in student.outcomes for old in student.before if old.id == new.id]
    firsts = (both for new, old in pairs for both in zip(new.wrong[:1], old.wrong[:1]))
    return {
        "now done": [new.id for new, old in pairs if new.passed and not old.passed],
        "no longer done": [new.id for new, old in pairs if old.passed and not new.passed],
        "stuck": [f"{first.id} {first.title}" for first, was in firsts if first.id == was.id],
    }
