"""Every tab shows what is true: the same as ROS' own commands say."""

import re

import pytest

from tutorial_testing.cockpit.chromium import LONG_S
from tutorial_testing.cockpit.hands import Keys
from tutorial_testing.nodes import node_path
from tutorial_testing.ports import free_port
from tutorial_testing.waiting import wait_for

POSITION = "/odom/pose/pose/position/x"


def shown(page, css):
    return float(re.search(r"-?[\d.]+", page.text(css))[0])


def drive_a_little(world, page):
    page.click("Drive from this page")
    hands = Keys(page)
    x = world.now.x
    hands.drive(world, until=lambda: world.now.x > x + 0.1)
    hands.release()
    world.wait_for_rest()
    page.click("Stop driving")


def test_robot_shows_the_odometry(world, page, ros):
    drive_a_little(world, page)
    x = float(ros("rostopic", "echo", "-n1", "/odom/pose/pose/position/x").split()[0])
    assert x > 0.1
    wait_for(lambda: shown(page, "[data-value=x]") == round(x, 2), f"x = {x:.2f}")
    assert shown(page, "[data-value=v]") == 0
    heard = ros("rostopic", "echo", "-n6", "/diagnostics")
    said = re.findall(r'joystick"\s+message: "(.*)"', heard)
    page.wait_for_text("#teleop", said[-1])


def test_graph_shows_the_nodes_and_what_they_say(page, ros):
    page.tab("Graph")
    wait_for(lambda: page.all("#graph g.node"), "nodes", LONG_S)
    nodes = {one.get_attribute("data-item").split()[1] for one in page.all("#graph g.node")}
    assert nodes <= set(ros("rosnode", "list").split())
    assert {"/fake_turtlebot", "/myjoystick2twist"} <= nodes
    page.one('[data-item="topic /cmd_vel"]').click()
    page.wait_for_text("[data-value=type]", ros("rostopic", "type", "/cmd_vel").strip())
    page.wait_for_text("[data-value=publishers]", "/myjoystick2twist")
    page.wait_for_text("[data-value=subscribers]", "/fake_turtlebot")
    page.one('[data-item="node /fake_turtlebot"]').click()
    page.wait_for_text("[data-value=publishes]", "/odom")
    page.wait_for_text("[data-value=services]", "/fake_turtlebot/reset")


def test_bag_shows_and_publishes_the_recording(world, page, ros):
    page.tab("Bag")
    wait_for(lambda: "joy.bag" in page.text("#bag-name"), "joy.bag", LONG_S)
    page.click("Open")
    info = ros("rosbag", "info", "-y", "-k", "duration", bag())
    page.wait_for_text("#bag-about", f"{float(info.split()[0]):.1f} s")
    messages = re.search(r"messages: (\d+)", ros("rosbag", "info", "-y", bag()))[1]
    page.wait_for_text("#bag-topics", messages)
    assert len(page.all("#bag-curves label")) >= 6
    page.click("Publish")
    wait_for(lambda: world.now.moves, "robot that moves", LONG_S)
    page.wait_for_text("#seat", "You play")
    wait_for(lambda: shown(page, "#bag-at") > 1, "position after 1 s", LONG_S)
    page.click("Pause")
    world.wait_for_rest()
    assert world.stays_at_rest()


def bag():
    import rospkg  # noqa: PLC0415  of the workspace, which is there once the tests run

    return f"{rospkg.RosPack().get_path('gamepad')}/bag/joy.bag"


def test_the_only_recording_is_opened_by_itself(page):
    page.tab("Bag")
    page.wait_for_text("#bag-about", "joy.bag")
    wait_for(lambda: page.all("#bag-chart canvas"), "chart", LONG_S)


@pytest.fixture
def look_only(world):
    port = str(free_port())
    name, script = "__name:=cockpit_for_viewers", node_path("cockpit", "cockpit.py")
    program = world.run(script, "--port", port, "--lan", name)
    told = lambda: re.search(r"to look: .*(\?token=\S+)", program.output)  # noqa: E731  short
    yield f"http://127.0.0.1:{port}/{wait_for(told, 'address', LONG_S)[1]}"
    program.__exit__()


def test_a_page_that_may_only_look_says_why_its_buttons_are_grey(look_only, shared_browser):
    shared_browser.open(look_only)
    shared_browser.wait_for_text("#ready", "it may look, not drive")
    assert not shared_browser.by_role("button", "Drive from this page").is_enabled()
    assert not shared_browser.one("#how").is_displayed()
    shared_browser.tab("Bag")
    shared_browser.wait_for_text("#bag-about", "joy.bag")
    shared_browser.wait_for_text("#bag-state", "it may look, not publish")
    assert not shared_browser.by_role("button", "Publish").is_enabled()
    shared_browser.driver.get("about:blank")


def choose(page, field):
    page.tab("Plot")
    page.one("#plot-search").send_keys(field)
    found = f'#plot-fields input[value="{field}"]'
    wait_for(lambda: page.all(found), field, LONG_S)
    page.one(found).click()


def test_plot_shows_the_newest_value(world, page):
    choose(page, POSITION)
    value = f'[data-field="{POSITION}"] output'
    wait_for(lambda: re.search(r"\d", page.text(value)), "value", LONG_S)
    assert abs(shown(page, value) - world.now.x) < 1e-3
    wait_for(lambda: page.all("#plot-chart canvas"), "chart", LONG_S)


def test_the_time_axis_has_a_unit(page):
    choose(page, POSITION)
    wait_for(lambda: page.all("#plot-chart .dygraph-xlabel"), "chart", LONG_S)
    assert page.text("#plot-chart .dygraph-xlabel") == "time [s]"


LABELS = """[...document.querySelectorAll('#plot-chart .dygraph-axis-label-x')]
    .map((e) => +e.textContent)"""


def axis(page):
    """The times [s] at the marks of the plot's time axis."""
    return sorted(page.ask(LABELS)) or [0.0]


def test_the_plot_moves_on_until_a_person_zooms_and_again_afterwards(world, page):
    choose(page, POSITION)
    page.one("#plot-window").send_keys("10 s")
    wait_for(lambda: axis(page)[-1] >= 3, "time axis that goes on", LONG_S)
    wait_for(lambda: axis(page)[0] >= 2, "time axis that leaves its beginning", LONG_S)
    box = page.one("#plot-chart").rect
    xs, y = [box["x"] + box["width"] * share for share in (0.4, 0.6)], box["y"] + 60
    for kind, x in (("mousePressed", xs[0]), ("mouseMoved", xs[1]), ("mouseReleased", xs[1])):
        page.send("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)
    chosen = wait_for(lambda: axis(page)[-1] - axis(page)[0] < 5 and axis(page), "zoom", LONG_S)
    count = len(world.odometry)
    wait_for(lambda: len(world.odometry) > count + 100, "odometry", LONG_S)
    assert axis(page) == chosen
    page.click("Whole range")
    wait_for(lambda: axis(page)[-1] > 11, "time axis that goes on again", LONG_S)
    assert axis(page)[0] < 2  # all of it, and not the last 10 s


def test_plot_saves_what_it_shows(page, tmp_path):
    page.send("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(tmp_path))
    choose(page, POSITION)
    wait_for(lambda: axis(page)[-1] >= 1, "a second of the chart", LONG_S)
    page.click("Save CSV")
    page.click("Save PNG")
    saved = tmp_path / "plot.csv"
    csv = wait_for(lambda: saved.exists() and saved.read_text(), "CSV").splitlines()
    assert csv[0] == "time,field,value"
    assert len(csv) > 10
    assert all(re.fullmatch(rf"[\d.]+,{POSITION},[-\d.e]+", line) for line in csv[1:])
    png = tmp_path / "plot.png"
    wait_for(lambda: png.exists() and png.read_bytes().startswith(b"\x89PNG"), "PNG")


def test_log_shows_what_nodes_say_by_level_and_filter(world, page):
    page.tab("Log")
    said = '{level: 4, name: /probe, msg: "look here"}'
    with world.run("rostopic", "pub", "/rosout", "rosgraph_msgs/Log", said):  # latched
        page.wait_for_text("#log-lines", "look here")
    assert page.all("#log-lines [data-level=WARN]")
    page.one("#log-filter").send_keys("no such words")
    wait_for(lambda: page.text("#log-lines") == "", "nothing that passes the filter")
    page.wait_for_text("#log-empty", "passes the filter")
    page.one("#log-filter").clear()
    page.one("#log-filter").send_keys("look")
    page.wait_for_text("#log-lines", "/probe")
    page.one("#log-level").send_keys("ERROR")
    wait_for(lambda: page.text("#log-lines") == "", "nothing that is an error")


def test_the_log_has_the_line_before_the_cockpit_was_started(page):
    page.tab("Log")
    page.wait_for_text("#log-lines", "/myjoystick2twist")  # the last line of each node is latched


@pytest.mark.parametrize("width", [360, 640, 1280])
def test_nothing_of_the_log_is_drawn_over_its_filter(page, width):
    metrics = {"width": width, "height": 640, "deviceScaleFactor": 1, "mobile": False}
    page.send("Emulation.setDeviceMetricsOverride", **metrics)
    try:
        page.tab("Log")
        filters, count = page.one("#log-filter").rect, page.one("#log-count").rect
    finally:
        page.send("Emulation.setDeviceMetricsOverride", **{**metrics, "width": 1280, "height": 800})
    beside = filters["x"] + filters["width"] <= count["x"]
    assert beside or filters["y"] + filters["height"] <= count["y"]
    assert filters["width"] >= 100


def test_doctor_shows_its_lines(page, ros):
    page.tab("Doctor")
    wait_for(lambda: page.all("#doctor-lines li"), "lines", LONG_S)
    wait_for(lambda: "Checking" not in page.text("#doctor-state"), "end of it", LONG_S)
    *lines, _ = ros("rosrun", "tutorial_tools", "doctor.py").splitlines()
    shown_lines = [one.text for one in page.all("#doctor-lines li")]
    for line in lines:
        level, subject = line.split()[:2]
        assert any(subject in text for text in shown_lines), (line, shown_lines)
        assert page.all(f"#doctor-lines [data-level={level.replace('unknown', 'note')}]")
    page.click("Run again")
    page.wait_for_text("#doctor-state", "Checking")
    wait_for(lambda: "Checking" not in page.text("#doctor-state"), "second run", LONG_S)
