"""What is drawn on the floor: the driven robot in sight, walls, the scan, pressed bumpers."""

import pytest
from selenium.webdriver.common.keys import Keys as Key

from tutorial_testing.cockpit.chromium import Chromium
from tutorial_testing.cockpit.hands import Thumbs
from tutorial_testing.cockpit.world import HERE, World
from tutorial_testing.waiting import wait_for

PHONES = {"upright": (360, 640), "on its side": (640, 360)}
# How many pixels of the floor have about the colour of a variable of the style sheet, and their
# middle as a place on the page [pixel].
DRAWN = """(() => {
  const canvas = document.getElementById("floor"), box = canvas.getBoundingClientRect();
  const hex = getComputedStyle(canvas).getPropertyValue(%r).trim().slice(1);
  const wanted = [0, 2, 4].map((i) => parseInt(hex.slice(i, i + 2), 16));
  const pen = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
  pen.drawImage(canvas, 0, 0);
  const { data } = pen.getImageData(0, 0, canvas.width, canvas.height);
  let [count, x, y] = [0, 0, 0];
  for (let i = 0; i < data.length; i += 4) {
    if (wanted.some((value, k) => Math.abs(data[i + k] - value) >= 12)) continue;
    count += 1;
    x += (i / 4) %% canvas.width;
    y += Math.floor(i / 4 / canvas.width);
  }
  return [count, box.left + x / count, box.top + y / count];
})()"""


@pytest.mark.parametrize("held", PHONES)
def test_the_driven_one_of_two_robots_is_seen_beside_the_buttons(held):
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
        count, x, y = wait_for(lambda: settled(phone), "robot on the floor")
        assert count > 60
        assert phone.ask(f"document.elementFromPoint({x}, {y}).id") == "floor"
        assert 0 <= x <= width and 0 <= y <= height
        assert phone.one("#floor").rect["height"] >= 250
        stop = phone.by_role("button", "Stop").rect
        assert 0 <= stop["y"] <= height - stop["height"]


def settled(browser, colour="--accent"):
    """Return what is drawn in a colour, that of the robot, once two looks agree."""
    drawn = browser.ask(DRAWN % colour)
    return drawn if drawn[0] and drawn == browser.ask(DRAWN % colour) else None


@pytest.mark.parametrize("size", [(1280, 800), (360, 640)])
def test_walls_scan_and_bumpers_are_drawn(size):
    with World(str(HERE / "world.launch"), "world:=room") as world, Chromium(*size) as browser:

        def count(colour):
            return browser.ask(DRAWN % colour)[0]

        browser.open(world.address)
        wait_for(lambda: count("--wall") > 500, "walls on the floor")
        wait_for(lambda: count("--scan") > 50, "points of the scan")
        assert count("--bumper") == 0
        ahead = "{linear: {x: 0.7}}"
        with world.run("rostopic", "pub", "-r", "10", "/cmd_vel", "geometry_msgs/Twist", ahead):
            wait_for(lambda: count("--bumper") > 10, "a pressed bumper")
            assert world.now.x == pytest.approx(4.0 - 0.178)  # its side touches the wall
        world.wait_for_rest()
        browser.click("Zoom in")
        browser.one("#floor").send_keys(Key.ARROW_LEFT)
        view = wait_for(lambda: settled(browser, "--wall"), "walls of the view")
        browser.tab("Plot")
        wait_for(lambda: browser.all("#plot-fields input"), "fields")
        browser.press("#plot-fields input")
        browser.tab("Log")
        browser.wait_for_text("#log-lines", "/")
        browser.tab("Robot")
        assert wait_for(lambda: settled(browser, "--wall"), "walls again") == view
        assert browser.one("#follow").get_attribute("aria-pressed") == "false"
        assert browser.errors() == []


@pytest.mark.parametrize("place", [{}, {"x": 1e17, "y": 1e17, "yaw": 0}])
def test_the_floor_is_drawn_wherever_a_robot_says_it_is(page, place):
    script = """const [place, done] = arguments, canvas = document.createElement("canvas");
    Object.assign(canvas.style, {position: "fixed", width: "300px", height: "300px"});
    document.body.append(canvas);
    import('/page/floor.js').then(({Floor}) => {
      const floor = new Floor(canvas, () => []);
      floor.show({"": place});
      requestAnimationFrame(() => requestAnimationFrame(() => {
        const {data} = canvas.getContext("2d").getImageData(0, 0, 300, 300);
        done(new Set(new Uint32Array(data.buffer)).size);
        canvas.remove();
      }));
    })"""
    colours = page.driver.execute_async_script(script, place)
    assert colours > 1  # a grid
