"""The command line."""

import csv

import pytest

from tutorial_check import program
from tutorial_check.examination import Outcome
from tutorial_check.model import OK, UNREACHED, WRONG, Result
from tutorial_check.professor import Student, table_html, write_csv
from tutorial_check.program import parse

BEFORE = ["--floor", "setup.bash", "--in", "ws"]


@pytest.mark.parametrize(
    ("words", "exercises"),
    [
        (["4"], ["4.2", "4.3", "4.4", "4.5"]),
        (["6", "2"], ["2", "6.1", "6.2"]),
        (["4.3", "4"], ["4.2", "4.3", "4.4", "4.5"]),
        (["5"], ["5"]),
    ],
)
def test_a_section_is_all_its_exercises(words, exercises):
    assert parse([*BEFORE, *words]).exercises == exercises


@pytest.mark.parametrize("word", ["7", "", ".", "4.9"])
def test_no_such_exercise(word, capsys):
    with pytest.raises(SystemExit):
        parse([*BEFORE, word])
    assert "no exercise" in capsys.readouterr().err


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
    write_csv(tmp_path / "table.csv", students, ["2", "5"])
    rows = list(csv.reader((tmp_path / "table.csv").open()))
    assert [row[:4] for row in rows[1:]] == [["ada", "ok", "?", "1"], ["'=bob", "C1", "-", "0"]]
    page = table_html(students, ["2", "5"])
    assert 'title="C21: no room">?</td>' in page and 'class="wrong"' in page
