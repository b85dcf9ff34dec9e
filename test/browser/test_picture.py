"""The README's picture of the page, `--picture`: the robot on its figure of eight."""

from pathlib import Path

import pytest

from tutorial_testing.cockpit.chromium import LONG_S, Chromium
from tutorial_testing.cockpit.world import World
from tutorial_testing.waiting import wait_for

PICTURE = Path(__file__).resolve().parents[2] / "common/cockpit/doc/cockpit.png"
LARGEST = 150_000  # bytes


def test_picture(request, tmp_path):
    if not request.config.getoption("--picture"):
        pytest.skip("the README's picture is made only with --picture")
    launch = ("joy2twist", "launch_bag.launch", "cockpit:=false")
    with World(*launch) as world, Chromium(1280, 800) as browser:
        browser.open(world.address)
        # The recording: the figure, a turn on the spot, a way back and forth, a rest; and again.
        wait_for(lambda: world.now.v < 0, "way back", LONG_S)
        world.wait_for_rest()
        browser.click("Clear trail")
        wait_for(lambda: world.now.v > 0, "figure of eight", LONG_S)
        wait_for(lambda: world.now.v == 0, "turn on the spot", LONG_S)
        browser.click("Show all")
        browser.save_picture(tmp_path / "cockpit.png")
    drawn = (tmp_path / "cockpit.png").read_bytes()
    assert len(drawn) < LARGEST
    PICTURE.parent.mkdir(exist_ok=True)
    PICTURE.write_bytes(drawn)
