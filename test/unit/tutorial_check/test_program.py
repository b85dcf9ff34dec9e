"""The command line."""

import csv
import io
import os
import sys

import pytest

from tutorial_check import program
from tutorial_check.examination import Outcome
from tutorial_check.formats import FORMATS
from tutorial_check.model import OK, UNREACHED, WRONG, Result
from tutorial_check.professor import Student, table_csv, table_html
from tutorial_check.program import parse

BEFORE = ["--floor", "setup.bash", "--in", "ws"]


@pytest.mark.parametrize(
    ("words", "exercises"),
    [
        (["4"], ["4.2", "4.3", "4.4", "4.5"]),
        (["6", "2"], ["2", "6.1", "6.2"]),
        (["4.3", "4"], ["4.2", "4.3", "4.4", "4.5"]),
        (["5"], ["5"]),
        (["5.1", "3.2."], ["3", "5"]),
    ],
)
def test_a_section_is_all_its_exercises(words, exercises):
    assert parse([*BEFORE, *words]).exercises == exercises


def test_in_a_shell_of_a_workspace_that_is_meant(monkeypatch):
    monkeypatch.setenv("TUTORIAL_IN", "/mine")
    floor = ["--floor", "/setup.bash"]
    assert parse(floor).workspace == "/mine"
    assert parse([*floor, "--in", "/another"]).workspace == "/another"
    assert parse([*floor, "--all", "/class"]).all == "/class"


def test_no_workspace(capsys):
    with pytest.raises(SystemExit, match="2"):
        parse(["--floor", "/setup.bash", "3"])
    assert "which workspace? For example: --in ~/ros/hydro/catkin_ws 3\n" in capsys.readouterr().err


@pytest.mark.parametrize("word", ["7", "", ".", "4.9"])
def test_no_such_exercise(word, capsys):
    with pytest.raises(SystemExit):
        parse([*BEFORE, word])
    assert "no exercise" in capsys.readouterr().err


@pytest.mark.parametrize("option", ["--in", "--all", "--out", "--json", "--floor"])
def test_an_empty_word_is_not_the_current_folder(option, capsys):
    before = [] if option in ("--in", "--all") else BEFORE
    with pytest.raises(SystemExit, match="2"):
        parse([*before, option, ""])
    assert f"{option}: an empty word is no path" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--all", "class", "--json", "a"], "--json is for one workspace"),
        (["--all", "class", "--watch"], "--watch is for one workspace"),
        (["--in", "ws", "--watch", "--classroom", "a"], "leave --watch out"),
        (["--in", "ws", "--out", "a"], "--out is for --all"),
        (["--in", "ws", "--jobs", "2"], "--jobs is for --all"),
    ],
)
def test_an_option_that_would_do_nothing(words, told, capsys):
    with pytest.raises(SystemExit, match="2"):
        parse(["--floor", "setup.bash", *words])
    assert told in capsys.readouterr().err


def test_two_students_at_a_time():
    assert parse(["--floor", "setup.bash", "--all", "class"]).jobs == 2


WELL = Outcome("2", [Result("C1", OK, "one")], 1.0, True)
BAD = Outcome("2", [Result("C1", WRONG, "one")], 1.0, True)
NO_VERDICT = Outcome("5", [Result("C21", UNREACHED, "two")], 1.0, True, "C21: no room")


@pytest.mark.parametrize(
    ("outcomes", "code", "told"),
    [
        ([WELL], 0, ""),
        ([BAD], 1, ""),
        ([WELL, NO_VERDICT], 2, "check: 5: no verdict: C21: no room\n"),
        ([BAD, NO_VERDICT], 2, "check: 5: no verdict: C21: no room\n"),
    ],
)
def test_what_could_not_be_checked_is_told_beside_the_rest(
    outcomes, code, told, capsys, monkeypatch
):
    monkeypatch.setattr(program, "examine", lambda *_: outcomes)
    assert program.check_one(parse([*BEFORE, "2", "5"])) == code
    out, err = capsys.readouterr()
    assert f"{sum(one.passed for one in outcomes)} of {len(outcomes)} exercises done" in out
    assert err == told


def test_the_professors_table_has_what_could_be_checked(tmp_path):
    students = [
        Student("ada", tmp_path, [WELL, NO_VERDICT]),
        Student("=bob", tmp_path, [BAD, WELL]),
    ]
    students[1].outcomes[1] = Outcome("5", [Result("C21", UNREACHED, "two")], 1.0, True)
    rows = list(csv.reader(table_csv(students, ["2", "5"]).splitlines()))
    assert [row[:4] for row in rows[1:]] == [["ada", "ok", "?", "1"], ["'=bob", "C1", "-", "0"]]
    page = table_html(students, ["2", "5"])
    assert 'title="C21: no room">?</td>' in page and 'class="wrong"' in page


def test_without_a_verdict_classroom_50_gets_no_file(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(program, "examine", lambda *_: [WELL, NO_VERDICT])
    files = {name: tmp_path / name for name in ("classroom", "json")}
    words = [word for name, file in files.items() for word in (f"--{name}", str(file))]
    assert program.check_one(parse([*BEFORE, "2", "5", *words])) == 2
    assert not files["classroom"].exists()
    assert files["json"].exists()
    assert f"check: {files['classroom']} is not written" in capsys.readouterr().err


def test_no_hints_holds_for_files_too(tmp_path, monkeypatch):
    outcome = Outcome("2", [Result("C1", WRONG, "one", hint="mkdir src")], 1.0, True)
    monkeypatch.setattr(program, "examine", lambda *_: [outcome])
    program.check_one(parse([*BEFORE, "2", "--no-hints", "--json", str(tmp_path / "told")]))
    assert "mkdir src" not in (tmp_path / "told").read_text()


def main(monkeypatch, examine, *words):
    """The exit code."""
    monkeypatch.setattr(program, "examine", examine)
    monkeypatch.setattr(sys, "argv", ["check", *BEFORE, "2", *map(str, words)])
    with pytest.raises(SystemExit) as ended:
        program.main()
    return ended.value.code


def test_a_fault_of_the_checker_is_none_of_the_students(monkeypatch, capsys):
    assert main(monkeypatch, lambda *_: [].pop()) == 2
    error = capsys.readouterr().err
    assert "check: IndexError: pop from empty list (test_program.py:" in error
    assert "no fault in them" in error
    assert "Traceback" not in error


@pytest.mark.parametrize("name", FORMATS)
def test_a_file_of_an_earlier_check_is_not_left_for_this_one(tmp_path, monkeypatch, name):
    (tmp_path / "told").write_text("last week's")
    assert main(monkeypatch, lambda *_: [].pop(), f"--{name}", tmp_path / "told") == 2
    assert not (tmp_path / "told").exists()


def test_a_link_stays_one_and_so_does_what_is_no_file(tmp_path, monkeypatch):
    (tmp_path / "link").symlink_to(tmp_path / "told")
    os.mkfifo(tmp_path / "pipe")
    reader = os.open(tmp_path / "pipe", os.O_RDONLY | os.O_NONBLOCK)
    words = ["--json", tmp_path / "link", "--junit", tmp_path / "pipe"]
    assert main(monkeypatch, lambda *_: [WELL], *words) == 0
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "told").stat().st_size
    assert b"testsuites" in os.read(reader, 1000)
    os.close(reader)


@pytest.mark.parametrize("place", [".", "nowhere/told"])
def test_a_file_that_cannot_be_written_is_found_before_the_work(
    tmp_path, monkeypatch, capsys, place
):
    begun = []
    assert main(monkeypatch, lambda *_: begun.append(1), "--json", tmp_path / place) == 2
    assert not begun
    assert f"check: {tmp_path / place}: " in capsys.readouterr().err


def test_a_file_is_written_though_another_cannot_be(tmp_path, monkeypatch, capsys):
    def examine(*_):
        (tmp_path / "json").mkdir()
        return [WELL]

    words = ["--json", tmp_path / "json", "--junit", tmp_path / "junit"]
    assert main(monkeypatch, examine, *words) == 2
    assert "json: Is a directory" in capsys.readouterr().err
    assert "testsuites" in (tmp_path / "junit").read_text()


def test_a_name_that_is_no_utf_8_is_told(tmp_path, monkeypatch):
    outcome = Outcome("2", [Result("C1", WRONG, "one", seen="no file M\udcfcller.bag")], 1.0, True)

    def examine(workspace, floor, exercises, tell):
        tell(outcome, outcome.results[0])
        return [outcome]

    printed = io.BytesIO()
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(printed, "utf-8"))
    files = [word for name in FORMATS for word in (f"--{name}", tmp_path / name)]
    assert main(monkeypatch, examine, *files) == 1
    sys.stdout.flush()
    assert b"no file M\\udcfcller.bag" in printed.getvalue()
    assert "M\\udcfcller.bag" in (tmp_path / "junit").read_text(encoding="utf-8")
    assert all((tmp_path / name).stat().st_size for name in FORMATS)
