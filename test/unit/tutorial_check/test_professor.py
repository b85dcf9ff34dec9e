"""--all: odd names, and what cannot be written, cost no other student the result."""

import csv
import os
import re
from pathlib import Path
from types import SimpleNamespace

import pytest

from tutorial_check import professor
from tutorial_check.course import read_course
from tutorial_check.examination import Outcome
from tutorial_check.model import OK, UNREACHED, WRONG, CannotCheck, Result
from tutorial_check.professor import Student, table_csv, table_html

WELL = Outcome("2", [Result("C1", OK, "one")], 1.0, True)
BAD = Outcome("2", [Result("C1", WRONG, "one", seen="none", hint="mkdir src")], 1.0, True)
UNDECIDED = Outcome("5", [Result("C21", UNREACHED, "two")], 1.0, True)
NO_VERDICT = Outcome("5", UNDECIDED.results, 1.0, True, "C21: no space")
EMPTY = Outcome("5", [Result("C21", OK, "two", empty=True)], done=True)


@pytest.fixture
def group(tmp_path, monkeypatch):
    """A folder for students, all of whom are right."""
    monkeypatch.setattr(professor, "examine", lambda *_, **__: [WELL])
    (tmp_path / "group").mkdir()
    return tmp_path / "group"


def check_all(group, out=None):
    """Return the exit code and the rows of the table."""
    about = {"jobs": 1, "hints": 2, "underlay": "", "exercises": ["2"]}
    options = SimpleNamespace(all=str(group), out=out, course=read_course(), **about)
    code = professor.check_all(options)
    with (group / "check" / "table.csv").open(newline="", encoding="utf-8") as table:
        return code, list(csv.reader(table))[1:]


def test_a_folder_and_a_zip_of_one_name_have_each_a_report(group):
    (group / "anna").mkdir()
    for name in ("anna.zip", "anna.zip.zip", "bob.zip"):
        (group / name).touch()
    names = ["anna", "anna.zip", "anna.zip.zip", "bob"]
    code, rows = check_all(group)
    assert (code, [row[0] for row in rows]) == (0, names)
    assert sorted(path.stem for path in (group / "check").glob("*.txt")) == names
    page = (group / "check/table.html").read_text()
    assert all(f'<a href="{name}.txt">{name}</a>' in page for name in names)


def test_odd_names(group):
    """One is no UTF-8; the report of another cannot be written."""
    longest = "n" * 255
    for name in (b"anna", b"m\xfcller", longest.encode(), b"zoe"):
        os.mkdir(os.path.join(os.fsencode(group), name))
    code, rows = check_all(group)
    names = ["anna", "m\\udcfcller", longest, "zoe"]
    assert (code, [row[:2] for row in rows]) == (2, [[name, "ok"] for name in names])
    assert "File name too long" in rows[2][-1]
    assert {b"m\xfcller.txt", b"zoe.txt"} <= set(os.listdir(os.fsencode(group / "check")))
    page = (group / "check/table.html").read_text(encoding="utf-8")
    assert '<a href="m%FCller.txt">m\\udcfcller</a>' in page


def test_what_was_said_last_week_is_not_todays(group, monkeypatch):
    (group / "ada").mkdir()
    assert check_all(group)[0] == 0
    reports = [group / "check" / name for name in ("ada.json", "ada.txt")]
    assert all(file.exists() for file in reports)
    monkeypatch.setattr(professor, "examine", lambda *_, **__: [].pop())
    assert check_all(group)[0] == 2
    assert [file.exists() for file in reports] == [False, True]
    assert "could not be checked: IndexError" in reports[1].read_text()


@pytest.mark.parametrize(
    ("blocked", "out", "why"),
    [("check/table.html/", None, "Is a directory"), ("file", "file", "--out names another")],
)
def test_results_that_cannot_be_written_are_found_before_the_work(
    group, monkeypatch, blocked, out, why
):
    (group / "ada").mkdir()
    path = group / blocked
    path.mkdir(parents=True) if blocked.endswith("/") else path.touch()
    begun = []
    monkeypatch.setattr(professor, "examine", lambda *_, **__: begun.append(1))
    with pytest.raises(CannotCheck, match=why):
        check_all(group, out and group / out)
    assert not begun


def test_what_is_no_folder_and_no_zip_has_a_row_all_the_same(group):
    for name in ("ADA.ZIP", "bob.tar.gz", "carl.7z", "dora.zip", "dora.ZIP", "README.md", "a.csv"):
        (group / name).touch()
    (group / "emma").symlink_to(group / "nowhere")
    (group / "loop").symlink_to(group / "loop")
    names = [one.name for one in professor.find_students(group, group / "check")]
    assert names == ["ADA", "bob.tar.gz", "carl.7z", "dora.ZIP", "dora.zip", "emma", "loop"]


@pytest.mark.parametrize("name", ["ada.zip", "ada"])
def test_a_link_is_not_followed(group, tmp_path, name):
    (tmp_path / "outside" / "src").mkdir(parents=True)
    (tmp_path / "outside.zip").touch()
    (group / name).symlink_to(tmp_path / f"outside{Path(name).suffix}")
    check_all(group)
    assert "checked: a link is not followed" in (group / "check" / "ada.txt").read_text()


def test_the_results_of_an_earlier_check_are_no_student(group, tmp_path, capsys):
    (group / "ada").mkdir()
    check_all(group)
    assert [row[0] for row in check_all(group, tmp_path / "elsewhere")[1]] == ["ada"]
    assert "check" not in (tmp_path / "elsewhere" / "table.csv").read_text()
    assert "check: left out: the results of an earlier check\n" in capsys.readouterr().out
    for name in ("table.csv", "table.html", "package.xml"):  # a student's, who names files so
        (group / "ada" / name).touch()
    assert [row[0] for row in check_all(group)[1]] == ["ada"]


@pytest.mark.parametrize("cell", ["=1", "\t=1", "\r=1", "x;=1", "x,\n+1", " -1", "a|@b"])
def test_no_cell_is_a_formula(cell):
    """Of whatever a spreadsheet takes for the end of a cell."""
    table = table_csv([Student(cell, None, trouble=f"{cell}: no zip")], ["2"])
    for written in re.split(r"[;,|\t\r\n]", table):
        assert written.strip(' "')[:1] not in tuple("=+-@"), table


def test_a_usual_name_is_as_it_was():
    names = ["Anna-Lena (2)", "a = b - c", "o'neill_7@uni.example", "a=b"]
    table = table_csv([Student(name, None) for name in names], ["2"])
    assert [row[0] for row in csv.reader(table.splitlines())][1:] == names


def test_the_table_has_what_could_be_checked():
    students = [
        Student("ada", None, [WELL, NO_VERDICT]),
        Student("=bob", None, [BAD, UNDECIDED]),
        Student("eve", None, [WELL, EMPTY]),
    ]
    rows = list(csv.reader(table_csv(students, ["2", "5"]).splitlines()))
    cells = [["ada", "ok", "?", "1"], ["'=bob", "C1", "-", "0"], ["eve", "ok", "not done", "1"]]
    assert [row[:4] for row in rows[1:]] == cells
    page = table_html(students, ["2", "5"], {"2": "a package", "5": "launch files"})
    assert 'title="C21: no space">?</td>' in page and 'class="wrong"' in page
    assert ">not done<" in page
