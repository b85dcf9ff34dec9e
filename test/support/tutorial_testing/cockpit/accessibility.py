"""What axe finds on a page."""

import pytest

WCAG = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22a", "wcag22aa"]
# What is wrong alone is looked at closely, and comes back: all else would take twice as long.
AXE = """const [given, done] = arguments, options = {runOnly: given, resultTypes: ["violations"]};
axe.run(document, options).then((found) => done(found.violations));"""


def violations(page):
    """Return [(rule of WCAG, first element that breaks it)] of what is shown, as axe finds them."""
    axe_selenium = pytest.importorskip("selenium_axe_python", reason="needs Python 3.9")
    if page.ask("typeof axe") == "undefined":
        axe_selenium.Axe(page.driver).inject()
    found = page.driver.execute_async_script(AXE, WCAG)
    return [(one["id"], one["nodes"][0]["html"]) for one in found]
