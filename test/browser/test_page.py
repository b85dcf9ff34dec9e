"""The page itself: small, from this host alone, for keyboards and phones, honest about a loss."""

import signal
from urllib.parse import urlsplit

import pytest

from tutorial_testing.cockpit import world as worlds
from tutorial_testing.cockpit.chromium import LONG_S, Chromium
from tutorial_testing.cockpit.hands import Thumbs
from tutorial_testing.waiting import wait_for

TABS = ("Robot", "Graph", "Bag", "Plot", "Log", "Doctor")
FIRST_LOAD = 200_000  # bytes
PHONES = {"upright": (360, 640), "on its side": (640, 360)}
LEAST_TOUCH = 44  # pixel, of what a thumb holds; WCAG 2.5.5


def test_it_asks_no_other_host_and_complains_of_nothing(world, browser):
    browser.open(world.address)
    for name in TABS:
        browser.tab(name)
        assert browser.by_role("tab", name).get_attribute("aria-selected") == "true"
    host = urlsplit(world.address).netloc
    asked = [urlsplit(url) for url in browser.requests()]
    asked = [url.netloc for url in asked if url.scheme in ("http", "https", "ws", "wss")]
    assert len(asked) > 10
    assert set(asked) == {host}
    assert browser.errors() == []


def test_the_first_load_is_small(world, browser):
    browser.open(world.address)
    script = """return performance.getEntries().filter((e) => 'transferSize' in e)
        .reduce((sum, e) => sum + e.transferSize, 0)"""
    assert 10_000 < browser.driver.execute_script(script) < FIRST_LOAD


def test_the_keyboard_alone_reaches_everything(page):
    focused = "return document.activeElement.id || document.activeElement.textContent.trim()"
    page.driver.execute_script("document.activeElement.blur()")
    reached = []
    for _ in range(40):
        page.key("rawKeyDown", "Tab")
        page.key("keyUp", "Tab")
        reached.append(page.driver.execute_script(focused))
        if len(reached) > 1 and reached[-1] == reached[0]:
            break
    wanted = page.driver.execute_script(
        "return [...document.querySelectorAll('#robot button:enabled, #robot select:enabled')]"
        ".filter((e) => e.checkVisibility()).map((e) => e.id)"
    )
    assert set(wanted) <= set(reached)
    assert "take" in wanted
    # Tabs are one stop; arrows go from one to the next.
    page.by_role("tab", "Robot").click()
    for name in (*TABS[1:], TABS[0]):
        page.key("rawKeyDown", "ArrowRight")
        page.key("keyUp", "ArrowRight")
        assert page.by_role("tab", name).get_attribute("aria-selected") == "true"


@pytest.mark.parametrize("held", PHONES)
def test_a_phone_has_all_of_it(world, held):
    width, height = PHONES[held]
    with Chromium(width, height, touch=True) as phone:
        phone.open(world.address)
        for name in TABS:
            phone.tab(name)
            wide = phone.ask("document.documentElement.scrollWidth")
            assert wide <= width, name
        phone.tab("Robot")
        phone.click("Drive from this page")
        phone.wait_for_text("#seat", "You drive")
        for css in ("#lb", "#stick"):
            box = phone.one(css).rect
            assert min(box["width"], box["height"]) >= LEAST_TOUCH
            assert 0 <= box["x"] <= width - box["width"]
            assert 0 <= box["y"] <= height - box["height"]
        # A double tap zooms nowhere.
        actions = (
            "[...document.body.querySelectorAll('*')].map((e) => getComputedStyle(e).touchAction)"
        )
        assert "auto" not in phone.ask(actions)


# Where the robot that is looked at is drawn: the middle of the square with most of its colour, as a
# place on the page [pixel], how much of the square has it, and what lies there on top.
DRAWN = """(() => {
  const canvas = document.getElementById("floor"), box = canvas.getBoundingClientRect(), side = 24;
  const {width, height} = canvas;
  const {data} = canvas.getContext("2d").getImageData(0, 0, width, height);
  const pen = document.createElement("canvas").getContext("2d");
  pen.fillStyle = getComputedStyle(canvas).getPropertyValue("--accent").trim();
  pen.fillRect(0, 0, 1, 1);
  const [red, green, blue] = pen.getImageData(0, 0, 1, 1).data;
  const has = (x, y, i = 4 * (y * width + x)) =>
    data[i] === red && data[i + 1] === green && data[i + 2] === blue;
  let best = [0, 0, 0];
  for (let top = 0; top < height - side; top += 3) {
    for (let left = 0; left < width - side; left += 3) {
      let count = 0;
      for (let i = 0; i < side ** 2; i += 5) {
        count += has(left + (i % side), top + Math.floor(i / side));
      }
      if (count > best[0]) best = [count, left, top];
    }
  }
  const [x, y] = [box.left + best[1] + side / 2, box.top + best[2] + side / 2];
  return [x, y, (5 * best[0]) / side ** 2, document.elementFromPoint(x, y)?.id ?? "", box.height];
})()"""


@pytest.mark.parametrize("held", PHONES)
def test_the_driven_one_of_two_robots_is_seen_beside_the_buttons(held):
    width, height = PHONES[held]
    two = str(worlds.HERE / "two_robots.launch")
    with worlds.World(two) as world, Chromium(width, height, touch=True) as phone:
        phone.open(world.address)
        wait_for(lambda: len(phone.all("#robots tr")) == 2, "two robots", LONG_S)
        hands = Thumbs(phone)
        hands.drive(world, until=lambda: world.now.x > 1.0)  # where the other one is far away
        hands.release()
        world.wait_for_rest()
        x, y, share, on_top, floor_height = phone.ask(DRAWN)
        assert share > 0.4
        assert on_top == "floor"
        assert 0 <= x <= width and 0 <= y <= height
        assert floor_height >= 250
        stop = phone.by_role("button", "Stop driving").rect
        assert 0 <= stop["y"] <= height - stop["height"]


# A page of its own, which a server of the test speaks to: hear(); sent is what it was asked for.
ROBOT_TAB = """const [names, done] = arguments, handlers = {}, sent = [];
const link = {isOpen: true, send(...said) { sent.push(said); },
              on(kind, handler) { handlers[kind] = handler; }};
const hear = (kind, message) => handlers[kind]({kind, ...message});
const look = document.getElementById("look"), pad = {D: {buttons: []}, X: {buttons: []}};
const hello = (robots) => hear("hello", {id: 1, role: "driver", robots, pad});
const choose = (name) => { look.value = name; look.dispatchEvent(new Event("change")); };
const options = () => [...look.options].map((one) => one.text);
const drive = () => { take.click(); return sent.at(-1)[1].robot; };
const take = document.getElementById("take").cloneNode();
document.getElementById("take").replaceWith(take);
document.getElementById("robots").replaceChildren();
import('/page/robot_tab.js').then(({RobotTab}) => {
  const tab = new RobotTab(link, (fields) => sent.push(["watch", fields]),
                           {notice: () => {}});
  take.disabled = false;
  %s
})"""


@pytest.mark.parametrize("robots", [[""], ["robot_1", "robot_2"]])
def test_a_server_that_begins_anew_may_know_the_robots_later(page, robots):
    script = """const begin = () => {
      hello([]);
      hear("names", {names: []});
      hear("names", {names});
    };
    begin();
    choose(names.at(-1));
    begin();
    done([look.options.length, look.value, tab.look]);"""
    shown = page.driver.execute_async_script(ROBOT_TAB % script, robots)
    assert shown == [len(robots), robots[-1], robots[-1]]


def test_the_chosen_robot_stays_chosen_while_it_is_gone(page):
    script = """hello(names);
    choose("robot_2");
    hear("names", {names: ["robot_1"]});
    hear("robots", {robots: {robot_1: {}}});
    const gone = [options(), look.value, drive()];
    hear("names", {names});
    done([gone, [options(), look.value, drive()]]);"""
    robots = ["robot_1", "robot_2"]
    gone, back = page.driver.execute_async_script(ROBOT_TAB % script, robots)
    assert gone == [["robot_1", "robot_2 (gone)"], "robot_2", "robot_2"]
    assert back == [robots, "robot_2", "robot_2"]


def test_a_row_of_the_table_outlives_its_news(page):
    script = """hello(names);
    const news = (x) => hear("robots", {robots: {robot_1: {x, y: 0}, robot_2: {x, y: 1}}});
    const row = () => document.querySelector("#robots [data-robot=robot_2]");
    news(1);
    const pressed = row();
    news(2);
    const same = [row() === pressed, pressed.cells[1].textContent];
    pressed.click();
    const hidden = [document.getElementById("class").hidden];
    hear("names", {names: ["robot_2"]});
    hidden.push(document.getElementById("class").hidden);
    done([same, tab.look, hidden]);"""
    same, look, hidden = page.driver.execute_async_script(
        ROBOT_TAB % script, ["robot_1", "robot_2"]
    )
    assert (same, look, hidden) == ([True, "2.00, 1.00"], "robot_2", [False, True])


def test_who_is_handed_a_robot_looks_at_it_and_at_no_other(page):
    script = """hello(names);
    const seat = {driver: 1, name: "x", robot: "robot_2", how: "page", armed: false, why: ""};
    hear("seat", {...seat, yours: false});
    const before = tab.look;
    hear("seat", {...seat, yours: true});
    const watched = sent.filter(([kind]) => kind === "watch").at(-1)[1];
    hear("robots", {robots: {robot_1: {}, robot_2: {}}});
    document.querySelector("#robots [data-robot=robot_1]").click();
    const driving = [tab.look, tab.floor.look, watched.look];
    tab.driver.stop();
    hear("seat", {...seat, driver: null, yours: false});
    hear("robots", {robots: {robot_1: {}, robot_2: {}}});
    document.querySelector("#robots [data-robot=robot_1]").click();
    done([before, driving, tab.look]);"""
    before, driving, after = page.driver.execute_async_script(
        ROBOT_TAB % script, ["robot_1", "robot_2"]
    )
    assert (before, driving, after) == ("robot_1", ["robot_2"] * 3, "robot_1")


@pytest.mark.parametrize("place", [{}, {"x": 1e17, "y": 1e17, "yaw": 0}])
def test_the_floor_is_drawn_whatever_a_robot_says(page, place):
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


def test_a_server_that_hangs_for_a_while_leaves_the_seat_to_who_has_it(world, page):
    page.click("Drive from this page")
    page.wait_for_text("#seat", "You drive")
    number = page.text("#me")
    world.signal_cockpit(signal.SIGSTOP)
    try:
        page.wait_for_text("#connection", "lost")
        assert not page.by_role("button", "Drive from this page").is_enabled()
    finally:
        world.signal_cockpit(signal.SIGCONT)
    page.wait_for_text("#connection", "Connected")
    page.wait_for_text("#seat", "You drive")
    assert page.text("#me") == number
    page.click("Stop driving")
    page.wait_for_text("#seat", "Nobody drives")


def test_a_lost_server_is_told_at_once_and_the_page_returns_by_itself(own_world, browser):
    browser.open(own_world.address)
    browser.click("Drive from this page")
    browser.wait_for_text("#seat", "You drive")
    own_world.kill_cockpit()
    wait_for(lambda: "lost" in browser.text("#connection"), "word of the loss", 5)
    browser.wait_for_text("#notice", "Start it again")  # after some attempts
    own_world.start_cockpit()
    wait_for(lambda: not browser.one("#notice").is_displayed(), "end of that notice", LONG_S)
    browser.wait_for_text("#connection", "Connected")
    browser.wait_for_text("#seat", "Nobody drives")


@pytest.mark.parametrize(
    ("event", "held", "left"),
    [
        ("new PointerEvent('pointermove', {shiftKey: true})", ["LB"], [0, 1]),
        ("new PointerEvent('pointermove', {shiftKey: false})", [], [0, 1]),
        ("new KeyboardEvent('keyup', {code: 'ShiftLeft', shiftKey: true})", [], [0, 1]),
        ("new KeyboardEvent('keydown', {code: 'MetaLeft', metaKey: true})", [], [0, 0]),
    ],
)
def test_keys_are_let_go_of_as_any_event_tells(page, event, held, left):
    script = """const done = arguments[0];
    import('/page/keys.js').then(({Keys}) => {
      const keys = new Keys(() => true, () => {});
      for (const code of ["ShiftLeft", "ShiftRight", "KeyW"]) {
        dispatchEvent(new KeyboardEvent("keydown", {code, shiftKey: true}));
      }
      dispatchEvent(%s);
      done([keys.hands.held, keys.hands.left]);
    })"""
    assert page.driver.execute_async_script(script % event) == [held, left]
