"""--all: odd names and results that cannot be written do not affect other students."""

import csv
import json
import os
from dataclasses import replace
from pathlib import Path
from threading import Event
from types import SimpleNamespace

import pytest

from tutorial_check.checking.results import OK, UNREACHED, Outcome, Result
from tutorial_check.commands import check_all as submissions
from tutorial_check.course.definition import read_course
from tutorial_check.errors import CannotCheck
from tutorial_check.report.memory import digest_of_checks
from tutorial_testing.claims import claim
from tutorial_testing.waiting import wait_for

pytestmark = [
    claim("Each folder or ...", because="odd names"),
    claim(
        "Only what changed or had no verdict is checked again; results of an earlier check are no "
        "student"
    ),
]
WELL = Outcome("2", [Result("C1", OK, "one")], 1.0, True)
NO_VERDICT = Outcome("2", [Result("C1", UNREACHED, "one")], 1.0, True, "C1: no space")


class Group:
    """A folder of students, all of them right; started: those whose check has started."""

    def __init__(self, folder):
        self.folder, self.check, self.started = folder, folder / "check", []
        self.come_to = lambda name: [WELL]
        folder.mkdir()

    def examine(self, order):
        self.started.append(order.workspace.name)
        return self.come_to(order.workspace.name)

    def check_all(self, out=None, again=False, variant=None):
        """Return the exit code and the rows of the table."""
        about = {"jobs": 1, "hints": 2, "again": again, "underlay": "", "exercises": ["2"]}
        about.update(
            variant=variant,
            variants=None,
            cluster=None,
            language="",
            keep=self.folder.parent / "kept",
        )
        options = SimpleNamespace(all=str(self.folder), out=out, course=read_course(), **about)
        code = submissions.check_all(options)
        with (self.check / "table.csv").open(newline="", encoding="utf-8") as table:
            return code, list(csv.reader(table))[1:]

    def add(self, *names):
        for name in names:
            (self.folder / name).touch() if "." in name else (self.folder / name).mkdir()


@pytest.fixture
def group(tmp_path, monkeypatch):
    made = Group(tmp_path / "group")
    monkeypatch.setattr(submissions, "examine", made.examine)
    return made


def test_what_was_recorded_is_kept_and_not_in_reports(group):
    recorded = {"recorder": "m:drive", "arguments": [], "recording": {"speed": 0.5}}
    group.come_to = lambda name: [replace(WELL, recordings=[recorded])]
    group.add("ada")
    group.check_all()
    texts = [folder / "ada.json" for folder in (group.folder.parent / "kept", group.check)]
    kept, report = (json.loads(path.read_text())["exercises"][0] for path in texts)
    assert kept["recordings"] == [recorded]
    assert "recordings" not in report


def test_a_folder_and_a_zip_of_one_name_have_each_a_report(group):
    group.add("anna", "anna.zip", "anna.zip.zip", "bob.zip")
    names = ["anna", "anna.zip", "anna.zip.zip", "bob"]
    code, rows = group.check_all()
    assert (code, [row[0] for row in rows]) == (0, names)
    assert sorted(path.stem for path in group.check.glob("*.txt")) == names
    page = (group.check / "table.html").read_text()
    assert all(f'<a href="./{name}.txt">{name}</a>' in page for name in names)


def test_students_with_odd_names_are_checked(group):
    """One name is not UTF-8; another is too long for a report."""
    longest = "n" * 255
    for name in (b"anna", b"m\xfcller", longest.encode(), b"zoe"):
        os.mkdir(os.path.join(os.fsencode(group.folder), name))
    code, rows = group.check_all()
    names = ["anna", "m\\udcfcller", longest, "zoe"]
    assert (code, [row[:2] for row in rows]) == (2, [[name, "ok"] for name in names])
    assert "File name too long" in rows[2][-1]
    assert {b"m\xfcller.txt", b"zoe.txt"} <= set(os.listdir(os.fsencode(group.check)))
    page = (group.check / "table.html").read_text(encoding="utf-8")
    assert '<a href="./m%FCller.txt">m\\udcfcller</a>' in page


def test_reports_of_an_earlier_check_are_removed(group):
    group.add("ada")
    assert group.check_all()[0] == 0
    reports = [group.check / name for name in ("ada.json", "ada.txt")]
    assert all(file.exists() for file in reports)
    group.come_to = lambda name: [].pop()
    assert group.check_all(again=True)[0] == 2
    assert [file.exists() for file in reports] == [False, True]
    assert "could not be checked: IndexError" in reports[1].read_text()


def test_what_is_no_folder_and_no_zip_has_a_row_all_the_same(group):
    group.add("ADA.ZIP", "bob.tar.gz", "carl.7z", "dora.zip", "dora.ZIP", "README.md", "a.csv")
    (group.folder / "emma").symlink_to(group.folder / "nowhere")
    (group.folder / "loop").symlink_to(group.folder / "loop")
    names = [student.name for student in submissions.find_students(group.folder, group.check)]
    assert names == ["ADA", "bob.tar.gz", "carl.7z", "dora.ZIP", "dora.zip", "emma", "loop"]


@pytest.mark.parametrize("name", ["ada.zip", "ada"])
def test_a_link_is_not_followed(group, tmp_path, name):
    (tmp_path / "outside" / "src").mkdir(parents=True)
    (tmp_path / "outside.zip").touch()
    (group.folder / name).symlink_to(tmp_path / f"outside{Path(name).suffix}")
    group.check_all()
    assert "checked: a link is not followed" in (group.check / "ada.txt").read_text()


def test_the_results_of_an_earlier_check_are_no_student(group, tmp_path, capsys):
    group.add("ada")
    group.check_all()
    assert [row[0] for row in group.check_all(tmp_path / "elsewhere")[1]] == ["ada"]
    assert "check" not in (tmp_path / "elsewhere" / "table.csv").read_text()
    assert "check: left out: the results of an earlier check\n" in capsys.readouterr().out
    for name in (
        "table.csv",
        "table.html",
        "package.xml",
    ):  # of a student
        (group.folder / "ada" / name).touch()
    assert [row[0] for row in group.check_all()[1]] == ["ada"]


def test_only_what_changed_or_had_no_verdict_is_checked_again(group, capsys):
    group.add("ada", "bob", "eve")
    (group.folder / "eve" / "talker.py").touch()
    assert group.check_all()[0] == 0
    (group.folder / "bob" / "talker.py").write_text("2")
    (group.folder / "eve" / "talker.py").chmod(0o755)
    first = group.check_all()
    assert group.check_all() == (0, [[*row[:4], "0.0", *row[5:]] for row in first[1]])
    assert group.started == ["ada", "bob", "eve", "bob", "eve"]
    assert "ada: 1 of 1 exercises done, unchanged since the last check" in capsys.readouterr().out
    group.come_to = lambda name: [NO_VERDICT]
    group.check_all(again=True)
    group.check_all()
    assert group.started[5:] == ["ada", "bob", "eve"] * 2


@claim("The page shows ...", because="opened meanwhile")
def test_the_page_can_be_read_while_it_is_made(group):
    pages = []

    def look(name):
        page, left = group.check / "table.html", 2 - len(pages)
        wait_for(lambda: page.read_text().count('">...</td>') == left, "page after the one before")
        pages.append(page.read_text())
        return [WELL]

    group.come_to = look
    group.add("ada", "bob")
    assert group.check_all()[0] == 0
    assert all('http-equiv="refresh"' in page for page in pages)
    assert 'http-equiv="refresh"' not in (group.check / "table.html").read_text()


@pytest.mark.parametrize("text", ["{", '{"ada": 3}', '{"ada": {"outcomes": [{"x": 1}]}}'])
def test_a_broken_state_is_ignored(group, text):
    group.add("ada")
    group.check.mkdir()
    (group.check / ".state.json").write_text(text)
    assert group.check_all()[0] == 0


def test_another_exercise_or_level_of_hints_makes_other_checks():
    given = [(["2"], 2), (["3"], 2), (["2"], 0)]
    assert len({digest_of_checks(read_course(), *choice) for choice in given}) == 3


def test_a_folder_called_variants_is_a_submission_unless_it_is_named(group, capsys):
    group.add("ada", "variants")
    (group.folder / "variants/ada.yaml").write_text("no task")
    assert [row[:2] for row in group.check_all()[1]] == [["ada", "ok"], ["variants", "ok"]]
    assert "variants: a submission; if it has students' tasks" in capsys.readouterr().out
    code, rows = group.check_all(variant=str(group.folder / "variants"))
    assert (code, [row[0] for row in rows]) == (2, ["ada"]) and "a map of values" in rows[0][-1]


@pytest.mark.parametrize(
    ("blocked", "out", "why"),
    [("check/table.html/", None, "Is a directory"), ("file", "file", "with --out")],
)
def test_results_that_cannot_be_written_are_found_before_the_work(group, blocked, out, why):
    group.add("ada")
    path = group.folder / blocked
    path.mkdir(parents=True) if blocked.endswith("/") else path.touch()
    with pytest.raises(CannotCheck, match=why):
        group.check_all(out and group.folder / out)
    assert not group.started


def test_a_run_that_was_interrupted_goes_on_where_it_was(group, monkeypatch):
    def interrupted_once(name):
        if name == "bob" and len(group.started) < 3:
            raise KeyboardInterrupt
        return [WELL]

    group.come_to = interrupted_once
    monkeypatch.setattr(submissions, "no_more", Event())
    group.add("ada", "bob")
    with pytest.raises(KeyboardInterrupt):
        group.check_all()
    assert group.check_all()[0] == 0
    assert group.started == ["ada", "bob", "bob"]


def test_moodles_folders_have_the_names_of_students(tmp_path):
    """Two students with the same name have their folders' names, because reports are files."""
    group = Group(tmp_path / "class")
    ending = "_assignsubmission_file_"
    folders = [f"Ada Lovelace_2101{ending}", f"Bo Li_7{ending}", f"Bo Li_8{ending}"]
    for name in folders:
        (group.folder / name).mkdir()
    names = [student.name for student in submissions.find_students(group.folder, group.check)]
    assert names == ["Ada Lovelace", *folders[1:]]
