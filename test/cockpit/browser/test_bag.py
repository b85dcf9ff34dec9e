"""The tab Bag: what a recording has is drawn, and what is chosen is published."""

import re
from pathlib import Path

import pytest
import rosbag
from selenium.webdriver.common.keys import Keys as Key

from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY
from tutorial_testing.waiting import wait_for

RECORDING = str(REPOSITORY / "common/gamepad/bag/joy.bag")
CURVE = ["rostopic", "pub", "-r", "10", "/cmd_vel", "geometry_msgs/Twist",
         "{linear: {x: 0.2}, angular: {z: 1.0}}"]  # fmt: skip
# The number of pixels of the chart that are about as blue as its first curve, #2b83d6.
BLUE = """[...document.querySelectorAll("#bag-chart canvas")].reduce((sum, canvas) => {
  const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  const near = (i) => [0x2b, 0x83, 0xd6, 255].every((v, part) => Math.abs(data[i + part] - v) < 40);
  return sum + data.filter((_, i) => i % 4 === 0 && near(i)).length;
}, 0)"""


def choose(page, words):
    """Search for a field and choose it by the keyboard alone."""
    search = page.one("#bag-search")
    search.clear()
    search.send_keys(words, Key.TAB)
    box = page.driver.switch_to.active_element
    assert box.get_attribute("type") == "checkbox"
    while words.split()[-1] not in box.accessible_name:  # after those that are chosen
        box.send_keys(Key.TAB)
        box = page.driver.switch_to.active_element
    box.send_keys(Key.SPACE)
    return box.accessible_name


def put(page, position):
    page.driver.execute_script(f"""const slider = document.querySelector("#bag-position");
      slider.value = {position};
      slider.dispatchEvent(new Event("input"));""")


@claim(
    "Tab Bag: the values at the slider; what publishes needs no button, and Pause stops the robot; "
    "a new connection opens it again and publishes nothing"
)
def test_bag_shows_the_values_at_its_slider_and_publishes_until_it_is_paused(world, page, ros):
    page.tab("Bag")
    info = ros("rosbag", "info", "-y", RECORDING)
    duration, messages = (re.search(rf"{key}: (\S+)", info)[1] for key in ("duration", "messages"))
    page.wait_for_text("#bag-about", f"joy.bag: {float(duration):.1f} s")
    page.wait_for_text("#bag-topics", messages)
    wait_for(lambda: page.all("#bag-chart canvas"), "chart")
    # The slider begins where the chart's axis does.
    middle = "(({left, right}) => (left + right) / 2)(%s.getBoundingClientRect())"
    zero = page.ask(middle % 'document.querySelector("#bag-chart .dygraph-axis-label-x")')
    left = "document.querySelector('#bag-position').getBoundingClientRect().left"
    wait_for(lambda: abs(page.ask(left) - zero) < 8, "slider below the chart")
    put(page, 20)
    choose(page, "buttons[4]")
    page.wait_for_text('[data-field="/joy/buttons[4]"] output', "1")
    place = page.ask("location.hash")
    assert place.startswith("#bag?name=joy.bag&f=/joy/axes") and "buttons" in place
    page.click("Publish")
    wait_for(lambda: world.now.moves, "robot that moves")
    page.wait_for_text("#session", "You play a recording to the robot.")
    assert "LB" not in page.text("#drive")  # no button must be held
    page.click("Pause")
    world.wait_for_rest()
    assert world.stays_at_rest()


@pytest.fixture
def recorded(world, page, ros):
    """The name of a recording of a robot that drove, which this page has recorded."""
    with world.run(*CURVE):
        wait_for(lambda: world.now.moves, "robot that moves")
        page.tab("Bag")
        page.click("Record all topics")
        page.wait_for_text("#bag-recorder", "Recording page_")
        page.wait_for_text("#bag-seconds", "1 s")
        name = page.text("#bag-recorder").split()[1]
        wait_for(lambda: "/record_" in ros("rosnode", "list"), "recorder")
        world.more(200)
        page.click("Stop recording")
        page.wait_for_text("#bag-about", f"{name}: ")
    world.wait_for_rest()
    yield name
    Path(name).unlink()


@claim("Tab Bag records all topics; a recording ends whole, also with a cockpit that is killed")
@claim("Every number of every recorded topic is drawn; a few at first, others by a search")
@claim("Before a recording plays, ...", because="chosen by the keyboard")
def test_bag_opens_what_it_has_recorded_draws_odometry_and_plays_velocities(world, page, recorded):
    x, speed = "/odom/pose/pose/position/x", "/odom/twist/twist/linear/x"
    put(page, 1)
    page.wait_for_text(f'#bag-values [data-field="{x}"] output', ".")
    wait_for(lambda: page.ask(BLUE) > 100, "curve of odometry")
    page.one('#bag-fields input[value$="position/x"]').send_keys(Key.SPACE)
    wait_for(lambda: not page.all(f'[data-field="{x}"]'), "x is no longer drawn")
    assert choose(page, "odom twist linear/x") == speed
    with rosbag.Bag(recorded) as bag:
        start, end = bag.get_start_time(), bag.get_end_time()
        odometry = [(t.to_sec() - start, m) for _, m, t in bag.read_messages(topics="/odom")]
    at, message = odometry[len(odometry) // 2]
    put(page, round(at, 2) + 0.01)
    wait_for(lambda: page.text(f'[data-field="{speed}"] output').startswith("0."), "speed")
    shown = float(page.text(f'[data-field="{speed}"] output'))
    assert shown == pytest.approx(message.twist.twist.linear.x, abs=0.02)
    rows = page.text("#bag-topics")
    assert "/fake_turtlebot publishes this now" in rows
    assert page.text("#bag-state") == "Choose topics to publish."
    put(page, 0)
    page.one('#bag-topics input[value="/cmd_vel"]').send_keys(Key.SPACE)
    wait_for(lambda: page.one("#bag-play").is_enabled(), "Publish")
    page.one("#bag-play").send_keys(Key.ENTER)
    page.wait_for_text("#session", "You play a recording, on /cmd_vel.")
    wait_for(lambda: world.now.moves, "robot that moves")
    page.one("#bag-pause").send_keys(Key.ENTER)
    world.wait_for_rest()
    page.wait_for_text("#session", "Nobody drives.")
    assert end - start > 1
    page.driver.refresh()
    page.wait_for_text("#bag-about", f"{recorded}: ")
    put(page, 1)
    page.wait_for_text(f'[data-field="{speed}"] output', "0.")
