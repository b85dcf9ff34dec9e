"""The layout for the simulated TurtleBot, in an open Foxglove Studio from npm and in Chromium.

Lichtblick descends from Foxglove Studio, and npm has neither it nor a later Studio. 36 MB.
"""

import functools
import io
import shutil
import threading
import urllib.parse
from contextlib import ExitStack
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest
from PIL import Image

from tutorial_testing.claims import claim
from tutorial_testing.cockpit.chromium import Chromium
from tutorial_testing.npm import modules
from tutorial_testing.processes import REPOSITORY, Program, free_port
from tutorial_testing.robot import OBSERVER, Robot
from tutorial_testing.waiting import wait_for

pytestmark = pytest.mark.night
LAYOUT = REPOSITORY / "common/stand_ins/foxglove_bridge/config/turtlebot.json"
WEBGL = ("--enable-unsafe-swiftshader", "--use-angle=swiftshader")  # without a graphics card
# Colours of the layout, of an occupied cell, and of Studio's first curve.
SCAN, WALL, CURVE = (208, 0, 0), (0, 0, 0), (78, 152, 226)
NEAR, LEAST = 40, 50  # of a colour's part; pixels
PUBLISH = "[data-testid=publish-button]"
UP = "svg[viewBox='0 0 256 256'] [role=button]"  # the first one
MOST_SLOW = 0.15  # of the 0.2 m/s of the layout


class Quiet(SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The address of a server of the page."""
    folder = tmp_path_factory.mktemp("studio")
    (folder / "node_modules").symlink_to(modules("studio"))
    for path in (LAYOUT, Path(__file__).with_name("studio.html")):
        shutil.copy(path, folder)
    handler = functools.partial(Quiet, directory=str(folder))
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}/studio.html"
        server.shutdown()


class RoomRobot(Robot):
    """A TurtleBot in a room, and a bridge."""

    def __init__(self):
        super().__init__()
        self.environment = {"ROS_MASTER_URI": f"http://localhost:{free_port()}"}
        self.port = free_port()

    def roslaunch(self, *words):
        return self._stack.enter_context(Program("roslaunch", *words, **self.environment))

    def begin(self):
        robot = self.roslaunch("turtlebot_bringup", "minimal.launch", "world:=room")
        wait_for(lambda: "started core service" in robot.output, "master")
        self._bridge = self.roslaunch(
            "foxglove_bridge", "foxglove_bridge.launch", f"port:={self.port}"
        )
        wait_for(lambda: "ws://" in self.said(), "bridge", 60, self.said)
        self.observe(OBSERVER, **self.environment)

    def said(self):
        return self._bridge.output


@pytest.fixture(scope="module")
def robot():
    with RoomRobot() as robot:
        yield robot


@pytest.fixture(scope="module")
def studio(folder, robot):
    """The browser, with the robot's data."""
    with ExitStack() as stack:
        browser = stack.enter_context(Chromium(*WEBGL))
        query = {"ds": "foxglove-websocket", "ds.url": f"ws://127.0.0.1:{robot.port}"}
        browser.go(f"{folder}?{urllib.parse.urlencode(query)}")
        wait_for(lambda: browser.all("canvas"), "panels", 60, browser.errors)
        yield browser


def pixels(browser, colour):
    """Return how many pixels of the page have about a colour."""
    image = Image.open(io.BytesIO(browser.driver.get_screenshot_as_png())).convert("RGB")
    return sum(
        count
        for count, pixel in image.getcolors(1 << 24)
        if all(abs(part - wanted) < NEAR for part, wanted in zip(pixel, colour))
    )


@claim("The layout for Foxglove and Lichtblick shows map and scan, plots odom, and drives")
def test_the_layout_shows_the_robot_and_drives_it(studio, robot):
    wait_for(lambda: pixels(studio, SCAN) > LEAST, "scan", 60, robot.said)
    wait_for(lambda: pixels(studio, WALL) > LEAST, "walls of the map", 60, robot.said)
    studio.mouse("mousePressed", UP, "left")
    wait_for(lambda: robot.now.v > MOST_SLOW, "drive", 60, robot.said)
    wait_for(lambda: pixels(studio, CURVE) > LEAST, "curve of the velocity", 60, robot.said)
    studio.mouse("mouseReleased", UP, "left")
    robot.wait_for_rest()


@claim("Foxglove and Lichtblick publish a goal by two clicks on the floor")
def test_two_clicks_on_the_floor_publish_a_goal(studio, robot):
    with Program("rostopic", "echo", "/move_base_simple/goal", **robot.environment) as goal:
        wait_for(lambda: studio.all(PUBLISH), "button", 60, robot.said)

        def is_published():  # again, until rostopic has connected
            studio.one(PUBLISH).click()
            x, y = studio.middle("canvas")
            for way in (0, 40):  # to the first place, and in the direction of the second
                click(studio, x + way, y + 50)
            return 'frame_id: "map"' in goal.output

        wait_for(is_published, "goal", 60, robot.said)


def click(browser, x, y):
    for kind, button in (("Moved", "none"), ("Pressed", "left"), ("Released", "left")):
        event = {"type": f"mouse{kind}", "button": button, "clickCount": 1}
        browser.send("Input.dispatchMouseEvent", x=x, y=y, **event)
