"""What is drawn on the floor: the driven robot in sight, walls, the scan, pressed bumpers."""

import pytest
from selenium.webdriver.common.keys import Keys as Key

from tutorial_testing.cockpit.chromium import Chromium
from tutorial_testing.cockpit.hands import Thumbs
from tutorial_testing.cockpit.pixels import LEAST_CONTRAST, SCHEMES, colour, contrast, drawn, dress
from tutorial_testing.cockpit.world import HERE, World
from tutorial_testing.waiting import wait_for

PHONES = {"upright": (360, 640), "on its side": (640, 360)}
AHEAD = "rostopic", "pub", "-r", "10", "/cmd_vel", "geometry_msgs/Twist", "{linear: {x: 0.7}}"


def settled(browser, name):
    """Return where the floor has a colour, once two looks agree."""
    (places, _), (again, _) = drawn(browser, name), drawn(browser, name)
    return places if places and places == again else None


@pytest.mark.parametrize("held", PHONES)
def test_driven_one_of_two_robots_is_seen_beside_the_buttons(held):
    width, height = PHONES[held]
    two = str(HERE / "two_robots.launch")
    with World(two) as world, Chromium(width, height, touch=True) as phone:
        phone.open(world.address)
        wait_for(lambda: len(phone.all("#robots tr")) == 2, "two robots")
        hands = Thumbs(phone)
        hands.drive(world, until=lambda: world.now.x > 1.0)  # where the other one is far away
        hands.release()
        world.wait_for_rest()
        phone.click("Clear trail")  # it has the robot's colour
        robot = wait_for(lambda: settled(phone, "--accent"), "robot on the floor")
        assert len(robot) > 60
        y, x = (sum(of) / len(robot) for of in zip(*robot))
        box = phone.ask("document.getElementById('floor').getBoundingClientRect().toJSON()")
        at = f"{box['left'] + x}, {box['top'] + y}"
        assert phone.ask(f"document.elementFromPoint({at})?.id") == "floor"
        assert box["height"] >= 250
        stop = phone.by_role("button", "Stop").rect
        assert 0 <= stop["y"] <= height - stop["height"]


def test_walls_scan_and_bumper_stand_out_and_a_change_of_tab_keeps_the_view(room, page_of_room):
    page = page_of_room

    def stands_out(name, least):
        places, beside = drawn(page, name)
        worst = min((contrast(colour(page, name), one) for one in beside), default=0)
        return len(places) > least and worst >= LEAST_CONTRAST

    def stands_out_in_both(name, least):
        for scheme in SCHEMES:
            dress(page, scheme, PHONES["upright"])
            wait_for(lambda: stands_out(name, least), f"{name} that stands out, {scheme}")

    wait_for(lambda: len(drawn(page, "--wall")[0]) > 300, "walls on the floor")
    stands_out_in_both("--scan", 30)
    assert contrast(colour(page, "--scan"), colour(page, "--wall")) >= LEAST_CONTRAST
    assert drawn(page, "--bumper")[0] == []
    with room.run(*AHEAD):
        stands_out_in_both("--bumper", 5)
    room.wait_for_rest()
    page.click("Zoom in")
    page.one("#floor").send_keys(Key.ARROW_LEFT)
    view = wait_for(lambda: settled(page, "--wall"), "walls of the view")
    page.tab("Plot")
    page.tab("Robot")
    assert wait_for(lambda: settled(page, "--wall"), "walls again") == view
    assert page.one("#follow").get_attribute("aria-pressed") == "false"
