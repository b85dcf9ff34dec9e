"""--all: check every student in a folder; write a table, and a report for each."""

from __future__ import annotations

import argparse
import contextlib
import os
import re
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path

from node_kit.printable import printable
from tutorial_check.cluster.dask_cluster import MOST_AT_ONCE, Cluster
from tutorial_check.course.tasks import variant_of
from tutorial_check.errors import CannotCheck, SchedulerGone, fault
from tutorial_check.examining.examination import examine
from tutorial_check.recording.worker_process import no_more
from tutorial_check.report.class_page import Student, table_csv, table_html
from tutorial_check.report.formats import as_json, clear, keep, without_hints, write
from tutorial_check.report.memory import LastRun, digest_of, digest_of_checks
from tutorial_check.report.text import summary, text_of
from tutorial_check.submission.order import Order

ARCHIVES = (".zip", ".tar", ".tgz", ".gz", ".bz2", ".xz", ".7z", ".rar")
TABLES = ("table.csv", "table.html")
# What Moodle appends to a student's name: NAME_12345_assignsubmission_file_
OF_MOODLE = re.compile(r"_\d+_assignsubmission_[a-z]+_?.*")
QUICK_S = 0.05  # to write the page of a small class
RESULTS = (".csv", ".html", ".txt", ".json")


def find_students(folder: str | Path, out: str | Path, tasks: str = "") -> list[Student]:
    """Return a Student for each folder, archive and link, except results and tasks."""
    try:
        entries = [path for path in sorted(Path(folder).iterdir()) if path.name[0] != "."]
    except OSError as error:
        raise CannotCheck(f"{folder}: {error.strerror}") from None
    entries = [path for path in entries if not (tasks and path.resolve() == Path(tasks).resolve())]
    archives = [path for path in entries if path.suffix.lower() in ARCHIVES or not path.exists()]
    folders = [path for path in entries if path.is_dir() and not _has_results(path, out)]
    paths = sorted({*archives, *folders})
    if not paths:
        raise CannotCheck(f"{folder}: no workspace and no zip in it")
    short = [path.stem if path.suffix.lower() == ".zip" else path.name for path in paths]
    short = [OF_MOODLE.sub("", name) or name for name in short]
    claims = Counter(word for path, name in zip(paths, short) for word in {name, path.name})
    names = (name if claims[name] == 1 else path.name for name, path in zip(short, paths))
    return [Student(name, path) for name, path in zip(names, paths)]


def _has_results(path: Path, out: str | Path) -> bool:
    """Return whether a folder is for the results, or has only those of an earlier check."""
    if os.path.realpath(path) == os.path.realpath(out):
        return True
    tables = [os.path.isfile(path / name) for name in TABLES]
    if path.is_symlink() or not all(tables) or not os.access(path, os.R_OK):
        return False
    is_left_out = all(file.is_file() and file.suffix in RESULTS for file in path.iterdir())
    if is_left_out:
        print(f"{path.name}: left out: the results of an earlier check")
    return is_left_out


def check_all(options: argparse.Namespace) -> int:
    """Check all; write the table and reports. Return 0: all done, 1: mistakes, 2: unchecked."""
    out = Path(options.out or Path(options.all) / "check")
    students = find_students(options.all, out, options.variant or "")
    if not options.variant and Path(options.all, "variants").is_dir():
        print("variants: a submission; if it has students' tasks: --variant FOLDER/variants")
    with contextlib.suppress(OSError):
        out.mkdir(parents=True, exist_ok=True)
    if not (os.path.isdir(out) and os.access(out, os.W_OK | os.X_OK)):
        raise CannotCheck(f"{out}: not a writable folder; choose another one with --out")
    for student in students:  # of an earlier check
        for ending in (".txt", ".json"):
            with contextlib.suppress(OSError):
                (out / f"{student.name}{ending}").unlink()
    for name in TABLES:
        clear(out / name)
    ClassCheck(students, out, options).run()
    write(out / TABLES[0], table_csv(students, options.exercises))
    print(f"{out}/table.html, table.csv, and a report of each")
    outcomes = [outcome for student in students for outcome in student.outcomes]
    if any(s.trouble for s in students) or any(outcome.trouble for outcome in outcomes):
        return 2
    return int(not all(outcome.passed for outcome in outcomes))


class ClassCheck:
    """The checks of all students, several at a time; the page shows their progress."""

    def __init__(self, students: list[Student], out: Path, options: argparse.Namespace) -> None:
        """Read the results of the last run. out: the folder of the results."""
        self._students, self._out, self._options = students, out, options
        self._last_run = LastRun(out)
        for student in students:
            student.before = self._last_run.outcomes(student.name)
        self._checks = digest_of_checks(options.course, options.exercises, options.hints)
        self._next_s = 0.0  # when the page may be written again
        self._cluster = Cluster(options.cluster) if options.cluster else None

    def run(self) -> None:
        """Check all students, and write the page after each of them."""
        from tqdm import tqdm  # noqa: PLC0415  only here

        self._show()
        at_once = MOST_AT_ONCE if self._cluster else max(1, self._options.jobs)
        bar = tqdm(total=len(self._students), unit="student", disable=None)
        with ThreadPoolExecutor(at_once) as pool, bar:
            checks = [pool.submit(self._check, student) for student in self._students]
            try:
                for student, remark in (done.result() for done in as_completed(checks)):
                    bar.update()
                    verdict = student.trouble or summary(student.outcomes)
                    bar.write(printable(f"{student.name}: {verdict}, {remark}"))
                    self._show()
            except (KeyboardInterrupt, SchedulerGone):  # else the pool would check all
                for check in checks:
                    check.cancel()
                no_more.set()
                if self._cluster:
                    self._cluster.close()
                raise
            finally:
                self._show(is_last=True)

    def _show(self, is_last: bool = False) -> None:
        """Write the page atomically, because it may be open, and in at most a tenth of the time."""
        began_s = time.monotonic()
        if began_s < self._next_s and not is_last:
            return
        titles = {name: about.title for name, about in self._options.course.exercises.items()}
        subtitle = f"{os.path.abspath(self._options.all)}, {time.strftime('%d %B %Y, %H:%M')}"
        page = table_html(self._students, self._options.exercises, titles, subtitle)
        write(self._out / f".{TABLES[1]}", page)
        os.replace(self._out / f".{TABLES[1]}", self._out / TABLES[1])
        self._last_run.keep(self._students)
        took_s = time.monotonic() - began_s
        self._next_s = began_s + 10 * took_s if took_s > QUICK_S else 0.0

    def _check(self, student: Student) -> tuple[Student, str]:
        """Check a student and write the report. No exception may stop the other checks."""
        began_s = time.monotonic()
        remark = ""
        try:
            remark = self._outcomes_of(student)
        except SchedulerGone:
            raise
        except Exception as error:
            student.trouble = fault(error)
        student.seconds = time.monotonic() - began_s
        report = f"could not be checked: {student.trouble}\n" if student.trouble else ""
        try:
            text = printable(f"{student.name}\n\n{report or text_of(student.outcomes)}")
            write(self._out / f"{student.name}.txt", text)
            if student.outcomes:
                report = as_json(student.outcomes, with_recordings=False)
                write(self._out / f"{student.name}.json", report)
            if self._options.keep and any(outcome.recordings for outcome in student.outcomes):
                keep(self._options.keep, student.name, student.outcomes)
        except Exception as error:
            student.trouble = student.trouble or fault(error)
        return student, remark or f"{student.seconds:.0f} s"

    def _outcomes_of(self, student: Student) -> str:
        """Set a student's outcomes, perhaps to those of the last run; return a remark."""
        if student.path.is_symlink():  # it may lead to another student's files
            raise CannotCheck("a link is not followed: put the folder or the archive itself here")
        options = self._options
        variant = variant_of(options.course, student.name, options.variant, options.variants)
        student.digest = digest_of(student.path, f"{self._checks} {variant} {options.language}")
        if not options.again and self._last_run.is_same(student):
            student.outcomes = student.before
            return "unchanged since the last check"
        order = Order(
            student.path, options.underlay, options.exercises, is_callers_own=False,
            course=options.course.folder, variant=variant, language=options.language,
        )  # fmt: skip
        outcomes = self._cluster.examine(order) if self._cluster else examine(order)
        student.outcomes = without_hints(outcomes) if options.hints == 0 else outcomes
        return ""
