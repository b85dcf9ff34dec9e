"""The page of a class in a browser: no script of a student's name or program runs."""

import pytest

from tutorial_check.class_page import Student, table_html
from tutorial_check.examination import Outcome
from tutorial_check.model import WRONG, Result

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


@pytest.fixture
def title_of(browser, tmp_path):
    def title(html):
        page = tmp_path / "table.html"
        page.write_text(html, encoding="utf-8")
        browser.driver.get(page.as_uri())
        browser.ask(
            "document.querySelectorAll('td, a').forEach(one => {"
            " one.dispatchEvent(new MouseEvent('mouseover', {bubbles: true})); })"
        )
        return browser.ask("document.title")

    return title


def test_no_script_runs(browser, title_of):
    assert title_of(page_of(HOSTILE)) == "Exercises"
    assert browser.ask("document.querySelectorAll('script, img, svg').length") == 0
    assert f"<script>{RUN}</script>" in browser.text("table")  # it is there to be read


def test_the_policy_stops_a_script_that_got_in(title_of):
    assert title_of(page_of([]) + f"<script>{RUN}</script>") == "Exercises"
    assert title_of(f"<script>{RUN}</script>") == "owned"  # the test would see it
