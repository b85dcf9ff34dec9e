"""A world on the page: walls, what the laser sees, and a bumper that is pressed."""

import pytest

from tutorial_testing.cockpit.chromium import Chromium
from tutorial_testing.cockpit.world import HERE, World
from tutorial_testing.waiting import wait_for

# How many pixels of the floor have about the colour of a variable of the style sheet.
COUNT = """(() => {
  const canvas = document.getElementById("floor");
  const hex = getComputedStyle(canvas).getPropertyValue(%r).trim().slice(1);
  const wanted = [0, 2, 4].map((i) => parseInt(hex.slice(i, i + 2), 16));
  const copy = new OffscreenCanvas(canvas.width, canvas.height);
  const pen = copy.getContext("2d", { willReadFrequently: true });
  pen.drawImage(canvas, 0, 0);
  const { data } = pen.getImageData(0, 0, canvas.width, canvas.height);
  let count = 0;
  for (let i = 0; i < data.length; i += 4) {
    if (wanted.every((value, k) => Math.abs(data[i + k] - value) < 12)) count += 1;
  }
  return count;
})()"""


@pytest.mark.parametrize("size", [(1280, 800), (360, 640)])
def test_walls_scan_and_bumpers_are_drawn(size):
    with World(str(HERE / "world.launch"), "world:=room") as world, Chromium(*size) as browser:

        def count(colour):
            return browser.ask(COUNT % colour)

        browser.open(world.address)
        wait_for(lambda: count("--wall") > 500, "walls on the floor")
        wait_for(lambda: count("--scan") > 50, "points of the scan")
        assert count("--bumper") == 0
        ahead = "{linear: {x: 0.7}}"
        with world.run("rostopic", "pub", "-r", "10", "/cmd_vel", "geometry_msgs/Twist", ahead):
            wait_for(lambda: count("--bumper") > 10, "a pressed bumper")
            # Where the wall is that it pushes: the robot is drawn at its side.
            assert world.now.x == pytest.approx(4.0 - 0.178)
        assert browser.errors() == []
