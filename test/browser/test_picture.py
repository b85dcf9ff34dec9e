"""Make the README's picture of the page, `--picture`: the robot on its figure of eight."""

from pathlib import Path

import pytest

from tutorial_testing.cockpit.world import World
from tutorial_testing.waiting import wait_for

PICTURE = Path(__file__).resolve().parents[2] / "common/cockpit/doc/cockpit.webp"
LARGEST = 50_000  # bytes


def test_the_picture_of_the_readme_is_made_on_demand(request, browser, tmp_path):
    if not request.config.getoption("--picture"):
        pytest.skip("the README's picture is made only with --picture")
    with World("fake_turtlebot_sim", "fake_turtlebot.launch") as world:
        world.run("rosrun", "joy2twist", "joy2twist.py")  # at the scale of launch_bag.launch
        browser.open(world.address)
        browser.tab("Graph")
        wait_for(lambda: browser.all('[data-item="topic /cmd_vel"]'), "joy2twist")
        browser.tab("Bag")
        browser.wait_for_text("#bag-about", "joy.bag")
        browser.click("Publish")
        browser.tab("Robot")
        # The recording: a figure of eight, then a turn on the spot.
        wait_for(lambda: world.now.v > 0, "figure of eight")
        wait_for(lambda: world.now.v == 0 and world.now.w, "turn on the spot")
        browser.click("Show all")
        browser.save_picture(tmp_path / "cockpit.webp")
    picture = (tmp_path / "cockpit.webp").read_bytes()
    assert len(picture) < LARGEST
    PICTURE.write_bytes(picture)
