"""RViz on a virtual screen while launch_bag.launch runs: it shows the trail; a class has bodies.

The picture of the README, taken when most of the figure is drawn:
    TUTORIAL_PICTURE=$PWD/fake_turtlebot_sim/doc/rviz.png ./tutorial test system -k rviz_opens
"""

import os
import re
from pathlib import Path

import numpy as np
import pytest
import yaml
from PIL import ImageGrab

from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for

CONFIG = Path(__file__).resolve().parents[2] / "fake_turtlebot_sim" / "rviz" / "sim.rviz"
START_S = 120.0  # RViz without a graphics card, on a busy machine
TRAIL_PIXELS = 1200 if "TUTORIAL_PICTURE" in os.environ else 200
TRAIL = (255, 85, 0)  # colour of the odometry's arrows in sim.rviz
CLASS = 30  # robots
DARK, GREY = 90, 25  # a body: no channel is brighter, and all are alike within
THICK = 11  # [pixel]: a body is wider and higher than this, the strokes of letters are not


@pytest.fixture
def show(screen, tutorial, master_uri):
    """A function that starts launch_bag.launch with RViz on the virtual screen."""
    assert master_uri  # a master of our own
    programs = []

    def start(config):
        environment = {"DISPLAY": screen, "LIBGL_ALWAYS_SOFTWARE": "1"}
        programs.append(Program(tutorial, "demo", f"rviz_config:={config}", **environment))
        return programs[-1]

    yield start
    for program in programs:
        with program:
            program.interrupt()
            program.wait()


def picture(screen):
    """What is on a screen: height x width x 3, uint8."""
    return np.asarray(ImageGrab.grab(xdisplay=screen).convert("RGB"))


def near(pixels, colour, tolerance):
    """Which pixels have about a colour."""
    return (np.abs(pixels.astype(int) - colour) <= tolerance).all(axis=2)


def test_rviz_opens_by_itself_and_shows_the_trail(show, screen, tmp_path):
    """The configuration as it is: the picture of the README."""
    launch = show(CONFIG)

    def trail():
        assert not launch.ended, launch.output
        return np.count_nonzero(near(picture(screen), TRAIL, 60)) > TRAIL_PIXELS

    wait_for(trail, "odometry trail on the screen", START_S)
    path = os.environ.get("TUTORIAL_PICTURE", tmp_path / "rviz.png")
    ImageGrab.grab(xdisplay=screen).save(path)
    assert not re.search(r"\[ERROR\]|\[FATAL\]|Traceback", launch.output)


def drawn_slowly(path, folder):
    """Return a copy of a configuration, drawn less often, as there is no graphics card."""
    config = yaml.safe_load(path.read_text())
    config["Visualization Manager"]["Global Options"]["Frame Rate"] = 5
    copy = folder / path.name
    copy.write_text(yaml.safe_dump(config))
    return copy


def solid(mask):
    """The pixels that have a square of THICK pixels of the mask around them."""
    for axis in (0, 1):
        rows = [np.roll(mask, shift, axis) for shift in range(-(THICK // 2), THICK // 2 + 1)]
        mask = np.logical_and.reduce(rows)
    return mask


def patches(mask):
    """How many connected parts a mask has."""
    left = set(zip(*map(list, np.nonzero(mask))))
    count = 0
    while left:
        count += 1
        edge = [left.pop()]
        while edge:
            row, column = edge.pop()
            around = {(row + i, column + j) for i in (-1, 0, 1) for j in (-1, 0, 1)} & left
            left -= around
            edge += around
    return count


def test_rviz_shows_a_body_for_each_robot_of_a_class(screen, tutorial, master_uri, tmp_path):
    """In the first view, without a hand on the mouse."""
    assert master_uri  # a master of our own
    config = drawn_slowly(CONFIG.with_name("classroom.rviz"), tmp_path)
    launch = ("run", "roslaunch", "fake_turtlebot_sim", "classroom.launch", "rviz:=true")
    environment = {"DISPLAY": screen, "LIBGL_ALWAYS_SOFTWARE": "1"}
    with Program(
        tutorial, *launch, f"robots:={CLASS}", f"rviz_config:={config}", **environment
    ) as program:

        def bodies():
            assert not program.ended, program.output
            pixels = picture(screen).astype(int)
            dark = (pixels.max(axis=2) < DARK) & (np.ptp(pixels, axis=2) < GREY)
            return patches(solid(dark)) == CLASS

        wait_for(bodies, f"{CLASS} robots on the screen", START_S)
        assert not re.search(r"\[ERROR\]|\[FATAL\]|Traceback", program.output)
        program.interrupt()
        program.wait()
