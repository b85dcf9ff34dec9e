"""--all: every student of a folder, a table of them all, and each one's report."""

from __future__ import annotations

import argparse
import contextlib
import csv
import io
import os
import re
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass, field
from html import escape
from pathlib import Path
from typing import Iterable, Mapping
from urllib.parse import quote

from tutorial_check.examination import Outcome, end_all, examine
from tutorial_check.formats import as_json, clear, without_hints, write
from tutorial_check.model import WRONG, CannotCheck, fault
from tutorial_check.report import lines_of, summary, text_of

ARCHIVES = (".zip", ".tar", ".tgz", ".gz", ".bz2", ".xz", ".7z", ".rar")
TABLES = ("table.csv", "table.html")
RESULTS = (".csv", ".html", ".txt", ".json")
# Where a spreadsheet begins a cell, whatever it takes for what separates two; and then a formula.
FORMULA = re.compile(r"(^|[;,|\t\r\n])(?=\s*[=+\-@])")
STYLE = (
    "body{font-family:sans-serif}td,th{padding:.2em .6em;border:1px solid #ccc}"
    "table{border-collapse:collapse}.ok{background:#cfc}.wrong{background:#fcc}.no{color:#777}"
)


@dataclass
class Student:
    """One workspace, or zip."""

    name: str
    path: Path
    outcomes: list[Outcome] = field(default_factory=list)
    trouble: str = ""  # why nothing could be checked
    seconds: float = 0.0

    def cell(self, exercise: str) -> tuple[str, str]:
        """Return a word and details for an exercise: ok, the check that is wrong, - or ?."""
        if not self.outcomes:
            return "?", self.trouble
        outcome = next(each for each in self.outcomes if each.id == exercise)
        if outcome.empty:
            return "not done", "nothing to check"
        if outcome.passed:
            return "ok", ""
        wrong = [result for result in outcome.results if result.status == WRONG]
        if wrong:
            return wrong[0].id, "\n".join(lines_of(wrong[0]))
        return ("?", outcome.trouble) if outcome.trouble else ("-", "not reached")


def find_students(folder: str | Path, out: str | Path) -> list[Student]:
    """Return the Students of a folder: each folder, archive and link in it, but those of results.

    Archives that are no zip, and links, are among them: the table says that they are not checked.
    """
    try:
        entries = [path for path in sorted(Path(folder).iterdir()) if path.name[0] != "."]
    except OSError as error:
        raise CannotCheck(f"{folder}: {error.strerror}") from None
    paths = [
        path
        for path in entries
        if (path.is_dir() or path.suffix.lower() in ARCHIVES or not path.exists())
        and not _has_results(path, out)
    ]
    if not paths:
        raise CannotCheck(f"{folder}: no workspace and no zip in it")
    short = [path.stem if path.suffix.lower() == ".zip" else path.name for path in paths]
    claims = Counter(word for path, name in zip(paths, short) for word in {name, path.name})
    return [
        Student(name if claims[name] == 1 else path.name, path) for name, path in zip(short, paths)
    ]


def _has_results(path: Path, out: str | Path) -> bool:
    """Return whether it is the folder of the results, or that of an earlier check, with nothing else."""
    if os.path.realpath(path) == os.path.realpath(out):
        return True
    tables = [os.path.isfile(path / name) for name in TABLES]
    if path.is_symlink() or not all(tables) or not os.access(path, os.R_OK):
        return False
    is_left_out = all(each.is_file() and each.suffix in RESULTS for each in path.iterdir())
    if is_left_out:
        print(f"{path.name}: left out: the results of an earlier check")
    return is_left_out


def check_all(options: argparse.Namespace) -> int:
    """Check all, write table and reports; 0: all are done, 1: something is wrong, 2: one is unchecked."""
    out = Path(options.out or Path(options.all) / "check")
    students = find_students(options.all, out)
    with contextlib.suppress(OSError):
        out.mkdir(parents=True, exist_ok=True)
    if not (os.path.isdir(out) and os.access(out, os.W_OK | os.X_OK)):
        raise CannotCheck(f"{out}: no folder that may be written to; --out names another one")
    for student in students:  # what an earlier check said
        for ending in (".txt", ".json"):
            with contextlib.suppress(OSError):
                (out / f"{student.name}{ending}").unlink()
    for name in TABLES:
        clear(out / name)
    _check_each(students, out, options)
    titles = {name: one.title for name, one in options.course.exercises.items()}
    write(out / TABLES[0], table_csv(students, options.exercises))
    write(out / TABLES[1], table_html(students, options.exercises, titles))
    print(f"{out}/table.html, table.csv, and a report of each")
    outcomes = [outcome for student in students for outcome in student.outcomes]
    if any(one.trouble for one in students) or any(one.trouble for one in outcomes):
        return 2
    return 0 if all(outcome.passed for outcome in outcomes) else 1


def _check_each(students: list[Student], out: Path, options: argparse.Namespace) -> None:
    from tqdm import tqdm  # noqa: PLC0415  only here

    with ThreadPoolExecutor(max(1, options.jobs)) as pool, tqdm(
        total=len(students), unit="student", disable=None
    ) as bar:
        checks = [pool.submit(_check, student, out, options) for student in students]
        try:
            for student in (done.result() for done in as_completed(checks)):
                bar.update()
                verdict = student.trouble or summary(student.outcomes)
                bar.write(f"{student.name}: {verdict}, {student.seconds:.0f} s")
        except KeyboardInterrupt:  # the pool would go on to the last student
            for check in checks:
                check.cancel()
            end_all()
            raise


def _check(student: Student, out: Path, options: argparse.Namespace) -> Student:
    """Check one and write the report; whatever happens must not spoil the others."""
    began_s = time.monotonic()
    try:
        if student.path.is_symlink():  # it may lead to the files of another student
            raise CannotCheck("a link is not followed: put the folder or the archive itself here")
        outcomes = examine(
            student.path,
            options.underlay,
            options.exercises,
            own=False,
            course=options.course.folder,
        )
        student.outcomes = without_hints(outcomes) if options.hints == 0 else outcomes
    except Exception as error:
        student.trouble = fault(error)
    student.seconds = time.monotonic() - began_s
    report = f"could not be checked: {student.trouble}\n" if student.trouble else ""
    try:
        text = f"{student.name}\n\n{report or text_of(student.outcomes)}"
        write(out / f"{student.name}.txt", text)
        if student.outcomes:
            write(out / f"{student.name}.json", as_json(student.outcomes))
    except Exception as error:
        student.trouble = student.trouble or fault(error)
    return student


def table_csv(students: Iterable[Student], exercises: list[str]) -> str:
    """Return one line a student, without what a spreadsheet would take for a formula."""
    lines = io.StringIO()
    table = csv.writer(lines)
    table.writerow(["student", *exercises, "done", "seconds", "remark"])
    for student in students:
        cells = [student.cell(exercise)[0] for exercise in exercises]
        name, remark = (FORMULA.sub(r"\1'", text) for text in (student.name, student.trouble))
        table.writerow([name, *cells, cells.count("ok"), f"{student.seconds:.1f}", remark])
    return lines.getvalue()


def table_html(students: Iterable[Student], exercises: list[str], titles: Mapping[str, str]) -> str:
    """Return the same as a page; what is wrong is shown where the pointer rests."""
    rows = [
        "student",
        *(f"{each}<br><small>{escape(titles[each])}</small>" for each in exercises),
    ]
    rows = [f"<tr>{''.join(f'<th>{word}</th>' for word in (*rows, 'done', 'took'))}</tr>"]
    for student in students:
        link = quote(f"{student.name}.txt", errors="surrogateescape")  # a name may be no UTF-8
        row = f'<td><a href="{link}">{escape(student.name)}</a></td>'
        for exercise in exercises:
            word, details = student.cell(exercise)
            kind = {"ok": "ok", "-": "no", "?": "no", "not done": "no"}.get(word, "wrong")
            row += f'<td class="{kind}" title="{escape(details)}">{escape(word)}</td>'
        done = sum(outcome.passed and not outcome.empty for outcome in student.outcomes)
        rows.append(f"<tr>{row}<td>{done}</td><td>{student.seconds:.0f} s</td></tr>")
    head = f'<meta charset="utf-8"><title>Exercises</title><style>{STYLE}</style>'
    return f'<!DOCTYPE html><html lang="en">{head}<table>{"".join(rows)}</table></html>\n'
