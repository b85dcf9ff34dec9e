"""The table of a class: all columns in sight, also on paper, and accessible, as axe checks."""

from pathlib import Path

import pytest

from tutorial_check.checking.results import NOTE, OK, UNREACHED, WRONG, Outcome, Result
from tutorial_check.course.definition import read_course
from tutorial_check.report.class_page import Student, table_html
from tutorial_testing.claims import claim
from tutorial_testing.cockpit.accessibility import violations

pytestmark = claim(
    "A class's table fits a screen of 1,280 pixels and a sheet of paper, with all columns, light "
    "and dark"
)
WIDTH, HEIGHT = 1280, 800
A4_LANDSCAPE_PX = 1047  # 277 mm between its margins, 96 px an inch
TITLES = {name: exercise.title for name, exercise in read_course().exercises.items()}
SEEN = "angular.z = 0.98 * axes[0] in place of 1.00 * axes[0], and zero for what follows"
ENDS = {
    OK: Result("C1", OK, "one"),
    WRONG: Result("C16", WRONG, "which axis drives what", "one constant", SEEN, "joy2twist.py:18"),
    UNREACHED: Result("C21", UNREACHED, "two", seen="first fix C16: which axis drives what"),
}


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    """The URL of a class of 40 with long names and causes, in a file."""
    students = []
    for number in range(40):
        ends = [list(ENDS)[(number + at) % 3] for at in range(len(TITLES))]
        outcomes = [Outcome(name, [ENDS[end]], done=True) for name, end in zip(TITLES, ends)]
        name = f"Maximilian-Alexander von der Heidenreich {number}"
        students.append(Student(name, Path(), outcomes, before=outcomes))
    students[3].outcomes[0].results.append(Result("C2", NOTE, "three", seen="a note"))
    students += [Student("zip", Path(), trouble="cannot be unpacked"), Student("next", Path())]
    file = tmp_path_factory.mktemp("class") / "table.html"
    page = table_html(students, list(TITLES), TITLES, "/home/ada/class, 27 November 2026, 14:40")
    file.write_text(page.replace('<meta http-equiv="refresh" content="5">', ""))
    return file.as_uri()


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_all_columns_of_a_class_are_in_sight_and_axe_finds_nothing(address, shared_browser, scheme):
    page = shared_browser
    features = [{"name": "prefers-color-scheme", "value": scheme}]
    page.send("Emulation.setEmulatedMedia", features=features)
    page.resize(WIDTH, HEIGHT)
    page.driver.get(address)
    assert page.ask("document.documentElement.scrollWidth") <= WIDTH
    right = "document.querySelector('tr').lastElementChild.getBoundingClientRect().right"
    assert page.ask("document.querySelector('tr').lastElementChild.innerText") == "took"
    assert WIDTH - 100 < page.ask(right) <= WIDTH
    assert violations(page) == []
    causes = "[...document.querySelectorAll('h2')].find((one) => one.innerText.includes('causes'))"
    link = f"{causes}.nextElementSibling.querySelector('td a').getAttribute('href')"
    assert page.ask(link).endswith(".txt")
    page.resize()


def test_all_columns_of_a_class_are_on_paper(address, shared_browser):
    page = shared_browser
    page.driver.get(address)
    page.send("Emulation.setEmulatedMedia", media="print", features=[])
    page.resize(A4_LANDSCAPE_PX, HEIGHT)
    assert page.ask("document.documentElement.scrollWidth") <= A4_LANDSCAPE_PX
    page.send("Emulation.setEmulatedMedia", media="")
    page.resize()
