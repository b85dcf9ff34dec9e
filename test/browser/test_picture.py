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
    with World("joy2twist", "launch_bag.launch") as world, Chromium(1100, 700) as browser:
        browser.open(world.address)
        # Once around: to the right of the start, to the left of it, and back.
        wait_for(lambda: max(moment.x for moment in world.odometry) > 0.5, "first loop", LONG_S)
        wait_for(lambda: min(moment.x for moment in world.odometry) < -0.5, "second loop", LONG_S)
        wait_for(lambda: abs(world.now.x) < 0.1, "robot that is back", LONG_S)
        browser.click("Show all")
        browser.save_picture(tmp_path / "cockpit.png")
    drawn = (tmp_path / "cockpit.png").read_bytes()
    assert len(drawn) < LARGEST
    PICTURE.parent.mkdir(exist_ok=True)
    PICTURE.write_bytes(drawn)
