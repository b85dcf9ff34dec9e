"""How the page looks at all sizes: one direction of scrolling, a class's table, and by axe."""

import pytest
from selenium.webdriver.common.keys import Keys

from tutorial_testing.cockpit.hands import Thumbs
from tutorial_testing.cockpit.pixels import dress
from tutorial_testing.cockpit.world import World
from tutorial_testing.waiting import wait_for

TABS = ("robot", "graph", "bag", "plot", "log", "doctor")
NARROW = (320, 256)  # 1280 x 1024 at 400 %: WCAG 2.2, 1.4.10
VIEWS = {"light": (1280, 800), "dark": (1280, 800), "360 px": (360, 640), "400 %": NARROW}
WCAG = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22a", "wcag22aa"]
ROBOTS = 30


def test_the_table_of_a_class_is_in_order_and_for_the_keyboard(shared_browser):
    launch = ("roslaunch", "cockpit", "classroom.launch", "cockpit:=false", f"robots:={ROBOTS}")
    rows = "[...document.querySelectorAll('#robots tr')]"
    page = shared_browser
    with World() as world, world.run(*launch):
        page.open(world.address)
        wait_for(lambda: len(page.all("#robots tr")) == 1 + ROBOTS, "thirty robots, and its own")
        names = page.ask(f"{rows}.map((one) => one.dataset.robot)")
        assert names == ["", *(f"robot_{n}" for n in range(1, ROBOTS + 1))]
        page.one("#robots tr:nth-child(11) button").send_keys(Keys.ENTER)
        assert page.ask("document.getElementById('look').value") == "robot_10"
        chosen = f"{rows}.find((one) => one.ariaCurrent === 'true').rowIndex"
        wait_for(lambda: page.ask(chosen) == 11, "chosen row")
        assert violations(page) == []


# The widest of what is shown, beside pictures and tables that may be scrolled.
WIDEST = """Math.max(document.documentElement.scrollWidth,
  ...[...document.querySelectorAll("body *")].filter((one) => one.getClientRects().length
    && !one.closest("#graph-picture svg, pre, .unseen, table"))
    .map((one) => one.getBoundingClientRect().right))"""


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


@pytest.mark.parametrize("view", VIEWS)
def test_axe_finds_nothing_and_no_tab_is_scrolled_in_two_directions(room, shared_browser, view):
    page = shared_browser
    dress(page, "dark" if view == "dark" else "light", VIEWS[view])
    page.open(room.address)
    assert len(page.all("h1")) == 1
    for name in TABS:
        page.press(f"#tab-{name}")
        if name == "graph":
            wait_for(lambda: page.all("#graph .topic"), "topics")
            page.press("#graph .topic")
            wait_for(lambda: page.all("#graph-details dd"), "details")
        elif name == "plot":
            wait_for(lambda: len(page.all("#plot-fields input")) > 10, "fields")
            page.press("#plot-fields input")
            wait_for(lambda: page.all("#plot-values span"), "legend")
        elif name == "doctor":
            page.wait_for_text("#doctor-state", "o")  # whatever it found
        assert violations(page) == [], name
        assert page.ask(WIDEST) <= VIEWS[view][0], name
    dress(page)


def test_at_400_percent_a_thumb_drives_and_stop_stays_in_sight(world, shared_browser):
    with shared_browser.tab_of(*NARROW, touch=True) as phone:
        phone.open(world.address)
        hands = Thumbs(phone)
        hands.prepare()
        phone.click("Drive from this page")
        phone.wait_for_text("#seat", "You drive")
        phone.driver.execute_script(
            "document.getElementById('stick').scrollIntoView({block: 'end'})"
        )
        x = world.now.x
        hands.drive(world, until=lambda: world.now.x > x + 0.1)
        hands.release()
        world.wait_for_rest()
        assert phone.ask("document.documentElement.scrollTop") > 100
        assert 0 < phone.middle("#stop")[1] < NARROW[1] / 4
