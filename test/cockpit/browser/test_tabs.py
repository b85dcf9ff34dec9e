"""Every tab shows what ROS's own commands print."""

import re

from tutorial_testing.claims import claim
from tutorial_testing.cockpit.chromium import SHIFT
from tutorial_testing.cockpit.hands import Keys
from tutorial_testing.waiting import wait_for

POSITION = "/odom/pose/pose/position/x"


def shown(page, css):
    return float(re.search(r"-?[\d.]+", page.text(css))[0])


@claim(
    "Tab Robot: odometry, joy2twist's report, battery, charger, buttons, wheel drops, LEDs and "
    "sounds of a Kobuki"
)
@claim("Reset puts one robot back, and is refused while another drives it")
def test_robot_shows_odometry_joy2twist_and_a_kobuki(world, page, ros):
    hands = Keys(page)
    begin = world.now.x
    hands.drive(world, until=lambda: world.now.x > begin + 0.1)
    hands.release()
    world.wait_for_rest()
    page.click("Stop")
    x = float(ros("rostopic", "echo", "-n1", POSITION).split()[0])
    wait_for(lambda: shown(page, "[data-value=x]") == round(x, 2), f"x = {x:.2f}")
    assert shown(page, "[data-value=v]") == 0
    reports = ros("rostopic", "echo", "-n6", "/diagnostics")
    page.wait_for_text("#teleop", re.findall(r'joystick"\s+message: "(.*)"', reports)[-1])
    page.click("Reset robot")
    wait_for(lambda: world.now.x == 0, "robot at its start")
    commands = "/mobile_base/commands"
    ros("rostopic", "pub", "-1", f"{commands}/led2", "kobuki_msgs/Led", "value: 2")
    page.wait_for_text("#kobuki [data-value=led2]", "orange")
    ros("rostopic", "pub", "-1", f"{commands}/sound", "kobuki_msgs/Sound", "value: 4")
    page.wait_for_text("#kobuki [data-value=sound]", "error")
    core = "{battery: 131, charger: 22, buttons: 5, wheel_drop: 1}"
    topic = "/mobile_base/sensors/core"
    with world.run("rostopic", "pub", "-r", "20", topic, "kobuki_msgs/SensorState", core):
        for name, words in (("battery", "13.1"), ("charger", "adapter, charging"),
                            ("buttons", "0, 2"), ("wheel_drops", "right")):  # fmt: skip
            page.wait_for_text(f"#kobuki [data-value={name}]", words)
    page.wait_for_text("#kobuki [data-value=battery]", "\N{EN DASH}")


MARKS = """[...document.querySelectorAll('#plot-chart .dygraph-axis-label-x')]
    .map((e) => +e.textContent)"""


def axis(page):
    return sorted(page.ask(MARKS)) or [0.0]


@claim("Tab Plot: the newest value, CSV and PNG; it stays where one zooms")
def test_plot_shows_the_newest_value_saves_all_and_stays_where_a_person_zooms(
    world, page, tmp_path
):
    page.tab("Plot")
    page.one("#plot-search").send_keys(POSITION)
    box = f'#plot-fields input[value="{POSITION}"]'
    wait_for(lambda: page.all(box), POSITION)
    page.one(box).click()
    value = f'[data-field="{POSITION}"] output'
    wait_for(lambda: re.search(r"\d", page.text(value)), "value")
    assert abs(shown(page, value) - world.now.x) < 1e-3
    page.send("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(tmp_path))
    page.click("Save CSV")
    page.click("Save PNG")
    saved = tmp_path / "plot.csv"
    csv = wait_for(lambda: saved.exists() and saved.read_text(), "CSV").splitlines()
    assert csv[0] == "time,field,value"
    assert len(csv) > 10
    assert all(re.fullmatch(rf"[\d.]+,{POSITION},[-\d.e]+", line) for line in csv[1:])
    png = tmp_path / "plot.png"
    wait_for(lambda: png.exists() and png.read_bytes().startswith(b"\x89PNG"), "PNG")
    page.one("#plot-window").send_keys("10 s")
    wait_for(lambda: axis(page)[-1] - axis(page)[0] > 5, "ten seconds")
    box = page.one("#plot-chart").rect
    xs, y = [box["x"] + box["width"] * share for share in (0.4, 0.6)], box["y"] + 60
    for kind, x in (("mousePressed", xs[0]), ("mouseMoved", xs[1]), ("mouseReleased", xs[1])):
        page.send("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)
    chosen = wait_for(lambda: axis(page)[-1] - axis(page)[0] < 5 and axis(page), "zoom")
    world.more(100)
    assert axis(page) == chosen
    page.click("Whole range")
    wait_for(lambda: axis(page)[-1] - axis(page)[0] > 5, "time axis that goes on again")


@claim(
    "Plot: whole arrays, with the entries that exist, another axis, the value at the mouse, the "
    "wheel; a topic that is not published is named, and drawn once it is"
)
def test_plot_has_whole_arrays_another_axis_the_value_at_the_mouse_and_a_wheel(world, page):
    wheels = "/joint_states/position"
    page.driver.get(f"{world.address}#plot?f={wheels}")
    page.wait_for_text("#plot-values", "2 entries")
    page.wait_for_text("#plot-fields", f"{wheels}[1]")
    assert f"{wheels}[2]" not in page.text("#plot-fields")
    wait_for(lambda: axis(page)[-1] == 1, "index of the last entry")
    page.mouse("mouseMoved", "#plot-chart")
    page.wait_for_text("#plot-at", "of index")
    wait_for(lambda: re.search(r"position -?[\d.]+$", page.text("#plot-values")), "value there")
    page.driver.get(f"{world.address}#plot?f={POSITION}&f={wheels}[0]&last=30&x={POSITION}")
    page.wait_for_text("#plot-chart .dygraph-xlabel", POSITION)
    assert page.driver.current_url.endswith(f"&last=30&x={POSITION}")
    page.driver.get(f"{world.address}#plot?f={POSITION}&last=10")
    span = wait_for(lambda: axis(page)[-1] - axis(page)[0] > 3 and axis(page), "time axis")
    x, y = page.middle("#plot-chart")
    wheel = {"type": "mouseWheel", "x": x, "y": y, "deltaX": 0, "deltaY": -400}
    page.send("Input.dispatchMouseEvent", **wheel)
    wait_for(lambda: axis(page)[-1] - axis(page)[0] < (span[-1] - span[0]) / 2, "zoom")
    before = axis(page)[0]
    page.send("Input.dispatchMouseEvent", **{**wheel, "modifiers": SHIFT})
    wait_for(lambda: axis(page)[0] < before, "pan")
    page.driver.get(f"{world.address}#plot?f=/later/data")
    page.one("#plot-search").send_keys("/later")
    page.wait_for_text("#plot-fields", "No published topic has /later.")
    page.wait_for_text("#plot-missing", "No published topic has /later/data:")
    with world.run("rostopic", "pub", "-r", "10", "/later", "std_msgs/Float64", "7"):
        page.wait_for_text("#plot-values", "/later/data 7")
        wait_for(lambda: page.text("#plot-missing") == "", "topic")


@claim("Tab Log: latched lines, levels and filter, levels of loggers; 1,000 lines are kept")
def test_log_shows_what_nodes_log_by_level_and_filter_and_sets_a_logger(world, page, ros):
    page.tab("Log")
    page.wait_for_text("#log-lines", "/myjoystick2twist")  # logged before the cockpit started
    entry = '{level: 4, name: /probe, msg: "look here"}'
    with world.run("rostopic", "pub", "/rosout", "rosgraph_msgs/Log", entry):  # latched
        page.wait_for_text("#log-lines", "look here")
    assert page.all("#log-lines [data-level=WARN]")
    page.one("#log-filter").send_keys("look")
    wait_for(lambda: "/myjoystick2twist" not in page.one("#log-lines").text, "filter")
    assert "/probe" in page.one("#log-lines").text
    page.one("#log-level").send_keys("ERROR")
    wait_for(lambda: page.one("#log-lines").text == "", "nothing that is an error")
    page.wait_for_text("#log-empty", "matches the filter")
    wait_for(lambda: "/observer" in page.text("#log-node"), "nodes")
    page.one("#log-node").send_keys("/observer")
    page.wait_for_text("#log-logger", "rosout")
    page.one("#log-logs").send_keys("WARN")
    wait_for(lambda: '"WARN"' in ros("rosservice", "call", "/observer/get_loggers"), "level")


# How often the page asked for a frame within a time, and how large a curve of this colour is in
# the chart: [frames, width, height].
DRAWN = """const [ms, colour, done] = arguments, ask = window.requestAnimationFrame;
let frames = 0;
window.requestAnimationFrame = (draw) => (frames++, ask.call(window, draw));
setTimeout(() => {
  window.requestAnimationFrame = ask;
  const layers = [...document.querySelectorAll("#plot-chart canvas")], [{width, height}] = layers;
  const pen = new OffscreenCanvas(width, height).getContext("2d", {willReadFrequently: true});
  for (const layer of layers) pen.drawImage(layer, 0, 0);
  const {data} = pen.getImageData(0, 0, width, height), xs = [], ys = [];
  for (let i = 0; i < data.length; i += 4) {
    const isOther = (part, at) => Math.abs(part - data[i + at]) > 30;
    if (data[i + 3] < 200 || colour.some(isOther)) continue;
    xs.push((i / 4) % width);
    ys.push(Math.floor(i / 4 / width));
  }
  const extreme = (all, choose) => all.reduce((a, b) => choose(a, b), all[0] ?? 0);
  const length = (all) => extreme(all, Math.max) - extreme(all, Math.min);
  done([frames, length(xs), length(ys)]);
}, ms);"""
FIRST, SECOND = [0x2B, 0x83, 0xD6], [0xD9, 0x70, 0x0A]
FRAMES_S = 25  # Ten drawings a second, some in two steps.


@claim(
    "Plot against a field draws a circle as a circle, an array beside a number, and asks for few "
    "frames"
)
def test_plot_of_a_turning_robot_is_a_circle_and_asks_for_few_frames(world, page):
    other = POSITION[:-1] + "y"
    page.driver.get(f"{world.address}#plot?f={POSITION}&f={other}&last=30&x={POSITION}")
    page.wait_for_text("#plot-chart .dygraph-xlabel", POSITION)
    turn = "{linear: {x: 0.5}, angular: {z: 1.5}}"
    with world.run("rostopic", "pub", "-r", "10", "/cmd_vel", "geometry_msgs/Twist", turn):
        wait_for(lambda: world.now.yaw < -1, "half of the circle")
        wait_for(lambda: world.now.yaw > 1, "all of it")
        frames, width, height = page.driver.execute_async_script(DRAWN, 4000, SECOND)
    assert frames < 4 * FRAMES_S
    assert width > 100 and abs(width / height - 1) < 0.05, (width, height)
    page.mouse("mouseMoved", "#plot-chart")
    page.wait_for_text("#plot-at", f"of {POSITION}")
    assert "NaN" not in page.text("#plot-values")
    world.wait_for_rest()


@claim("Plot against a field ...", because="an array beside a number")
def test_plot_of_an_array_beside_a_number_has_both_and_asks_for_few_frames(world, page):
    wheels = "/joint_states/position"
    page.driver.get(f"{world.address}#plot?f={POSITION}&f={wheels}")
    wait_for(lambda: axis(page)[-1] == 1, "index of the last entry")
    frames, width, _ = page.driver.execute_async_script(DRAWN, 3000, FIRST)
    assert width > 300, "the number is a level line from the first to the last index"
    assert frames < 3 * FRAMES_S
    page.click("Pause")
    assert page.driver.execute_async_script(DRAWN, 1000, FIRST)[0] < FRAMES_S
