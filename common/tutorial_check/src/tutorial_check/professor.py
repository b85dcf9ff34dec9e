"""--all: every student of a folder, a table of them all, and each one's report."""

import contextlib
import csv
import html
import io
import os
import re
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import quote

from tutorial_check.examination import end_all, examine
from tutorial_check.exercises import EXERCISES
from tutorial_check.formats import as_json, clear, without_hints, write
from tutorial_check.model import WRONG, CannotCheck, fault
from tutorial_check.report import lines_of, summary, text_of

ARCHIVES = (".zip", ".tar", ".tgz", ".gz", ".bz2", ".xz", ".7z", ".rar")
RESULTS = (".csv", ".html", ".txt", ".json")
# Where a spreadsheet begins a cell, whatever it takes for what separates two; and then a formula.
FORMULA = re.compile(r"(^|[;,|\t\r\n])(?=\s*[=+\-@])")


@dataclass
class Student:
    """One workspace, or zip."""

    name: str
    path: Path
    outcomes: list = field(default_factory=list)
    trouble: str = ""  # why nothing could be checked
    seconds: float = 0.0


def find_students(folder, out):
    """The Students of a folder: each folder, archive and dangling link in it, but those of results.

    Of an archive that is no zip, and of a link that leads nowhere, the table is to say so.
    """
    try:
        entries = sorted(Path(folder).iterdir())
    except OSError as error:
        raise CannotCheck(f"{folder}: {error.strerror}") from None
    paths = [
        path
        for path in entries
        if (path.is_dir() or path.suffix.lower() in ARCHIVES or not path.exists())
        and not path.name.startswith(".")
        and not _has_results(path, out)
    ]
    if not paths:
        raise CannotCheck(f"{folder}: no workspace and no zip in it")
    short = [path.stem if path.suffix.lower() == ".zip" else path.name for path in paths]
    claims = Counter(word for path, name in zip(paths, short) for word in {name, path.name})
    return [
        Student(name if claims[name] == 1 else path.name, path) for name, path in zip(short, paths)
    ]


def _has_results(path, out):
    """Whether it is the folder of the results, or that of an earlier check, in which is nothing else."""
    if os.path.realpath(path) == os.path.realpath(out):
        return True
    tables = [os.path.isfile(path / name) for name in ("table.csv", "table.html")]
    if path.is_symlink() or not all(tables) or not os.access(path, os.R_OK):
        return False
    is_left_out = all(each.is_file() and each.suffix in RESULTS for each in path.iterdir())
    if is_left_out:
        print(f"{path.name}: left out: the results of an earlier check")
    return is_left_out


def check_all(options):
    """Check them, write table and reports; 0 if all are done, 1 if something is wrong, 2 if one could not be checked."""
    from tqdm import tqdm  # noqa: PLC0415  only here

    out = Path(options.out or Path(options.all) / "check")
    students = find_students(options.all, out)
    _make_folder(out)
    for student in students:
        _forget(out, student)
    clear(out / "table.csv")
    clear(out / "table.html")
    with ThreadPoolExecutor(max(1, options.jobs)) as pool, tqdm(
        total=len(students), unit="student", disable=None
    ) as bar:
        checks = [pool.submit(_check, student, options) for student in students]
        try:
            for done in as_completed(checks):
                student = done.result()
                try:
                    _write(out, student)
                except Exception as error:  # as in _check
                    student.trouble = student.trouble or fault(error)
                bar.update()
                bar.write(
                    f"{student.name}: {student.trouble or summary(student.outcomes)}, {student.seconds:.0f} s"
                )
        except KeyboardInterrupt:  # the pool would go on to the last student
            for check in checks:
                check.cancel()
            end_all()
            raise
    write(out / "table.csv", table_csv(students, options.exercises))
    write(out / "table.html", table_html(students, options.exercises))
    print(f"{out}/table.html, table.csv, and a report of each")
    outcomes = [outcome for student in students for outcome in student.outcomes]
    if any(one.trouble for one in (*students, *outcomes)):
        return 2
    return 0 if all(outcome.passed for outcome in outcomes) else 1


def _make_folder(out):
    """Make the folder of the results. Raises CannotCheck: not only when all are examined."""
    with contextlib.suppress(OSError):
        out.mkdir(parents=True, exist_ok=True)
    if not (os.path.isdir(out) and os.access(out, os.W_OK | os.X_OK)):
        raise CannotCheck(f"{out}: no folder that may be written to; --out names another one")


def _forget(out, student):
    """Remove what an earlier check said of a student."""
    for ending in (".txt", ".json"):
        with contextlib.suppress(OSError):
            (out / f"{student.name}{ending}").unlink()


def _check(student, options):
    began_s = time.monotonic()
    try:
        if student.path.is_symlink():  # it may lead to the files of somebody else
            raise CannotCheck("a link is not followed: put the folder or the archive itself here")
        outcomes = examine(student.path, options.floor, options.exercises, own=False)
        student.outcomes = without_hints(outcomes) if options.no_hints else outcomes
    except Exception as error:  # whatever it is, it must not spoil the others
        student.trouble = fault(error)
    student.seconds = time.monotonic() - began_s
    return student


def _write(out, student):
    text = f"{student.name}\n\n" + (
        f"could not be checked: {student.trouble}\n"
        if student.trouble
        else text_of(student.outcomes)
    )
    write(out / f"{student.name}.txt", text)
    if student.outcomes:
        write(out / f"{student.name}.json", as_json(student.outcomes))


def _cell(student, exercise):
    """(word, details) of one exercise of a student."""
    if not student.outcomes:
        return "?", student.trouble
    outcome = next(each for each in student.outcomes if each.id == exercise)
    if outcome.empty:
        return "not done", "nothing to check"
    if outcome.passed:
        return "ok", ""
    wrong = [result for result in outcome.results if result.status == WRONG]
    if outcome.trouble and not wrong:
        return "?", outcome.trouble
    return (wrong[0].id, "\n".join(lines_of(wrong[0]))) if wrong else ("-", "not reached")


def table_csv(students, exercises):
    """One line a student: ok, the first check that is wrong, - (not reached), ? (not checked)."""
    lines = io.StringIO()
    table = csv.writer(lines)
    table.writerow(["student", *exercises, "done", "seconds", "remark"])
    for student in students:
        cells = [_cell(student, exercise)[0] for exercise in exercises]
        name, remark = _no_formula(student.name), _no_formula(student.trouble)
        table.writerow([name, *cells, cells.count("ok"), f"{student.seconds:.1f}", remark])
    return lines.getvalue()


def _no_formula(text):
    """A text in which no spreadsheet finds a formula; a name may begin like one."""
    return FORMULA.sub(r"\1'", text)


def table_html(students, exercises):
    """The same as a page; what is wrong is shown where the pointer rests."""
    rows = []
    for student in students:
        cells = []
        for exercise in exercises:
            word, details = _cell(student, exercise)
            kind = {"ok": "ok", "-": "no", "?": "no", "not done": "no"}.get(word, "wrong")
            cells.append(
                f'<td class="{kind}" title="{html.escape(details, quote=True)}">{html.escape(word)}</td>'
            )
        link = quote(f"{student.name}.txt", errors="surrogateescape")  # a name may be no UTF-8
        done = sum(outcome.passed and not outcome.empty for outcome in student.outcomes)
        rows.append(
            f'<tr><td><a href="{link}">{html.escape(student.name)}</a></td>{"".join(cells)}<td>{done}</td><td>{student.seconds:.0f} s</td></tr>'
        )
    head = "".join(
        f"<th>{each}<br><small>{html.escape(EXERCISES[each])}</small></th>" for each in exercises
    )
    return (
        '<!DOCTYPE html><html lang="en"><meta charset="utf-8"><title>Exercises</title><style>'
        "body{font-family:sans-serif}td,th{padding:.2em .6em;border:1px solid #ccc}table{border-collapse:collapse}"
        ".ok{background:#cfc}.wrong{background:#fcc}.no{color:#777}</style>"
        f"<table><tr><th>student</th>{head}<th>done</th><th>took</th></tr>{''.join(rows)}</table></html>\n"
    )
