"""RViz on a virtual screen draws the robot's path while launch_bag.launch runs."""

import re

import numpy as np
import pytest
from PIL import ImageGrab

from tutorial_testing.claims import claim
from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for

TRAIL = (255, 85, 0)  # colour of the odometry's arrows in sim.rviz
TRAIL_PIXELS = 200


@claim("RViz opens by itself and draws the robot's way")
@pytest.mark.usefixtures("master_uri")
def test_rviz_opens_by_itself_and_shows_the_trail(tutorial, screen):
    environment = {"DISPLAY": screen, "LIBGL_ALWAYS_SOFTWARE": "1"}
    with Program(tutorial, "demo", **environment) as demo:

        def trail_is_drawn():
            assert not demo.ended, demo.output
            pixels = np.asarray(ImageGrab.grab(xdisplay=screen).convert("RGB")).astype(int)
            return np.count_nonzero((abs(pixels - TRAIL) < 60).all(axis=2)) > TRAIL_PIXELS

        wait_for(trail_is_drawn, "odometry trail on the screen", seen=lambda: demo.output)
        assert not re.search(r"\[ERROR\]|\[FATAL\]|Traceback", demo.output)
        demo.interrupt()
        demo.wait()
