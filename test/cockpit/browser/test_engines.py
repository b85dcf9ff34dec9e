"""The core in the other engines: Firefox, and WebKit, the engine of an iPhone."""

import pytest
from selenium.webdriver.common.keys import Keys as Key

from tutorial_testing.claims import claim
from tutorial_testing.cockpit.hands import Hands


class EngineHands(Hands):
    def hold(self):
        self.browser.keys("keyDown", Key.SHIFT, Key.ARROW_UP)

    def release(self):
        self.browser.keys("keyUp", Key.ARROW_UP, Key.SHIFT)


@claim("Firefox and WebKit drive, and open every tab")
@pytest.mark.parametrize("engine", ["firefox", "webkit"])
def test_keys_drive_the_robot_and_every_tab_opens(world, engine, request):
    browser = request.getfixturevalue(engine)
    browser.open(world.address)
    panels = "[...document.querySelectorAll('[role=tabpanel]')]"
    for name in browser.ask(f"{panels}.map((panel) => panel.id).join(' ')").split():
        browser.press(f"#tab-{name}")
        assert browser.ask(f"document.getElementById('{name}').clientHeight > 0")
    browser.press("#tab-robot")
    browser.press("#take")
    browser.wait_for_text("#session", "You drive")
    hands = EngineHands(browser)
    hands.drive(world)
    hands.release()
    world.wait_for_rest()
    browser.press("#stop")
    browser.wait_for_text("#session", "Nobody drives")
