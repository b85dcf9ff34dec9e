"""What the tests in browsers share: robots with a cockpit, browsers, the table of times."""

import re
from collections import defaultdict
from pathlib import Path

import pytest

from tutorial_testing.cockpit.chromium import Chromium
from tutorial_testing.cockpit.world import World


def pytest_addoption(parser):
    trials = "how often the operator is lost in each way (1)"
    parser.addoption("--trials", type=int, default=1, metavar="N", help=trials)
    parser.addoption("--picture", action="store_true", help="make common/cockpit/doc/cockpit.webp")


def pytest_configure(config):
    """Way to lose the operator -> times until the robot was at rest [s]."""
    config.stopping_times = defaultdict(list)


def pytest_terminal_summary(terminalreporter, config):
    """Print how long the robot went on after the operator was lost."""
    stopping_times = config.stopping_times
    if stopping_times:
        terminalreporter.section("operator lost to wheels at rest")
        terminalreporter.line("| way | times | median [s] | worst [s] |")
        terminalreporter.line("|---|---|---|---|")
    for way, times in stopping_times.items():
        middle = sorted(times)[len(times) // 2]
        terminalreporter.line(f"| {way} | {len(times)} | {middle:.2f} | {max(times):.2f} |")


@pytest.fixture(scope="session")
def world():
    """The simulated robot, joy2twist and a cockpit, for tests that leave them as they were."""
    with World() as world:
        yield world


@pytest.fixture
def browser():
    with Chromium() as browser:
        yield browser


@pytest.fixture(scope="session")
def shared_browser():
    with Chromium() as browser:
        yield browser


@pytest.fixture
def page(world, shared_browser):
    """The shared browser with the page opened anew; the test fails if its console has errors."""
    shared_browser.open(world.address)
    yield shared_browser
    errors = shared_browser.errors()
    shared_browser.driver.get("about:blank")  # it drives no more
    assert errors == []


@pytest.fixture
def ros(world):
    """Run a command of ROS beside the robot; returns what it prints."""

    def ask(*command):
        with world.run(*command) as program:
            program.wait()
            return re.sub(r"\x1b\[[0-9;]*m", "", program.output)

    return ask


@pytest.fixture
def recording():
    return str(Path(__file__).resolve().parents[2] / "common/gamepad/bag/joy.bag")
