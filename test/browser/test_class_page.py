"""The page of a class in a browser: no script of a student's name or program runs."""

import pytest

from tutorial_check.launcher import Outcome
from tutorial_check.model import WRONG, Result
from tutorial_check.report.class_page import Student, table_html

RUN = "document.title='owned'"
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
    """Return the page of a class that has each of these words wherever a student's may be."""
    students = []
    for name in words:
        wrong = Result("C16", WRONG, "a title", expected=name, seen=name, where=name, hint=name)
        outcomes = [Outcome("4.3", [wrong], done=True)]
        students.append(Student(name, None, outcomes, before=outcomes))
        students.append(Student(f"{name} 2", None, trouble=name))
    return table_html(students, ["4.3"], {"4.3": "joy2twist"})


@pytest.mark.parametrize("got_in", ["", f"<script>{RUN}</script>"], ids=["names", "got in"])
def test_no_script_of_a_student_runs_on_the_page_of_a_class(shared_browser, tmp_path, got_in):
    page = tmp_path / "table.html"
    page.write_text(page_of(HOSTILE) + got_in, encoding="utf-8")
    shared_browser.driver.get(page.as_uri())
    shared_browser.ask(
        "document.querySelectorAll('td, a').forEach(one => {"
        " one.dispatchEvent(new MouseEvent('mouseover', {bubbles: true})); })"
    )
    assert shared_browser.ask("document.title") == "Exercises"
    assert f"<script>{RUN}</script>" in shared_browser.text("table")  # it is there to be read
    shared_browser.errors()  # the policy's words
