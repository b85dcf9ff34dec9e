"""The tab Diagnostics, by keyboard alone: the tree, its levels and values as they are drawn."""

from selenium.webdriver.common.keys import Keys

from tutorial_testing.claims import claim
from tutorial_testing.waiting import wait_for

SUMMARY = "[...document.querySelectorAll('#diagnostics-tree summary')]"
# The visible lines from the top, and the one that has the focus.
LINES = f"{SUMMARY}.filter((line) => line.checkVisibility()).map((line) => line.innerText.trim())"
FOCUSED = "document.activeElement.matches('summary') ? document.activeElement.innerText.trim() : ''"
LEVEL = f"{SUMMARY}.find((line) => line.innerText.includes('Wheels')).firstChild"
COLOUR = f"getComputedStyle({LEVEL}).color"
RED = "rgb(179, 38, 30)"  # --stop in light
WHEELS = "{level: %d, name: 'base: Wheels', message: %s, values: [{key: Left, value: '7'}]}"


def press(page, code):
    page.key("rawKeyDown", code)
    page.key("keyUp", code)


def report(world, level, message):
    array = f"{{status: [{WHEELS % (level, message)}]}}"
    topic = "/diagnostics", "diagnostic_msgs/DiagnosticArray"
    return world.run("rostopic", "pub", "-r", "5", *topic, array)


def is_above_joy2twist(page, text):
    """Return the lines if that with this text is above joy2twist's, whose level is constant."""
    lines = page.ask(LINES)
    first, other = (
        next((i for i, line in enumerate(lines) if words in line), len(lines))
        for words in (text, "myjoystick2twist")
    )
    return first < other and lines


@claim(
    "Tab Diagnostics: a tree with levels in words and colour and the newest change on top, also "
    "when it falls silent; the keyboard opens the values, and keeps its place"
)
def test_the_newest_change_is_on_top_and_the_keyboard_opens_its_values(world, page):
    page.send("Emulation.setEmulatedMedia", features=[])
    page.driver.execute_script("document.getElementById('tab-robot').focus()")
    while page.ask("document.activeElement.id") != "tab-diagnostics":
        press(page, "ArrowRight")
    with report(world, 0, "turning"):
        page.wait_for_text("#diagnostics-tree", "turning")
        while "turning" not in page.ask(FOCUSED):
            press(page, "Tab")
        assert "Left 7" not in page.one("#diagnostics-tree").text
        for kind in ("keyDown", "keyUp"):
            page.keys(kind, Keys.ENTER)
        wait_for(lambda: "Left 7" in page.one("#diagnostics-tree").text, "values")
    with report(world, 2, "blocked"):
        lines = wait_for(lambda: is_above_joy2twist(page, "ERROR base"), "error")
        [status] = [line for line in lines if "Wheels" in line]
        assert "blocked" in status and "since" in status
        assert page.ask(FOCUSED) == status, "the focus moved along"
        assert page.ask(COLOUR) == RED
        assert page.text("#diagnostics-counts").startswith("1 ERROR, 0 STALE, ")
    wait_for(lambda: is_above_joy2twist(page, "STALE base"), "silent status")
    assert page.ask(COLOUR) != RED
    assert page.text("#diagnostics-counts").startswith("0 ERROR, 1 STALE, ")
