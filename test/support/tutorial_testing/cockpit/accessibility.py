"""What axe finds on a page."""

import pytest

WCAG = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22a", "wcag22aa"]
# Only violations are examined and returned: the rest would take twice as long.
AXE = """const [given, done] = arguments, options = {runOnly: given, resultTypes: ["violations"]};
axe.run(document, options).then(({violations}) => done(violations));"""


def violations(page):
    """Return [(axe's rule, first element that breaks it)] of the page as it is shown."""
    axe_selenium = pytest.importorskip("selenium_axe_python", reason="needs Python 3.9")
    if page.ask("typeof axe") == "undefined":
        axe_selenium.Axe(page.driver).inject()
    broken = page.driver.execute_async_script(AXE, WCAG)
    return [(rule["id"], rule["nodes"][0]["html"]) for rule in broken]
