"""What a person who uses every tab sees: signs of what was done, all in sight, few bytes."""

import pytest
import rospkg
from selenium.webdriver.common.keys import Keys as Key

from tutorial_testing.claims import claim
from tutorial_testing.cockpit.hands import Keys
from tutorial_testing.cockpit.world import EarlyWorld, World
from tutorial_testing.nodes import node_path
from tutorial_testing.waiting import wait_for

pytestmark = claim(
    "Whatever is done on the page has a sign, all of it is in sight, and a tab without the floor "
    "receives little"
)
PHONE = (360, 640)
# Counts what the server sends to a page that is opened from now on [bytes].
COUNTER = """globalThis.received = 0;
globalThis.WebSocket = class extends WebSocket {
  set onmessage(hear) {
    super.onmessage = (event) => (globalThis.received += event.data.length, hear?.(event));
  }
};"""
RECEIVED = "const [ms, done] = arguments, n = received; setTimeout(() => done(received - n), ms);"
MOST_BYTES_S = 2000
VISIBLE = "[...document.querySelectorAll('#topics thead th')].filter((cell) => cell.offsetParent)"
# The number of lines of each type.
LINES = """[...document.querySelectorAll("#topics-rows td:nth-child(2)")].map((cell) => {
  const range = document.createRange();
  range.selectNodeContents(cell);
  return new Set([...range.getClientRects()].map((box) => box.top)).size;
})"""


def test_the_first_click_on_topics_shows_types_and_an_empty_search_says_so(world, page):
    page.driver.get(world.address)
    page.wait_for_text("#me", "page")
    page.tab("Topics")
    page.wait_for_text("#topics-rows", "geometry_msgs/Twist")
    assert page.ask(f"{VISIBLE}.map((cell) => cell.textContent)")[:2] == ["Name", "Type"]
    assert page.ask("document.querySelector('#topics-rows td:nth-child(2)').offsetParent !== null")
    assert max(page.ask(LINES)) == 1, "a type has a line of its own where there is room"
    page.one("#topics-search").send_keys("nothing like it")
    page.wait_for_text("#topics-count", "none has nothing like it")
    page.one("#topics-kind").send_keys("services")
    wait_for(lambda: page.one("#topics-search").get_property("value") == "", "an empty search")


def test_stop_publishing_stays_where_it_is_while_messages_come(world, page):
    page.driver.get(f"{world.address}#topics/odom")
    page.wait_for_text("#topics-do", "Publish")
    page.driver.get(f"{world.address}#topics/joint_states")
    page.wait_for_text("#topics-echo", "---")
    page.wait_for_text("#topics-do", "Publish")
    before = page.one("#topics-send").rect["y"]
    wait_for(lambda: page.text("#topics-echo").count("---") > 20, "messages")
    assert page.one("#topics-send").rect["y"] == before < 800 - 30


def test_a_phone_has_all_columns_of_topics_and_the_form_near(world, shared_browser):
    with shared_browser.tab_of(*PHONE, touch=True) as phone:
        phone.open(f"{world.address}#topics/cmd_vel")
        wait_for(lambda: phone.all("[name='linear/x']"), "form")
        scroll = "document.querySelector('#topics-scroll')"
        assert phone.ask(f"{scroll}.scrollWidth <= {scroll}.clientWidth")
        columns = phone.ask(f"{VISIBLE}.map((cell) => cell.textContent)")
        assert columns == ["Name", "Type", "Hz", "bytes/s"]
        top = "document.querySelector('#topics-form').getBoundingClientRect().top"
        assert phone.ask(top) < 1.25 * PHONE[1]


def test_parameters_have_values_set_and_copy_have_signs(world, page, ros):
    ros("rosparam", "set", "/probe/rate", "7")
    page.driver.get(f"{world.address}#topics/probe/rate?kind=parameters")
    cells = "document.querySelector('#topics tr.chosen td:nth-child(2)').innerText"
    wait_for(lambda: page.all("#topics tr.chosen") and page.ask(cells) == "7", "its value")
    assert page.text("#topics-type") == "Value"
    page.one("#topics-fields input").send_keys(Key.BACKSPACE, "8")
    page.click("Set")
    page.wait_for_text("#topics-answer", "Set to 8")
    wait_for(lambda: page.ask(cells) == "8", "its new value")
    ros("rosparam", "delete", "/probe")
    page.driver.get(f"{world.address}#topics/odom")
    page.wait_for_text("#topics-echo", "---")
    page.click("Copy")
    page.wait_for_text("#topics-copy", "Copied")


def test_a_stick_alone_is_answered_by_what_to_hold(world, page):
    hands = Keys(page)
    hands.drive(world)
    hands.release()
    world.wait_for_rest()
    page.key("rawKeyDown", "ArrowUp")
    page.wait_for_text("#ready", "The stick alone moves nothing: hold LB, too.")
    page.key("keyUp", "ArrowUp")
    page.wait_for_text("#ready", "Hold LB, then move the stick.")
    page.click("Stop")


def test_a_hovered_tab_does_not_look_like_the_chosen_one(world, page):
    page.mouse("mouseMoved", "#tab-log")
    line = "getComputedStyle(document.querySelector('#tab-%s')).borderBottomColor"
    assert page.ask("document.querySelector('#tab-log').matches(':hover')")
    assert page.ask(line % "log") == "rgba(0, 0, 0, 0)" != page.ask(line % "robot")


def test_graph_shows_an_anonymous_node_without_its_numbers(world, page):
    page.tab("Graph")
    with world.run("rostopic", "pub", "-r", "1", "/named", "std_msgs/Empty"):
        wait_for(lambda: "/rostopic_…" in page.text("#graph-picture"), "its name in short")


def test_a_recording_of_rosbag_is_answered_by_how_to_pause_it(world, page):
    bag = rospkg.RosPack().get_path("gamepad") + "/bag/joy.bag"
    with world.run("rosbag", "play", "--loop", bag, "__name:=rosbag"):
        page.wait_for_text("#ready", "pause it first (tab Topics, Show: services")
    page.wait_for_text("#session", "Nobody drives.")
    world.wait_for_rest()


def test_a_page_that_is_opened_before_the_master_comes_by_itself(shared_browser):
    def look(world):
        shared_browser.driver.get(f"http://127.0.0.1:{world.port}/")
        wait_for(lambda: "start roscore" in shared_browser.text("body"), "what to do")

    with EarlyWorld(look):
        wait_for(lambda: shared_browser.all("#me"), "page")
        shared_browser.wait_for_text("#me", "page")


@pytest.mark.parametrize("tab", ["graph", "log", "doctor"])
def test_a_tab_without_the_floor_receives_little(world, shared_browser, tab):
    page = shared_browser
    script = page.send("Page.addScriptToEvaluateOnNewDocument", source=COUNTER)
    page.open(f"{world.address}#{tab}")
    try:
        with world.run("rostopic", "pub", "-r", "20", "/joy", "sensor_msgs/Joy", "axes: [0, 0.5]"):
            page.wait_for_text("#speed", "0.00 m/s")
            if tab == "doctor":
                wait_for(lambda: page.text("#doctor-state") not in ("", "Checking …"), "verdict")
            received = lambda: page.driver.execute_async_script(RECEIVED, 3000)  # noqa: E731
            # After what the tab needs at first, which takes a while on a busy machine.
            wait_for(lambda: 0 < received() < 3 * MOST_BYTES_S, "little traffic")
    finally:
        page.send("Page.removeScriptToEvaluateOnNewDocument", **script)


def test_turtles_alone_have_no_cards_of_a_robot(shared_browser):
    class Turtles(World):
        def begin(self):
            port = self.environment["ROS_MASTER_URI"].split(":")[-1]
            self.launched = self.run("roscore", "-p", port)
            wait_for(lambda: "core service" in self.launched.output, "master")
            self.run(node_path("turtlesim", "turtlesim_node"), "__name:=sim")
            self.start_cockpit()

    with Turtles() as world:
        shared_browser.open(world.address)
        shared_browser.wait_for_text("#turtles", "/sim")
        cards = "[...document.querySelectorAll('#robot .of-robot')].filter((e) => e.offsetParent)"
        wait_for(lambda: not shared_browser.ask(f"{cards}.length"), "no empty cards")
