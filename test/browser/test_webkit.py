"""The core in WebKit, the engine of an iPhone: WebKitGTK's MiniBrowser on a virtual screen."""

import shutil
from pathlib import Path

import pytest
from selenium import webdriver
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys as Key
from selenium.webdriver.webkitgtk.options import Options

from tutorial_testing.cockpit.hands import LONG_S, Hands
from tutorial_testing.screen import virtual_screen
from tutorial_testing.waiting import wait_for

TABS = ("Robot", "Graph", "Bag", "Plot", "Log", "Doctor")


class WebKitHands(Hands):
    """Shift and the arrow up, as WebDriver presses them."""

    def hold(self):
        ActionChains(self.browser.driver).key_down(Key.SHIFT).key_down(Key.ARROW_UP).perform()

    def release(self):
        ActionChains(self.browser.driver).key_up(Key.ARROW_UP).key_up(Key.SHIFT).perform()


class WebKit:
    """What Hands need of a browser."""

    def __init__(self, driver):
        self.driver = driver

    def ask(self, expression):
        return self.driver.execute_script(f"return {expression}")

    def text(self, css):
        script = "return document.querySelector(arguments[0]).textContent"
        return self.driver.execute_script(script, css)

    def wait_for_text(self, css, text):
        wait_for(lambda: text in self.text(css), text, LONG_S)


@pytest.fixture
def webkit(monkeypatch):
    """A MiniBrowser on a virtual screen."""
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
        yield WebKit(driver)
        driver.quit()


def test_keys_drive_the_robot_and_every_tab_opens(world, webkit):
    driver = webkit.driver
    driver.get(world.address)
    webkit.wait_for_text("#connection", "Connected")
    for name in TABS:
        tab = driver.find_element(By.ID, f"tab-{name.lower()}")
        tab.click()
        assert tab.get_attribute("aria-selected") == "true"
        assert driver.find_element(By.ID, name.lower()).is_displayed()
    driver.find_element(By.ID, "tab-robot").click()
    driver.find_element(By.ID, "take").click()
    webkit.wait_for_text("#seat", "You drive")
    hands = WebKitHands(webkit)
    hands.drive(world)
    hands.release()
    world.wait_for_rest()
    driver.find_element(By.ID, "leave").click()
    webkit.wait_for_text("#seat", "Nobody drives")
