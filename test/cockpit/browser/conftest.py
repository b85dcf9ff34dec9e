"""What browser tests share: robots with a cockpit, browsers, the table of times."""

import re
import shutil
from collections import defaultdict
from pathlib import Path
from statistics import median_high

import pytest
from selenium import webdriver
from selenium.webdriver.webkitgtk.options import Options

from tutorial_testing.cockpit.chromium import Chromium
from tutorial_testing.cockpit.engines import Firefox, WebDriver
from tutorial_testing.cockpit.world import World
from tutorial_testing.screen import virtual_screen


def pytest_addoption(parser):
    trials = "how often the operator is lost in each way (1)"
    parser.addoption("--trials", type=int, default=1, metavar="N", help=trials)


def pytest_terminal_summary(terminalreporter):
    """Print how long the robot drove on after the operator was lost: (way, time [s]) of tests."""
    times = defaultdict(list)
    for report in terminalreporter.getreports("passed") + terminalreporter.getreports("failed"):
        for way, took_s in report.user_properties:
            times[way].append(took_s)
    if times:
        terminalreporter.section("operator lost to wheels at rest")
        terminalreporter.line("| way | times | median [s] | worst [s] |")
        terminalreporter.line("|---|---|---|---|")
    for way, took_s in times.items():
        middle_s = median_high(took_s)
        terminalreporter.line(f"| {way} | {len(took_s)} | {middle_s:.2f} | {max(took_s):.2f} |")


@pytest.fixture(scope="session")
def world():
    """The simulated robot, joy2twist and a cockpit, for tests that change none of them."""
    with World() as world:
        yield world


@pytest.fixture(scope="session")
def shared_browser():
    with Chromium() as browser:
        yield browser


@pytest.fixture
def firefox():
    if not shutil.which("firefox-esr"):
        pytest.skip("no Firefox here: apt install firefox-esr")
    with Firefox() as browser:
        yield browser


@pytest.fixture
def webkit(monkeypatch):
    program = shutil.which("WebKitWebDriver")
    browsers = sorted(Path("/usr/lib").glob("*/webkit2gtk-4.*/MiniBrowser"))
    if not program or not browsers:
        pytest.skip("no WebKit here: apt install webkit2gtk-driver")
    options = Options()
    options.binary_location = str(browsers[-1])
    options.add_argument("--automation")
    with virtual_screen(1280, 800) as screen:
        monkeypatch.setenv("DISPLAY", screen)
        driver = webdriver.WebKitGTK(executable_path=program, options=options)
        yield WebDriver(driver)
        driver.quit()


@pytest.fixture
def page(world, shared_browser):
    """The shared browser with the page opened again; the test fails if its console has errors."""
    shared_browser.errors()  # This drops what an earlier page reported late.
    shared_browser.open(world.address)
    yield shared_browser
    errors = shared_browser.errors()
    shared_browser.driver.get("about:blank")  # so that it stops driving
    assert errors == []


@pytest.fixture
def ros(world):
    """A function that runs a command of ROS beside the robot, and returns its output."""

    def ask(*command):
        with world.run(*command) as program:
            program.wait()
            return re.sub(r"\x1b\[[0-9;]*m", "", program.output)

    return ask
