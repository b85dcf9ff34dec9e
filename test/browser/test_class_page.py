"""The page of a class in a browser: whatever a student's name or program says, no script runs."""

from tutorial_check.class_page import Student, table_html
from tutorial_check.examination import Outcome
from tutorial_check.model import WRONG, Result

RUN = "document.title='owned';document.body.dataset.owned='yes'"
HOSTILE = (
    f"<script>{RUN}</script>",
    f'<img src=x onerror="{RUN}">',
    f'"><svg onload="{RUN}">',
    f"'><body onload='{RUN}'>",
    f'" onmouseover="{RUN}" autofocus onfocus="{RUN}" x="',
    f"</title><script>{RUN}</script>",
    f"</style><script>{RUN}</script>",
    f"javascript:{RUN}",
)


def page_of(words):
    """Return the page of a class in which all of this stands wherever a student's words may."""
    students = []
    for name in words:
        wrong = Result("C16", WRONG, "a title", expected=name, seen=name, where=name, hint=name)
        outcomes = [Outcome("4.3", [wrong], done=True)]
        students.append(Student(name, None, outcomes, before=outcomes))
        students.append(Student(f"{name} 2", None, trouble=name))
    return table_html(students, ["4.3"], {"4.3": "joy2twist"})


def test_no_script_runs(browser, tmp_path):
    page = tmp_path / "table.html"
    page.write_text(page_of(HOSTILE), encoding="utf-8")
    browser.driver.get(page.as_uri())
    browser.ask("document.querySelectorAll('td, a').forEach(one => {"
                " one.dispatchEvent(new MouseEvent('mouseover', {bubbles: true})); })")  # fmt: skip
    assert browser.ask("document.title") == "Exercises"
    assert browser.ask("document.body.dataset.owned || ''") == ""
    assert browser.ask("document.querySelectorAll('script, img, svg').length") == 0
    # It is there to be read.
    assert f"<script>{RUN}</script>" in browser.text("table")


def test_the_policy_stops_a_script_that_got_in(browser, tmp_path):
    page = tmp_path / "table.html"
    page.write_text(page_of([]) + f"<script>{RUN}</script>", encoding="utf-8")
    browser.driver.get(page.as_uri())
    assert browser.ask("document.title") == "Exercises"
    page.write_text(
        f"<title>Exercises</title><script>{RUN.split(';', maxsplit=1)[0]}</script>",
        encoding="utf-8",
    )
    browser.driver.get(page.as_uri())
    assert browser.ask("document.title") == "owned"  # the test would see it
