"""What the floor shows: the driven robot, walls, the scan, pressed bumpers."""

import pytest
from selenium.webdriver.common.keys import Keys as Key

from tutorial_testing.claims import claim
from tutorial_testing.cockpit.floor import drawn, settled
from tutorial_testing.cockpit.hands import Thumbs
from tutorial_testing.cockpit.world import World
from tutorial_testing.nodes import node_path
from tutorial_testing.waiting import wait_for

LEAST_TOUCH = 44  # pixel, of what a thumb holds; WCAG 2.5.5
PHONES = {"upright": (360, 640), "on its side": (640, 360)}


@pytest.fixture(scope="module")
def two():
    """Two robots in a room, far away from each other."""
    with World("world:=room") as world:
        world.run(node_path("fake_turtlebot_sim", "fake_turtlebot.py"), "__ns:=robot_2")
        yield world


@claim("The driven robot is seen beside the buttons of a phone; thumbs find LB and the stick")
@pytest.mark.parametrize("held", PHONES)
def test_a_phone_shows_the_driven_one_of_two_robots_beside_what_thumbs_hold(
    two, shared_browser, held
):
    width, height = PHONES[held]
    with shared_browser.tab_of(width, height, touch=True) as phone:
        phone.open(two.address)
        wait_for(lambda: len(phone.all("#robots tr")) == 2, "two robots")
        hands = Thumbs(phone)
        hands.drive(two, until=lambda: two.now.x > 1.0)
        hands.release()
        two.wait_for_rest()
        phone.click("Clear trail")  # it has the robot's colour
        count, x, y = wait_for(lambda: settled(phone, "--accent"), "robot on the floor")
        assert count > 30
        assert phone.ask(f"document.elementFromPoint({x}, {y}).id") == "floor"
        assert phone.one("#floor").rect["height"] >= 250
        for css, least in (("#lb", LEAST_TOUCH), ("#stick", LEAST_TOUCH), ("#stop", 24)):
            box = phone.one(css).rect
            assert min(box["width"], box["height"]) >= least
            assert 0 <= box["x"] <= width - box["width"]
            assert 0 <= box["y"] <= height - box["height"]
        every = "[...document.body.querySelectorAll('*')]"  # none zooms
        assert "auto" not in phone.ask(f"{every}.map((e) => getComputedStyle(e).touchAction)")


@claim(
    "Floor: map, scan and bumpers as they are, until the world ends; a change of tab keeps the view"
)
def test_a_change_of_tab_keeps_the_view_of_walls_scan_and_bumper(two, shared_browser):
    page = shared_browser
    page.errors()  # dropped: earlier pages reported them
    # At the start of the room, as a wall nearer than 0.45 m has no scan.
    with two.run("rosservice", "call", "/fake_turtlebot/reset") as reset:
        assert reset.wait() == 0, reset.output
    page.open(two.address)
    wait_for(lambda: drawn(page, "--wall")[0] > 500, "walls on the floor")
    wait_for(lambda: drawn(page, "--scan")[0] > 100, "scan")
    ahead = "{linear: {x: 0.7}}"
    with two.run("rostopic", "pub", "-r", "10", "/cmd_vel", "geometry_msgs/Twist", ahead):
        wait_for(lambda: drawn(page, "--bumper")[0] > 10, "bumper at a wall")
    two.wait_for_rest()
    page.click("Zoom in")
    page.one("#floor").send_keys(Key.ARROW_LEFT)
    view = wait_for(lambda: settled(page, "--wall"), "walls of the view")
    page.tab("Log")
    page.wait_for_text("#log-lines", "/")
    page.tab("Robot")
    assert wait_for(lambda: settled(page, "--wall"), "walls again") == view
    page.tab("Frames")  # which needs tf again
    page.wait_for_text("#frames-rows", "gyro_link")
    page.tab("Robot")
    assert page.one("#follow").get_attribute("aria-pressed") == "false"
    assert page.errors() == []


SCAN = """{header: {frame_id: base_link}, angle_min: -0.5, angle_increment: 0.1, range_min: 0.1,
  range_max: 9, ranges: [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]}"""


@claim("A scan is drawn without a map, too, until its messages end")
def test_a_scan_without_a_map_is_on_the_floor_until_it_ends(world, page):
    """As a real TurtleBot shows before gmapping is started."""
    with world.run("rostopic", "pub", "-r", "10", "/scan", "sensor_msgs/LaserScan", SCAN):
        wait_for(lambda: drawn(page, "--scan")[0] > 50, "scan")
    wait_for(lambda: drawn(page, "--scan")[0] == 0, "end of the scan")
