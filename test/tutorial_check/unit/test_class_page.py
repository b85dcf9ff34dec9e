"""The page and the table of a class: their content, and what nobody can inject."""

import csv
import re
from dataclasses import replace

import pytest

from tutorial_check.checking.results import NOTE, OK, UNREACHED, WRONG, Outcome, Result
from tutorial_check.report import class_page
from tutorial_check.report.class_page import POLICY, Student, table_csv, table_html
from tutorial_testing.claims import claim

pytestmark = [
    claim("The page shows how many fail what, why, and what changed, and can be opened meanwhile"),
    claim("No script runs in the page and no cell of the table is a formula"),
]
NOTED = Outcome("2", [Result("C1", NOTE, "one", seen="a name")], 1.0, True)
BAD = Outcome("2", [Result("C1", WRONG, "one", seen="=none", hint="mkdir src")], 1.0, True)
FILES = Result("C20", OK, "files", seen="launch/joy.launch")
UNDECIDED = Outcome("5", [FILES, Result("C21", UNREACHED, "two", seen="first fix C1")], 1.0, True)
NO_VERDICT = Outcome("5", UNDECIDED.results, 1.0, True, "C21: no space")
EMPTY = Outcome("5", [Result("C21", OK, "two", empty=True)], done=True)
TITLES = {"2": "a package", "5": "launch files"}
ABOUT = "/home/ada/class, 27 November 2026, 14:40"
TEXTS = ("title", "expected", "seen", "where", "hint")
HOSTILE = "<script>alert(1)</script>\"'><img src=x onerror=alert(1)>"


@pytest.mark.parametrize("cell", ["=1", "\t=1", "x;=1", "x,\n+1", " -1", "a|@b"])
def test_no_cell_is_a_formula(cell):
    """Whatever a spreadsheet treats as the end of a cell."""
    table = table_csv([Student(cell, None, trouble=f"{cell}: no zip")], ["2"])
    for written in re.split(r"[;,|\t\r\n]", table):
        assert written.strip(' "')[:1] not in tuple("=+-@"), table


def test_the_table_has_what_could_be_checked():
    students = [
        Student("ada", None, [NOTED, NO_VERDICT]),
        Student("=bob", None, [replace(BAD, remark="not isolated"), UNDECIDED]),
        Student("o'neill_7@uni.example = b - c", None, [NOTED, EMPTY]),
    ]
    rows = list(csv.reader(table_csv(students, ["2", "5"]).splitlines()))
    assert [row[:5] for row in rows[1:]] == [
        ["ada", "ok", "?", "1", "1"],
        ["'=bob", "C1", "-", "0", "0"],
        ["o'neill_7@uni.example = b - c", "ok", "not done", "1", "1"],
    ]
    assert [row[6:] for row in rows[1:]] == [["", ""], ["'=none", "not isolated"], ["", ""]]
    page = table_html(students, ["2", "5"], TITLES, ABOUT)
    assert 'title="C21: no space">?</td>' in page and 'class="wrong"' in page
    for cell in (">-<small>first fix C1</small>", ">not done<", "<td>1 of 2</td><td>1</td>"):
        assert cell in page
    assert "=bob</a></td><td>not isolated</td>" in page
    assert f"<p>{ABOUT}</p>" in page and f"<title>Exercises: {ABOUT}</title>" in page
    total = "<tr><th>all 3</th><td>2 of 3</td><td>0 of 3</td><td>0 of 3</td><td>2</td>"
    assert total in page


def wrong(seen, check="C16", **more):
    return Outcome("5", [Result(check, WRONG, "axes", "a sign", seen, **more)], done=True)


def test_how_many_fail_what_and_why():
    students = [
        Student("ada", None, [wrong("the sign of ada is wrong", hint="fix Ada's")]),
        Student("bob", None, [wrong("angular.z = -0.98 * axes[0]")]),
        Student("eve", None, [wrong("angular.z = -1.00 * axes[0]")]),
        Student("zoe", None, [wrong("no file", "C12")]),
    ]
    assert class_page.failures(students) == [("C16", "axes", 3), ("C12", "axes", 1)]
    causes = class_page.causes(students)
    names = [[student.name for student in whose] for whose, _ in causes]
    assert names == [["bob", "eve"], ["ada"], ["zoe"]]
    assert causes[0][1].seen == "angular.z = -0.98 * axes[0]"
    # An example does not name its student.
    assert (causes[1][1].seen, causes[1][1].hint) == ("the sign of NAME is wrong", "fix NAME's")
    page = table_html(students, ["5"], TITLES, ABOUT)
    below = page[page.index("<h2>") :]
    assert "<td>C16</td><td>axes</td><td>3</td>" in below
    bob, eve = (f'<a href="./{name}.txt">{name}</a>' for name in ("bob", "eve"))
    assert f"<tr><td>{bob}, {eve}</td><td>C16 axes</td>" in below
    assert ">C16<small>angular.z = -0.98 * axes[0]</small></td>" in page


def test_what_changed_since_the_last_run():
    changes = class_page.changes
    well = Outcome("5", NOTED.results, done=True)
    again = Student("ada", None, [wrong("b")], before=[wrong("a")])
    fixed = Student("bob", None, [well], before=[wrong("a")])
    worse = Student("eve", None, [wrong("a")], before=[well])
    another = Student("zoe", None, [wrong("a", "C17")], before=[wrong("a")])
    assert changes(again)["stuck"] == ["C16 axes"]
    assert (changes(fixed)["now done"], changes(worse)["no longer done"]) == (["5"], ["5"])
    assert not any(changes(another).values())
    page = table_html([again, fixed, worse, another], ["5"], TITLES, ABOUT)
    since = page[page.index("Since the last run") : page.index("Legend")]
    assert [name in since for name in ("ada", "bob", "eve", "zoe")] == [True, True, True, False]
    assert "Since the last run" not in table_html(
        [Student("ada", None, [BAD])], ["2"], TITLES, ABOUT
    )


@pytest.mark.parametrize("field", ["name", "trouble", *TEXTS])
def test_nothing_in_a_page_is_a_tag(field):
    words = {**dict.fromkeys(("name", "trouble", *TEXTS), ""), field: HOSTILE}
    name, trouble = words.pop("name"), words.pop("trouble")
    outcomes = [Outcome("5", [Result("C16", WRONG, **words)], done=True)]
    student = Student(name, None, [] if trouble else outcomes, trouble=trouble, before=outcomes)
    page = table_html([student], ["5"], TITLES, ABOUT)
    tags = set(re.findall(r"<(\w+)", page))
    assert not tags & {"script", "img"}
    assert "&lt;script&gt;" in page and " onerror" not in re.sub(r"&lt;.*?&gt;", "", page)
    assert POLICY.split(";")[0] == "default-src 'none'"
    assert '<meta http-equiv="Content-Security-Policy"' in page
