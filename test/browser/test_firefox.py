"""The core in Firefox."""

import shutil

import pytest

from tutorial_testing.cockpit.firefox import Firefox
from tutorial_testing.cockpit.hands import Hands

TABS = ("robot", "graph", "bag", "plot", "log", "doctor")
SHIFT, ARROW_UP = "\ue008", "\ue013"  # https://w3c.github.io/webdriver/#keyboard-actions


class FirefoxHands(Hands):
    """Shift and the arrow up, as WebDriver presses them."""

    def hold(self):
        self.browser.keys("keyDown", SHIFT, ARROW_UP)

    def release(self):
        self.browser.keys("keyUp", ARROW_UP, SHIFT)


def test_keys_drive_the_robot_and_every_tab_opens(world):
    if not shutil.which("firefox-esr"):
        pytest.skip("no Firefox here: apt install firefox-esr")
    with Firefox() as browser:
        browser.open(world.address)
        for name in TABS:
            browser.click(f"#tab-{name}")
            assert browser.ask(f"document.getElementById('{name}').checkVisibility()")
        browser.click("#tab-robot")
        browser.click("#take")
        browser.wait_for_text("#seat", "You drive")
        hands = FirefoxHands(browser)
        hands.drive(world)
        hands.release()
        world.wait_for_rest()
        browser.click("#leave")
        browser.wait_for_text("#seat", "Nobody drives")
