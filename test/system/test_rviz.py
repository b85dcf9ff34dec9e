"""RViz on a virtual screen while launch_bag.launch runs: it shows the robot, where /odom says.

The picture of the README, taken when most of the figure is drawn:
    TUTORIAL_PICTURE=$PWD/fake_turtlebot_sim/doc/rviz.png ./tutorial test system -k rviz_opens
"""

import contextlib
import math
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
# Straight from above, at 100 pixels a metre; a ground of a colour that nothing else has.
SCALE, GROUND = 100, (20, 40, 250)
LATENESS = 75  # messages of odometry, 1.5 s, in which RViz has drawn the robot
ROBOT_RADIUS_M = 0.178


@pytest.fixture
def show(screen, tutorial, master_uri):
    """A function that starts launch_bag.launch with RViz on the virtual screen."""
    assert master_uri  # a master of our own
    with contextlib.ExitStack() as stack:

        def start(config):
            environment = {"DISPLAY": screen, "LIBGL_ALWAYS_SOFTWARE": "1"}
            program = Program(tutorial, "demo", f"rviz_config:={config}", **environment)
            for end in (program.__exit__, program.wait, program.interrupt):  # the last one first
                stack.callback(end)
            return program

        yield start


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


def robot_from_above(folder):
    """Return a copy of the configuration: the robot only, from above, drawn less often."""
    config = yaml.safe_load(CONFIG.read_text())
    manager = config["Visualization Manager"]
    manager["Displays"] = [d for d in manager["Displays"] if d["Class"] == "rviz/RobotModel"]
    background = "; ".join(map(str, GROUND))
    manager["Global Options"].update({"Frame Rate": 5, "Background Color": background})
    manager["Views"]["Current"] = {
        "Class": "rviz/TopDownOrtho", "Name": "Above", "Target Frame": "<Fixed Frame>",
        "Scale": SCALE, "X": 0, "Y": 0, "Angle": 0,
    }  # fmt: skip
    copy = folder / CONFIG.name
    copy.write_text(yaml.safe_dump(config))
    return copy


def robot_on(pixels):
    """(x, y) [m] of the middle of what is not ground; None while there is no robot."""
    ground = near(pixels, GROUND, 12)
    if ground.mean() < 0.1:
        return None
    rows, columns = np.flatnonzero(ground.any(axis=1)), np.flatnonzero(ground.any(axis=0))
    view = ~ground[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
    if not view.any():
        return None
    robot_rows, robot_columns = np.nonzero(view)
    # The middle of the outline: a shadowed or a bright part must not pull it aside.
    row = (robot_rows.min() + robot_rows.max() + 1) / 2
    column = (robot_columns.min() + robot_columns.max() + 1) / 2
    return (column - view.shape[1] / 2) / SCALE, (view.shape[0] / 2 - row) / SCALE


def test_rviz_shows_the_robot_where_odom_says(show, screen, tutorial, tmp_path):
    show(robot_from_above(tmp_path))
    wait_for(lambda: robot_on(picture(screen)), "robot on the screen", START_S)
    with Program(tutorial, "run", "rostopic", "echo", "-p", "/odom/pose/pose/position") as echo:
        wait_for(lambda: len(places(echo.output)) > LATENESS, "odometry", START_S)
        for _ in range(3):  # the tour goes on meanwhile: three different places
            before = len(places(echo.output))
            seen = robot_on(picture(screen))
            after = len(places(echo.output))
            enough = before + LATENESS
            wait_for(lambda n=enough: len(places(echo.output)) > n, "more odometry", START_S)
            # RViz draws late, the more so on a busy machine: the robot has just been there.
            passed = places(echo.output)[before - LATENESS : after + LATENESS]
            nearest = min(math.dist(place, seen) for place in passed)
            print(f"seen {seen}, {nearest:.3f} m from where it has been")
            assert nearest < ROBOT_RADIUS_M


def places(printed):
    """[(x, y)] [m] of what rostopic echo -p has printed: time, x, y, z in each line."""
    lines = [line.split(",") for line in printed.splitlines() if re.match(r"\d+,", line)]
    return [(float(line[1]), float(line[2])) for line in lines if len(line) == 4]
