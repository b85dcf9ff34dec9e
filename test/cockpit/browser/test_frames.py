"""The tab Frames: the tree of tf, what is wrong in it, and a transform, as a page shows them."""

import re

from selenium.webdriver.common.keys import Keys

from tutorial_testing.claims import claim
from tutorial_testing.cockpit.accessibility import violations
from tutorial_testing.processes import suspended
from tutorial_testing.waiting import wait_for

BASE = "base_footprint"
TF = """transforms: [{header: {stamp: now, frame_id: odom}, child_frame_id: %s,
  transform: {rotation: {%s}}}]"""
# frame -> [level in the tree, texts of its cells: name and problems, Hz, age, nodes].
ROWS = """Object.fromEntries([...document.querySelectorAll("#frames-rows tr")].map(
  (line) => [line.cells[0].firstChild.textContent,
             [Number(line.ariaLevel), ...[...line.cells].map((cell) => cell.innerText)]]))"""
# Colour and sign of the shown problems.
SIGNS = """[...document.querySelectorAll("#frames .problem:not(:empty)")].map((problem) =>
  [getComputedStyle(problem).color, getComputedStyle(problem, "::before").content])"""
RED = {"light": "rgb(179, 38, 30)", "dark": "rgb(255, 138, 128)"}
# Prints what tf2_ros has: the translation and the quaternion.
LOOKUP = """import rospy, sys, tf2_ros
rospy.init_node("lookup", anonymous=True)
buffer = tf2_ros.Buffer()
listener = tf2_ros.TransformListener(buffer)
transform = buffer.lookup_transform(*sys.argv[1:], rospy.Time(0), rospy.Duration(60)).transform
place, turn = transform.translation, transform.rotation
print("numbers", *("%.3f" % n for n in (place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w)))
"""


def publishing(world, child, turn="w: 1"):
    message = TF % (child, turn)
    return world.run("rostopic", "pub", "-s", "-r20", "/tf", "tf2_msgs/TFMessage", message)


def cells(page, frame):
    return page.ask(ROWS).get(frame, [0, "", "", "", ""])


def wait_for_problem(page, frame, *words):
    text = lambda: cells(page, frame)[1]  # noqa: E731
    wait_for(lambda: all(word in text() for word in words), f"{words} at {frame}", seen=text)


@claim(
    "Tab Frames: the robot's frames by one click, two nodes on an edge, refused transforms and "
    "gaps in red and in words; axe finds nothing"
)
def test_tree_of_the_robot_shows_two_nodes_a_refusal_and_a_gap_in_red(world, page):
    page.tab("Frames")
    wait_for(lambda: float(cells(page, "wheel_left_link")[2] or 0) > 10, "rate")
    level, _, rate, age, nodes = cells(page, BASE)
    assert (level, nodes) == (2, "/fake_turtlebot") and float(rate) > 10 and age.endswith(" s")
    assert cells(page, "odom") == [1, "odom", "", "", ""]
    assert cells(page, "gyro_link") == [4, "gyro_link", "static", "", "/robot_state_publisher"]
    wait_for(lambda: page.ask(SIGNS) == [], "tree without problems")
    with publishing(world, BASE), publishing(world, "odd", "w: 0.5"):
        wait_for_problem(page, BASE, "2 nodes publish it: /fake_turtlebot, /rostopic")
        wait_for_problem(page, "odd", "the length of its quaternion is 0.5, not 1")
        page.wait_for_text("#frames-about", "2 with problems")
        for scheme, red in RED.items():
            features = [{"name": "prefers-color-scheme", "value": scheme}]
            page.send("Emulation.setEmulatedMedia", features=features)
            assert page.ask(SIGNS) == [[red, '"\N{WARNING SIGN} "']] * 2
            assert violations(page) == []
    with publishing(world, "still") as program:
        wait_for(lambda: float(cells(page, "still")[2] or 0) > 10, "frame")
        with suspended(program.left_behind()):
            wait_for_problem(page, "still", "nothing for ")
        wait_for(lambda: cells(page, "still")[1] == "still", "end of the gap")


@claim("Tab Frames ...", because="a phone")
def test_a_phone_shows_the_whole_tree_without_a_bar_and_words_stay_whole(world, page):
    page.resize(360, 740)
    page.tab("Frames")
    page.wait_for_text("#frames-rows", "wheel_right_link")
    side = "(({scrollWidth, clientWidth}) => scrollWidth - clientWidth)"
    assert page.ask(f"{side}(document.querySelector('#frames .scroll'))") == 0
    heads = "[...document.querySelectorAll('#frames th')].map((head) => head.offsetHeight)"
    assert max(page.ask(heads)) < 30, "one line [pixel]"
    page.resize()


def shown_numbers(page):
    place, _, turn = page.text("#frames-transform").split("\n")
    return [float(number) for number in re.findall(r"-?\d+\.\d+", place + turn)]


@claim(
    "Frames: the keyboard chooses a frame, the page shows tf2's transform and keeps the pair in "
    "its address"
)
def test_transform_is_that_of_tf2_and_the_keyboard_and_the_address_choose_it(world, page, ros):
    page.tab("Frames")
    page.wait_for_text("#frames-transform", "quaternion")
    assert [page.one(f"#frames-{end}").get_property("value") for end in ("from", "to")] == [
        "odom", BASE,
    ]  # fmt: skip
    stops = "[...document.querySelectorAll('#frames-rows tr')].filter((row) => row.tabIndex === 0)"
    focused = lambda: page.driver.switch_to.active_element  # noqa: E731
    page.ask("document.getElementById('tab-frames').focus()")
    while focused().tag_name != "tr":
        focused().send_keys(Keys.TAB)
    focused().send_keys(Keys.END)
    focused().send_keys(Keys.ARROW_UP)
    assert "wheel_left_link" in focused().text
    assert page.ask(f"{stops}.length") == 1
    focused().send_keys(Keys.ENTER)
    wait_for(lambda: page.driver.current_url.endswith("?from=odom&to=wheel_left_link"), "address")
    focused().send_keys(Keys.TAB)
    assert focused().get_property("id") == "frames-from"
    focused().send_keys(BASE)
    wait_for(lambda: f"?from={BASE}" in page.driver.current_url, "address")
    page.driver.refresh()
    program = ros("/usr/bin/python3", "-c", LOOKUP, BASE, "wheel_left_link")
    expected = [float(number) for number in re.search("numbers (.*)", program)[1].split()]
    assert any(expected)
    page.wait_for_text("#frames-transform", "quaternion")
    wait_for(lambda: shown_numbers(page) == expected, f"{expected}", seen=lambda: page.text("pre"))
    page.driver.get(f"{world.address}#frames?from=odom&to=nowhere")
    page.wait_for_text("#frames-transform", '"nowhere" passed to lookupTransform')
    assert page.one("#frames-to").get_property("value") == "nowhere"
