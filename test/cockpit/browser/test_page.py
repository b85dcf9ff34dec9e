"""The page itself: small, loaded from this host alone, usable by keyboard, honest about a loss."""

import re
import signal
from urllib.parse import urlsplit

from tutorial_testing.claims import claim
from tutorial_testing.waiting import wait_for

FIRST_LOAD = 90_000  # bytes, compressed; browsers keep them
LOADED = "performance.getEntries().filter((e) => 'encodedBodySize' in e)"


def tabs(page):
    return page.ask("[...document.querySelectorAll('[role=tabpanel]')].map((e) => e.id)")


def press(page, code):
    page.key("rawKeyDown", code)
    page.key("keyUp", code)


@claim("The page is small, asks no other host, and is for the keyboard")
def test_the_keyboard_reaches_everything_of_a_small_page_that_asks_no_other_host(world, page):
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
    loaded = page.ask(f"{LOADED}.reduce((sum, e) => sum + e.encodedBodySize, 0)")
    assert 10_000 < loaded < FIRST_LOAD
    # The row of tabs is one stop of the key Tab; arrows go from tab to tab.
    page.driver.execute_script("document.getElementById('tab-robot').focus()")
    first, *others = tabs(page)
    for name in (*others, first):
        press(page, "ArrowRight")
        assert page.one(f"#tab-{name}").get_attribute("aria-selected") == "true"
    asked = page.ask(f"{LOADED}.map((e) => new URL(e.name).host)")
    assert len(asked) > 10 and set(asked) == {urlsplit(world.address).netloc}


# Whether the line above the shown tab says that all is old, and whether the tab looks old.
LOOKS_OLD = """(() => {
  const heading = document.querySelector("main section:not([hidden]) h2");
  return [document.getElementById("session").innerText,
          getComputedStyle(document.querySelector("main")).filter,
          heading ? getComputedStyle(heading, "::after").content : "(old)"];
})()"""


@claim(
    "A server that hangs for a while leaves the session to its page; after a loss every tab says "
    "that it is old; the doctor shows its lines"
)
def test_a_server_that_hangs_leaves_the_session_and_after_a_loss_every_tab_is_old(world, page):
    page.click("Drive from this page")
    page.wait_for_text("#session", "You drive")
    number = page.text("#me")
    world.cockpit.signal(signal.SIGSTOP)
    try:
        page.wait_for_text("#connection", "lost")
        assert not page.one("#take").is_enabled()
    finally:
        world.cockpit.signal(signal.SIGCONT)
    page.wait_for_text("#connection", "Connected")
    page.wait_for_text("#session", "You drive")
    assert page.text("#me") == number
    page.tab("Bag")
    page.wait_for_text("#bag-about", "joy.bag")
    page.tab("Doctor")
    wait_for(lambda: page.one("#doctor-run").is_enabled(), "verdict of the doctor")
    assert "joystick" in page.text("#doctor-lines")
    verdict = page.text("#doctor-state")
    world.cockpit.signal(signal.SIGINT)
    world.cockpit.wait()
    page.wait_for_text("#connection", "lost")
    for name in tabs(page):
        page.press(f"#tab-{name}")
        words, look, heading = page.ask(LOOKS_OLD)
        assert re.fullmatch(r"Not connected: .* is from [\d:]{8}\. The driver is unknown\.", words)
        assert (look, "(old)" in heading) == ("grayscale(1)", True), name
    assert not any(map(str.isdigit, page.text("#speed")))
    assert page.text("#doctor-state") == f"Not connected. Before: {verdict}"
    assert page.text("#bag-state") == "Not connected."
    buttons = ("take", "stop", "reset", "doctor-run", "bag-open", "bag-play", "bag-pause")
    assert [name for name in buttons if page.one(f"#{name}").is_enabled()] == []
    world.start_cockpit()
    page.wait_for_text("#session", "Nobody drives.")
    assert not page.ask("document.body.classList.contains('old')")
    page.errors()  # dropped: the loss caused them
