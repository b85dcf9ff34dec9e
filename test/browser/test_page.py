"""The page itself: small, from this host alone, for keyboards and phones, honest about a loss."""

import re
import signal
from urllib.parse import urlsplit

from tutorial_testing.cockpit.chromium import Chromium
from tutorial_testing.cockpit.hands import Keys
from tutorial_testing.waiting import wait_for

FIRST_LOAD = 200_000  # bytes


def tabs(page):
    """The names of the page's tabs, in their order."""
    return [tab.accessible_name for tab in page.all("[role=tab]")]


def test_it_is_small_and_asks_no_other_host_and_reports_no_error(world):
    with Chromium(notes_requests=True) as browser:
        browser.open(world.address)
        loaded = """performance.getEntries().filter((e) => 'transferSize' in e)
            .reduce((sum, e) => sum + e.transferSize, 0)"""
        assert 10_000 < browser.ask(loaded) < FIRST_LOAD
        for name in tabs(browser):
            browser.tab(name)
            assert browser.by_role("tab", name).get_attribute("aria-selected") == "true"
        asked = [urlsplit(url) for url in browser.requests()]
        asked = [url.netloc for url in asked if url.scheme in ("http", "https", "ws", "wss")]
        assert len(asked) > 10
        assert set(asked) == {urlsplit(world.address).netloc}
        assert browser.errors() == []


def press(page, code):
    page.key("rawKeyDown", code)
    page.key("keyUp", code)


def test_the_keyboard_alone_reaches_everything(page):
    page.driver.execute_script("document.activeElement.blur()")
    reached = set()
    for _ in range(40):
        press(page, "Tab")
        reached.add(page.ask("document.activeElement.id"))
    wanted = page.ask(
        "[...document.querySelectorAll('#robot button:enabled, #robot select:enabled')]"
        ".filter((e) => e.checkVisibility()).map((e) => e.id)"
    )
    assert {"take"} <= set(wanted) <= reached
    # Tabs are one stop; arrows go from one to the next.
    page.by_role("tab", "Robot").click()
    first, *others = tabs(page)
    for name in (*others, first):
        press(page, "ArrowRight")
        assert page.by_role("tab", name).get_attribute("aria-selected") == "true"


def test_a_server_that_hangs_for_a_while_leaves_the_seat_to_its_page(world, page):
    page.click("Drive from this page")
    page.wait_for_text("#seat", "You drive")
    number = page.text("#me")
    world.cockpit.signal(signal.SIGSTOP)
    try:
        page.wait_for_text("#connection", "lost")
        assert not page.by_role("button", "Drive from this page").is_enabled()
    finally:
        world.cockpit.signal(signal.SIGCONT)
    page.wait_for_text("#connection", "Connected")
    page.wait_for_text("#seat", "You drive")
    assert page.text("#me") == number


# Of the tab that is shown: whether the line above says that all is old, and whether it looks old.
LOOKS_OLD = """(() => {
  const heading = document.querySelector("main section:not([hidden]) h2");
  return [document.getElementById("seat").innerText,
          getComputedStyle(document.querySelector("main")).filter,
          heading ? getComputedStyle(heading, "::after").content : "(old)"];
})()"""


def test_after_a_loss_every_tab_says_that_it_is_old_and_no_seat_is_promised(world, shared_browser):
    browser = shared_browser
    browser.open(world.address)
    browser.tab("Bag")
    browser.wait_for_text("#bag-about", "joy.bag")
    browser.tab("Doctor")
    Keys(browser).drive(world)
    browser.driver.execute_script("dispatchEvent(new Event('blur'))")
    browser.wait_for_text("#notice", "then hold LB again")
    browser.signal(signal.SIGSTOP)  # a laptop sleeps, and its seat is given up
    world.cockpit.kill()
    world.start_cockpit()
    browser.signal(signal.SIGCONT)
    browser.wait_for_text("#notice", "This page no longer drives: its connection was lost.")
    browser.wait_for_text("#seat", "Nobody drives.")
    wait_for(lambda: browser.one("#doctor-run").is_enabled(), "verdict of the doctor")
    verdict = browser.text("#doctor-state")
    world.cockpit.signal(signal.SIGINT)
    world.cockpit.wait()
    browser.wait_for_text("#connection", "lost")
    for name in tabs(browser):
        browser.tab(name)
        words, look, heading = browser.ask(LOOKS_OLD)
        assert re.fullmatch(r"Not connected: .* is from [\d:]{8}\. The driver is unknown\.", words)
        assert (look, "(old)" in heading) == ("grayscale(1)", True), name
    assert not any(one.isdigit() for one in browser.text("#speed"))
    assert browser.text("#doctor-state") == f"Not connected. Before: {verdict}"
    assert browser.text("#bag-state") == "Not connected."
    buttons = ("take", "stop", "reset", "doctor-run", "bag-open", "bag-play", "bag-pause")
    assert [one for one in buttons if browser.one(f"#{one}").is_enabled()] == []
    world.start_cockpit()
    browser.wait_for_text("#seat", "Nobody drives.")
    assert not browser.ask("document.body.classList.contains('old')")
    browser.errors()  # those of the loss
