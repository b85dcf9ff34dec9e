"""--all: whose names are odd, and what cannot be written, costs nobody else his results."""

import csv
import os
import re
from pathlib import Path
from types import SimpleNamespace

import pytest

from tutorial_check import professor
from tutorial_check.examination import Outcome
from tutorial_check.model import OK, WRONG, CannotCheck, Result

WELL = Outcome("2", [Result("C1", OK, "one")], 1.0, True)


@pytest.fixture
def room(tmp_path, monkeypatch):
    """A folder for students, all of whom are right."""
    monkeypatch.setattr(professor, "examine", lambda *_, **__: [WELL])
    (tmp_path / "room").mkdir()
    return tmp_path / "room"


def check_all(room, out=None, no_hints=False):
    """(exit code, rows of the table)."""
    options = SimpleNamespace(
        all=str(room), out=out, jobs=1, no_hints=no_hints, floor="", exercises=["2"]
    )
    code = professor.check_all(options)
    with (room / "check" / "table.csv").open(newline="", encoding="utf-8") as table:
        return code, list(csv.reader(table))[1:]


def test_a_folder_and_a_zip_of_one_name_have_each_a_report(room):
    (room / "anna").mkdir()
    for name in ("anna.zip", "anna.zip.zip", "bob.zip"):
        (room / name).touch()
    names = ["anna", "anna.zip", "anna.zip.zip", "bob"]
    code, rows = check_all(room)
    assert (code, [row[0] for row in rows]) == (0, names)
    assert sorted(path.stem for path in (room / "check").glob("*.txt")) == names
    page = (room / "check/table.html").read_text()
    assert all(f'<a href="{name}.txt">{name}</a>' in page for name in names)


def test_a_name_that_is_no_utf_8(room):
    for name in (b"anna", b"m\xfcller", b"zoe"):
        os.mkdir(os.path.join(os.fsencode(room), name))
    code, rows = check_all(room)
    assert (code, [row[:2] for row in rows]) == (
        0,
        [["anna", "ok"], ["m\\udcfcller", "ok"], ["zoe", "ok"]],
    )
    assert b"m\xfcller.txt" in os.listdir(os.fsencode(room / "check"))
    page = (room / "check/table.html").read_text(encoding="utf-8")
    assert '<a href="m%FCller.txt">m\\udcfcller</a>' in page


def test_a_report_that_cannot_be_written(room):
    longest = "n" * 255
    for name in ("anna", longest, "zoe"):
        (room / name).mkdir()
    code, rows = check_all(room)
    assert (code, [row[:2] for row in rows]) == (
        2,
        [["anna", "ok"], [longest, "ok"], ["zoe", "ok"]],
    )
    assert "File name too long" in rows[1][-1]
    assert (room / "check/zoe.txt").exists()


def test_results_that_have_no_place(room):
    (room / "anna").mkdir()
    (room / "file").touch()
    with pytest.raises(CannotCheck, match="--out names another"):
        check_all(room, room / "file")


def fail(*_, **__):
    raise CannotCheck("no room")


def test_what_was_said_last_week_is_not_todays(room, monkeypatch):
    (room / "ada").mkdir()
    assert check_all(room)[0] == 0
    told = [room / "check" / name for name in ("ada.json", "ada.txt")]
    assert all(file.exists() for file in told)
    monkeypatch.setattr(professor, "examine", fail)
    assert check_all(room)[0] == 2
    assert [file.exists() for file in told] == [False, True]
    assert "no room" in told[1].read_text()


def test_a_table_that_cannot_be_written_is_found_before_the_work(room, monkeypatch):
    (room / "ada").mkdir()
    (room / "check" / "table.html").mkdir(parents=True)
    begun = []
    monkeypatch.setattr(professor, "examine", lambda *_, **__: begun.append(1))
    with pytest.raises(CannotCheck, match="Is a directory"):
        check_all(room)
    assert not begun


@pytest.mark.parametrize("no_hints", [True, False])
def test_hints_only_where_they_are_wanted(room, monkeypatch, no_hints):
    bad = Outcome("2", [Result("C1", WRONG, "one", seen="none", hint="mkdir src")], 1.0, True)
    monkeypatch.setattr(professor, "examine", lambda *_, **__: [bad])
    (room / "ada").mkdir()
    check_all(room, no_hints=no_hints)
    for name in ("ada.txt", "ada.json", "table.html"):
        assert ("mkdir src" in (room / "check" / name).read_text()) != no_hints, name


def test_what_is_no_folder_and_no_zip_has_a_row_all_the_same(room):
    for name in ("ADA.ZIP", "bob.tar.gz", "carl.7z", "dora.zip", "dora.ZIP", "README.md", "a.csv"):
        (room / name).touch()
    (room / "emma").symlink_to(room / "nowhere")
    (room / "loop").symlink_to(room / "loop")
    names = [one.name for one in professor.find_students(room, room / "check")]
    assert names == ["ADA", "bob.tar.gz", "carl.7z", "dora.ZIP", "dora.zip", "emma", "loop"]


@pytest.mark.parametrize("name", ["ada.zip", "ada"])
def test_a_link_is_not_followed(room, tmp_path, name):
    (tmp_path / "outside" / "src").mkdir(parents=True)
    (tmp_path / "outside.zip").touch()
    (room / name).symlink_to(tmp_path / f"outside{Path(name).suffix}")
    check_all(room)
    assert (
        "could not be checked: a link is not followed" in (room / "check" / "ada.txt").read_text()
    )


def test_the_results_of_an_earlier_check_are_no_student(room, tmp_path, capsys):
    (room / "ada").mkdir()
    check_all(room)
    assert "left out" not in capsys.readouterr().out
    assert [row[0] for row in check_all(room, tmp_path / "elsewhere")[1]] == ["ada"]
    assert "check" not in (tmp_path / "elsewhere" / "table.csv").read_text()
    assert "check: left out: the results of an earlier check\n" in capsys.readouterr().out


@pytest.mark.parametrize("more", ["src", "joy2twist.zip", "package.xml"])
def test_a_student_who_calls_his_files_like_results_is_in_the_table(room, more):
    for name in ("table.csv", "table.html", more):
        (room / "ada" / name).parent.mkdir(exist_ok=True)
        (room / "ada" / name).touch() if more != "src" else (room / "ada" / name).mkdir()
    assert [row[0] for row in check_all(room)[1]] == ["ada"]


@pytest.mark.parametrize("cell", ["=1", "\t=1", "\r=1", "x;=1", "x,\n+1", " -1", "a|@b"])
def test_no_cell_is_a_formula(cell):
    """Of whatever a spreadsheet takes for the end of a cell."""
    student = professor.Student(cell, None, trouble=f"{cell}: no zip")
    table = professor.table_csv([student], ["2"])
    for written in re.split(r"[;,|\t\r\n]", table):
        assert written.strip(' "')[:1] not in tuple("=+-@"), table


def test_a_usual_name_and_remark_are_as_they_were():
    names = ["Anna-Lena (2)", "a = b - c", "o'neill_7@uni.example", "a=b"]
    table = professor.table_csv([professor.Student(name, None) for name in names], ["2"])
    assert [row[0] for row in csv.reader(table.splitlines())][1:] == names
