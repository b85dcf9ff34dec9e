"""--all: every student of a folder, a table of them all, and each one's report."""

import csv
import html
import time
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass, field
from pathlib import Path

from tutorial_check.examination import end_all, examine
from tutorial_check.exercises import EXERCISES
from tutorial_check.formats import as_json
from tutorial_check.model import WRONG, CannotCheck
from tutorial_check.report import lines_of, summary, text_of


@dataclass
class Student:
    """One workspace, or zip."""

    name: str
    path: Path
    outcomes: list = field(default_factory=list)
    trouble: str = ""  # why nothing could be checked
    seconds: float = 0.0


def find_students(folder, out):
    """The Students of a folder: each folder and each zip in it, but that of the results."""
    try:
        entries = sorted(Path(folder).iterdir())
    except OSError as error:
        raise CannotCheck(f"{folder}: {error.strerror}") from None
    students = [
        Student(path.name[:-4] if path.suffix == ".zip" else path.name, path)
        for path in entries
        if (path.is_dir() or path.suffix == ".zip")
        and not path.name.startswith(".")
        and path.resolve() != out.resolve()
    ]
    if not students:
        raise CannotCheck(f"{folder}: no workspace and no zip in it")
    return students


def check_all(options):
    """Check them, write table and reports; 0 if all are done, 1 if something is wrong, 2 if one could not be checked."""
    from tqdm import tqdm  # noqa: PLC0415  only here

    out = Path(options.out or Path(options.all) / "check")
    students = find_students(options.all, out)
    out.mkdir(parents=True, exist_ok=True)
    with ThreadPoolExecutor(max(1, options.jobs)) as pool, tqdm(
        total=len(students), unit="student", disable=None
    ) as bar:
        checks = [pool.submit(_check, student, options) for student in students]
        try:
            for done in as_completed(checks):
                student = done.result()
                _write(out, student, not options.no_hints)
                bar.update()
                bar.write(
                    f"{student.name}: {student.trouble or summary(student.outcomes)}, {student.seconds:.0f} s"
                )
        except KeyboardInterrupt:  # the pool would go on to the last student
            for check in checks:
                check.cancel()
            end_all()
            raise
    write_csv(out / "table.csv", students, options.exercises)
    (out / "table.html").write_text(table_html(students, options.exercises), encoding="utf-8")
    print(f"{out}/table.html, table.csv, and a report of each")
    outcomes = [outcome for student in students for outcome in student.outcomes]
    if any(one.trouble for one in (*students, *outcomes)):
        return 2
    return 0 if all(outcome.passed for outcome in outcomes) else 1


def _check(student, options):
    began_s = time.monotonic()
    try:
        student.outcomes = examine(student.path, options.floor, options.exercises, own=False)
    except CannotCheck as error:
        student.trouble = str(error)
    except Exception as error:  # whatever it is, it must not spoil the others
        student.trouble = f"{type(error).__name__}: {error}"
    student.seconds = time.monotonic() - began_s
    return student


def _write(out, student, hints):
    text = f"{student.name}\n\n" + (
        f"could not be checked: {student.trouble}\n"
        if student.trouble
        else text_of(student.outcomes, hints)
    )
    (out / f"{student.name}.txt").write_text(text, encoding="utf-8")
    if student.outcomes:
        (out / f"{student.name}.json").write_text(as_json(student.outcomes), encoding="utf-8")


def _cell(student, exercise):
    """(word, details) of one exercise of a student."""
    if student.trouble:
        return "?", student.trouble
    outcome = next(each for each in student.outcomes if each.id == exercise)
    if outcome.passed:
        return "ok", ""
    wrong = [result for result in outcome.results if result.status == WRONG]
    if outcome.trouble and not wrong:
        return "?", outcome.trouble
    return (wrong[0].id, "\n".join(lines_of(wrong[0]))) if wrong else ("-", "not reached")


def write_csv(path, students, exercises):
    """One line a student: ok, the first check that is wrong, - (not reached), ? (not checked)."""
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(["student", *exercises, "done", "seconds", "remark"])
        for student in students:
            cells = [_cell(student, exercise)[0] for exercise in exercises]
            # A name may begin like a formula of a spreadsheet.
            name = f"'{student.name}" if student.name[:1] in "=+-@" else student.name
            table.writerow(
                [name, *cells, cells.count("ok"), f"{student.seconds:.1f}", student.trouble]
            )


def table_html(students, exercises):
    """The same as a page; what is wrong is shown where the pointer rests."""
    rows = []
    for student in students:
        cells = []
        for exercise in exercises:
            word, details = _cell(student, exercise)
            kind = {"ok": "ok", "-": "no", "?": "no"}.get(word, "wrong")
            cells.append(
                f'<td class="{kind}" title="{html.escape(details, quote=True)}">{html.escape(word)}</td>'
            )
        link = html.escape(student.name)
        done = sum(outcome.passed for outcome in student.outcomes)
        rows.append(
            f'<tr><td><a href="{link}.txt">{link}</a></td>{"".join(cells)}<td>{done}</td><td>{student.seconds:.0f} s</td></tr>'
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
