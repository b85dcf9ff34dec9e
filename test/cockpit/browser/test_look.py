"""The page at all sizes: it scrolls in one direction, Stop is in sight, and axe finds nothing."""

import pytest

from tutorial_testing.claims import claim
from tutorial_testing.cockpit.accessibility import violations
from tutorial_testing.waiting import wait_for

TABS = (
    "[...document.querySelectorAll('[role=tab]')].map((tab) => tab.getAttribute('aria-controls'))"
)
# What to choose in a tab, and what it then shows.
CHOSEN = {
    "frames": [("#frames-rows tr:nth-child(2)", "#frames-transform:not(:empty)")],
    "graph": [("#graph .topic", "#graph-details dd")],
    "topics": [("#topics-rows tr", "#topics-fields input")],
    "diagnostics": [("#diagnostics-tree details details > summary", "#diagnostics-tree td")],
    "bag": [("#bag-fields li:nth-child(8) input", "#bag-values span:nth-child(7)")],
    "plot": [("#plot-fields li:nth-child(10) input", "#plot-values span")],
}
NARROW = (320, 256)  # 1280 x 1024 at 400 %: WCAG 2.2, 1.4.10
VIEWS = {"dark": (1280, 800), "light": NARROW}
# The right edge of the widest element, except for pictures and tables, which may scroll.
WIDEST = """Math.max(document.documentElement.scrollWidth,
  ...[...document.querySelectorAll("body *")].filter((element) => element.getClientRects().length
    && !element.closest("#graph-picture svg, pre, .unseen, table"))
    .map((element) => element.getBoundingClientRect().right))"""


@claim(
    "At 400 % nothing is scrolled in two directions, and Stop stays in sight; axe finds nothing on "
    "any tab"
)
@pytest.mark.parametrize("view", VIEWS)
def test_axe_finds_nothing_and_no_tab_is_scrolled_in_two_directions(world, shared_browser, view):
    page = shared_browser
    features = [{"name": "prefers-color-scheme", "value": view}]
    page.send("Emulation.setEmulatedMedia", features=features)
    page.resize(*VIEWS[view])
    page.open(world.address)
    assert len(page.all("h1")) == 1
    for name in page.ask(TABS):
        page.press(f"#tab-{name}")
        for first, shown in CHOSEN.get(name, ()):
            wait_for(lambda css=first: page.all(css), first)
            page.press(first)
            wait_for(lambda css=shown: page.all(css), shown)
        if name == "doctor":
            page.wait_for_text("#doctor-state", "o")  # any verdict has this letter
        page.ask(f"document.getElementById('{name}').lastElementChild.scrollIntoView(false)")
        assert 0 < page.middle("#stop")[1] < NARROW[1] / 4, name
        assert violations(page) == [], name
        assert page.ask(WIDEST) <= VIEWS[view][0], name
    page.resize()
