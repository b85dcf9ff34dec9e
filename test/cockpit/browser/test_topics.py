"""The tab Topics, and links to what a tab shows."""

import re
import signal

import pytest
from selenium.webdriver.common.keys import Keys

from tutorial_testing.claims import claim
from tutorial_testing.cockpit.accessibility import violations
from tutorial_testing.cockpit.chromium import Chromium
from tutorial_testing.socket_page import SocketPage
from tutorial_testing.waiting import tolerance, wait_for

PERIOD_S, SILENCE_S = 0.05, 0.2  # between messages; the silence beyond it that ends publishing
RUNNING = "#topics-running-rows tr"
ROWS = f"[...document.querySelectorAll('{RUNNING}')].map((row) => row.innerText)"
TWO = (
    ("/probe/wave", "std_msgs/Float64", "sin(i / 10)"),
    ("/probe/words", "std_msgs/String", "sin(i)"),
)


def publishes(page):
    """Return whether the page publishes; else start it, again where a busy machine ended it."""
    if not page.all(RUNNING):
        page.press("#topics-send")
    return bool(page.all(RUNNING))


def type_on(page, *keys):
    """Press keys on whatever has the focus."""
    for key in keys:
        page.driver.switch_to.active_element.send_keys(key)


def choose_new(page, name, kind):
    """Name a topic and its type, from the open *New topic* on, until its first field has focus."""
    page.one("#topics-new summary").send_keys(Keys.TAB)
    assert page.ask("document.activeElement.name") == "topic"
    for text in (name, kind):
        type_on(page, Keys.CONTROL + "a", text, Keys.TAB)
    type_on(page, Keys.ENTER)  # Choose
    wait_for(lambda: page.ask("document.activeElement.name") == "data", "its form")


def publish_two(page):
    """Publish on two topics, then stop the first; return False where a busy machine ended one."""
    for name, kind, text in TWO:
        choose_new(page, name, kind)
        type_on(page, text, Keys.ENTER)
    counts = lambda: [int(row.split()[4]) for row in page.ask(ROWS)]  # noqa: E731
    is_silent = lambda: "silent" in page.text("#notice")  # noqa: E731
    wait_for(lambda: (len(counts()) == 2 and min(counts()) > 5) or is_silent(), "messages of both")
    rows, title, tab = page.ask(ROWS), page.text("#topics-running-title"), page.text("#tab-topics")
    stops = page.all("[aria-label='Stop /probe/wave']")
    if len(rows) < 2 or not stops:
        return False
    assert [row.split()[:4] for row in rows] == [[n, f"{t},", "10", "Hz"] for n, t, _ in TWO]
    assert (title, tab) == ("Publishing on 2 topics", "Topics (2)")
    stops[0].send_keys(Keys.ENTER)
    wait_for(lambda: len(counts()) < 2, "end of one")
    return page.text("#topics-running-title") == "Publishing on 1 topic"


@claim("A link shows what it names, and the chosen robot; a reload keeps both, Back goes back")
def test_a_link_shows_what_it_names_reload_keeps_it_and_back_goes_back(world, page):
    def at(place):
        wait_for(lambda: page.driver.current_url == f"{world.address}{place}", place)

    plot = "?robot=robot_7#plot?f=/odom/pose/pose/position/x&f=/odom/twist/twist/angular/z&last=60"
    page.driver.get(f"{world.address}{plot}&f=/odom/twist/twist/linear/x")
    page.wait_for_text("#plot-values", "/linear/x")
    page.press("#plot-fields li:nth-child(3) input")
    at(plot)
    page.driver.refresh()
    page.wait_for_text("#look", "robot_7 (gone)")
    page.wait_for_text("#plot-values", "/angular/z 0")
    page.tab("Log")
    at("?robot=robot_7#log")
    page.driver.back()
    at(plot)


@claim(
    "Topics has rates within 2 %, messages, definitions; it publishes, as a publisher that is "
    "shown, calls, sets parameters; a refusal is shown until the next action"
)
def test_topics_shows_rates_and_messages_publishes_calls_and_sets(world, page, ros):
    page.tab("Topics")
    assert not page.one("#topics-definition").find_element("xpath", "..").is_displayed(), "no topic"
    page.driver.get(f"{world.address}#topics/probe")
    page.one("#topics-search").send_keys("probe")
    with world.run("rostopic", "pub", "-r", "20", "/probe", "std_msgs/String", "a"):
        cells = "[...document.querySelectorAll('#topics-rows tr td')].map((one) => one.textContent)"
        wait_for(lambda: page.ask(cells)[:3] == ["/probe", "std_msgs/String", "1"], "its row")
        wait_for(lambda: 5 < float(page.ask(cells)[4] or 0) < 20.4, "rate")  # up to 20
        rate, size = map(float, page.ask(cells)[4:])
        assert abs(size - 5 * rate) < 1  # bytes
        page.wait_for_text("#topics-echo", 'data: "a"\n---\ndata: "a"')
        page.wait_for_text("#topics-definition", "string data")
    page.click("Pause")
    field, button = (page.one(css).rect for css in ("#topics-fields input", "#topics-send"))
    assert button["y"] - field["y"] - field["height"] > 5, "space between them"
    page.one("#topics-fields input").send_keys("b")
    with world.run("rostopic", "echo", "-n1", "/probe") as echo:
        wait_for(lambda: page.ask(cells)[3:4] == ["1"], "its subscriber")
        page.click("Publish")
        echo.wait()
        assert 'data: "b"' in echo.output
    assert "b" not in page.text("#topics-echo")
    page.one("#topics-rate").send_keys("20")
    with world.run("rostopic", "hz", "/probe") as hz:
        wait_for(lambda: page.ask(cells)[3:4] == ["1"], "its subscriber")
        rate = r"average rate: (1\d|2[01])\."
        line = wait_for(lambda: publishes(page) and re.search(rate, hz.output), "20 Hz")
        page.wait_for_text("#topics-about", "Publishers: /cockpit")
        page.tab("Log")
        wait_for(lambda: re.search(rate, hz.output[line.end() :]), "20 Hz beside another tab")
        line, (front, _) = len(hz.output), page.hide()
        wait_for(lambda: "no new messages" in hz.output[line:], "end while it is hidden")
        page.show(front)
    page.driver.get(f"{world.address}#topics/probe/rate?kind=parameters")
    ros("rosparam", "set", "/probe/rate", "[1, 2]")
    page.wait_for_text("#topics-rows", "/probe/rate")
    page.press("#topics-rows .link")
    page.wait_for_text("#topics-definition", "[1, 2]")
    page.one("#topics-fields input").clear()
    page.click("Set")
    page.wait_for_text("#notice", "write a value")
    page.one("#topics-fields input").send_keys("0.5")
    page.click("Set")
    assert page.text("#notice") == ""
    wait_for(lambda: ros("rosparam", "get", "/probe/rate") == "0.5\n", "value")
    ros("rosparam", "delete", "/probe")
    page.driver.get(f"{world.address}#topics/rosout/get_loggers?kind=services")
    page.wait_for_text("#topics-definition", "roscpp/Logger[] loggers")
    page.click("Call")
    page.wait_for_text("#topics-answer", "ros.rosout")


@claim(
    "By keyboard alone a driver publishes to topics that nobody has, several at once, with "
    "expressions, and stops each or all; a wrong field has its line beside it"
)
def test_new_topics_several_at_once_and_expressions_by_keyboard_alone(world, page):
    page.driver.get(f"{world.address}#topics")
    page.wait_for_text("#topics-rows", "/odom")
    page.one("#topics-measure").send_keys(Keys.TAB, Keys.ENTER)
    wait_for(lambda: page.all("#topics-types option"), "types")
    choose_new(page, "probe/number", "std_msgs/Float64")
    type_on(page, "sin(i / 10", Keys.TAB, Keys.TAB, "10", Keys.ENTER)
    page.wait_for_text("#topics-wrong", "data: float64 must be a number, or an expression")
    wrong = page.one("#topics-fields input")
    assert wrong.get_attribute("aria-describedby") == "topics-wrong"
    wrong.send_keys(")", Keys.ENTER)
    page.wait_for_text("#topics-echo", "data: 0.")
    assert not page.all("#topics-wrong, [aria-invalid]")
    wait_for(lambda: publishes(page), "a row to stop")
    page.one("#topics-stop-all").send_keys(Keys.ENTER)
    wait_for(lambda: not page.all(RUNNING) and page.text("#tab-topics") == "Topics", "end of all")
    assert page.ask("document.activeElement.id") == "topics-send"
    wait_for(lambda: publish_two(page), "two at once, and one after that")
    page.wait_for_text("#topics-echo", 'data: "sin(i)"')
    assert page.ask("document.activeElement.id") in ("topics-stop-all", "topics-send")


@claim("By keyboard alone ...", because="axe, in light and dark")
@pytest.mark.parametrize(("look", "width"), [("light", 360), ("dark", 1280)])
def test_axe_finds_nothing_while_a_page_publishes(world, page, look, width):
    features = [{"name": "prefers-color-scheme", "value": look}]
    page.send("Emulation.setEmulatedMedia", features=features)
    page.resize(width)
    page.open(f"{world.address}#topics/probe/number?type=std_msgs/Float64")
    wait_for(lambda: page.one("#topics-form").is_displayed(), "form")
    page.one("[name='data']").send_keys("i")
    page.one("#topics-rate").send_keys("1")
    wait_for(lambda: publishes(page), "a row")
    page.one("#topics-new summary").click()
    page.one("[name='data']").send_keys("+", Keys.ENTER)
    page.wait_for_text("#topics-wrong", "data: ")
    page.one("#topics-running").click()  # which scrolls it into view
    assert page.all(RUNNING) and violations(page) == []  # axe keeps the page silent
    assert page.ask("document.documentElement.scrollWidth") <= width
    page.resize()


@claim("What a page publishes ...", because="end to end, a killed page")
@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGSTOP])
def test_a_page_that_is_killed_or_hangs_publishes_a_zero_and_nothing_more(world, number):
    with Chromium() as page, world.run("rostopic", "echo", "-p", "/cmd_vel/linear/x") as echo:
        page.open(f"{world.address}#topics/cmd_vel")
        wait_for(lambda: page.all("[name='linear/x']"), "form")
        page.one("[name='linear/x']").send_keys("0.1")
        page.one("#topics-rate").send_keys(str(1 / PERIOD_S))
        is_heard = lambda: echo.output.endswith(",0.1\n") and world.moves  # noqa: E731
        wait_for(lambda: publishes(page) and is_heard(), "motion")
        late_s, lost_at = tolerance(), page.signal(number)
        world.wait_for_rest()
        bound_s = PERIOD_S + SILENCE_S + late_s()
        assert world.stays_at_rest()
        published_at, speed = map(float, echo.output.split()[-1].split(","))
        assert speed == 0.0 and published_at / 1e9 - lost_at < bound_s


@claim("What a page publishes ...", because="end to end, by Stop, Esc and hiding")
def test_what_a_form_moves_is_named_and_ends_by_stop_of_another_page_esc_and_hiding(world, page):
    mine, nobody = "You drive by a form, on /cmd_vel.", "Nobody drives."
    page.driver.get(f"{world.address}#topics/cmd_vel")
    wait_for(lambda: page.all("[name='linear/x']"), "form")
    page.one("[name='linear/x']").send_keys("0.1")
    page.one("#topics-rate").send_keys("20")
    with SocketPage(world.port) as other:
        drives = lambda: publishes(page) and page.text("#session") == mine and world.moves  # noqa: E731
        wait_for(drives, "motion")
        assert page.one("#stop").is_enabled()
        named = lambda said: said["who"].endswith("drives by a form, on /cmd_vel.")  # noqa: E731
        other.wait_for("drives", named)
        other.say("stop")
        page.wait_for_text("#session", nobody)
        page.wait_for_text("#notice", "pressed Stop")
        world.wait_for_rest()
        assert not page.all(RUNNING) and world.stays_at_rest()
        wait_for(drives, "motion")
        page.key("rawKeyDown", "Escape")
        page.wait_for_text("#session", nobody)
        world.wait_for_rest()
        assert not page.all(RUNNING) and world.stays_at_rest()
        page.one("#topics-rate").clear()
        page.press("#topics-send")  # once: without a timeout a robot drives on until it is stopped
        page.wait_for_text("#session", mine)
        page.tab("Log")
        driver = other.of("session")[-1]["driver"]
        front, _ = page.hide()
        wait_for(lambda: other.of("session")[-1]["driver"] is None, "end")
        page.show(front)
        assert driver
