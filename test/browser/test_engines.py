"""The core in the other engines: Firefox, and WebKit, the engine of an iPhone."""

import shutil
from pathlib import Path

import pytest
from selenium import webdriver
from selenium.webdriver.common.keys import Keys as Key
from selenium.webdriver.webkitgtk.options import Options

from tutorial_testing.cockpit.engines import Firefox, WebDriver
from tutorial_testing.cockpit.hands import Hands
from tutorial_testing.screen import virtual_screen


class EngineHands(Hands):
    """Shift and the arrow up, as WebDriver presses them."""

    def hold(self):
        self.browser.keys("keyDown", Key.SHIFT, Key.ARROW_UP)

    def release(self):
        self.browser.keys("keyUp", Key.ARROW_UP, Key.SHIFT)


@pytest.fixture
def firefox():
    if not shutil.which("firefox-esr"):
        pytest.skip("no Firefox here: apt install firefox-esr")
    with Firefox() as browser:
        yield browser


@pytest.fixture
def webkit(monkeypatch):
    program = shutil.which("WebKitWebDriver")
    found = sorted(Path("/usr/lib").glob("*/webkit2gtk-4.*/MiniBrowser"))
    if not program or not found:
        pytest.skip("no WebKit here: apt install webkit2gtk-driver")
    options = Options()
    options.binary_location = str(found[-1])
    options.add_argument("--automation")
    with virtual_screen(1280, 800) as screen:
        monkeypatch.setenv("DISPLAY", screen)
        driver = webdriver.WebKitGTK(executable_path=program, options=options)
        yield WebDriver(driver)
        driver.quit()


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
    browser.wait_for_text("#seat", "You drive")
    hands = EngineHands(browser)
    hands.drive(world)
    hands.release()
    world.wait_for_rest()
    browser.press("#stop")
    browser.wait_for_text("#seat", "Nobody drives")
