"""A person at the page drives the simulated robot: releases, Stop, other pages and programs."""

import pytest

from tutorial_testing.cockpit.chromium import Chromium
from tutorial_testing.cockpit.hands import Keys
from tutorial_testing.waiting import wait_for

FULL = 0.35  # m/s at full deflection: config/f710_d.yaml


def both_shifts(page):
    """Release one of two Shifts: Windows reports no release of the other."""
    page.key("rawKeyDown", "ShiftRight")
    page.key("keyUp", "ShiftLeft")


UNREPORTED = {
    "Shift, before the mouse moves": lambda page: page.mouse("mouseMoved", "#teleop"),
    "one Shift of two": both_shifts,
    "keys beside Cmd": lambda page: page.key("rawKeyDown", "MetaLeft"),
    "all, in an open list": lambda page: page.mouse("mousePressed", "#bag-rate", "left", True),
}


@pytest.mark.parametrize("name", UNREPORTED)
def test_a_release_that_no_keyup_reports_stops_the_robot(world, page, name):
    hands = Keys(page)
    hands.drive(world)
    if "list" in name:  # a driver may open lists on this tab
        page.driver.execute_script("document.getElementById('tab-bag').click()")
    UNREPORTED[name](page)
    world.wait_for_rest()
    assert world.stays_at_rest()
    for code in ("ShiftLeft", "ShiftRight", "MetaLeft"):
        page.key("keyUp", code)
    page.mouse("mouseReleased", "#connection", "left")
    page.tab("Robot")
    hands.drive(world)
    hands.release()


STOP_ON_TOP = """(() => {
  const box = document.getElementById("stop").getBoundingClientRect();
  const top = document.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2);
  return top.id === "stop" && box.width >= 24 && box.height >= 24;
})()"""


def test_who_drives_how_fast_and_stop_are_above_every_tab_until_esc(world, page):
    page.tab("Doctor")
    Keys(page).drive(world)  # Shift and an arrow drive on any tab
    page.wait_for_text("#seat", "You drive the robot.")
    page.wait_for_text("#speed", f"{FULL} m/s, 0.00 rad/s")
    for name in page.ask("[...document.querySelectorAll('[role=tab]')].map((e) => e.textContent)"):
        page.tab(name)
        assert page.one("#seat").is_displayed() and page.one("#speed").is_displayed(), name
        assert page.ask(STOP_ON_TOP), name
    Keys(page).drive(world)  # a busy machine may have stopped it meanwhile
    page.key("rawKeyDown", "Escape")
    world.wait_for_rest()
    page.wait_for_text("#seat", "Nobody drives.")
    page.wait_for_text("#speed", "0.00 m/s, 0.00 rad/s")
    assert world.stays_at_rest()  # although all is still held


def test_a_second_page_is_refused_until_the_first_hands_over(world, page):
    with Chromium() as second:
        second.open(world.address)  # first: a browser that starts may hold up the other one
        Keys(page).drive(world)
        second.wait_for_text("#seat", "drives the robot")
        wait_for(lambda: not second.one("#take").is_enabled(), "grey button")
        page.wait_for_text("#seat", "You drive")
        second.click("Stop")
        world.wait_for_rest()
        page.wait_for_text("#ready", "pressed Stop. Release LB and the stick")
        page.wait_for_text("#seat", "You drive")
        assert world.stays_at_rest()  # although the first one still holds all
        Keys(page).drive(world)
        page.one("#heir").send_keys(second.text("#me").split()[-1])
        page.click("Hand over")
        world.wait_for_rest()
        second.wait_for_text("#seat", "You drive")
        assert world.stays_at_rest()  # although the first one still holds all
        Keys(second).drive(world)
        Keys(second).release()
        world.wait_for_rest()
        assert second.errors() == []


def test_a_recording_beside_the_page_is_shown_as_the_driver(world, page, recording):
    page.tab("Bag")
    page.wait_for_text("#bag-about", "joy.bag")
    with world.run("rosbag", "play", "--loop", recording, "__name:=player"):
        page.wait_for_text("#teleop", "driving")
        page.wait_for_text("#seat", "/player drives the robot.")
        why = "layer publishes the joystick topic of this robot: end it first."
        page.wait_for_text("#ready", why)
        page.wait_for_text("#bag-state", why)
        for css in ("#take", "#bag-play", "#stop"):  # Stop: of what pages drive
            assert not page.one(css).is_enabled(), css
    page.wait_for_text("#seat", "Nobody drives.")
    wait_for(lambda: page.one("#take").is_enabled() and page.one("#bag-play").is_enabled(), "leave")
    wait_for(lambda: page.text("#teleop") != "driving", "joy2twist that drives no longer")
    world.wait_for_rest()


def test_no_menu_opens_where_a_page_drives(page):
    event = "new Event('contextmenu', {cancelable: true, bubbles: true})"
    script = f"document.body.dispatchEvent({event})"
    assert page.ask(script) is True
    page.click("Drive from this page")
    page.wait_for_text("#seat", "You drive")
    assert page.ask(script) is False
