"""The tab Robot beside another one: both as they are drawn, by keyboard alone, kept in the link."""

import pytest
from selenium.webdriver.common.keys import Keys as Key

from tutorial_testing.claims import claim
from tutorial_testing.cockpit.accessibility import violations
from tutorial_testing.cockpit.hands import Keys
from tutorial_testing.waiting import wait_for

pytestmark = claim(
    "Robot beside another tab from 1,200 pixels on: both are live, arrow keys drive, the link "
    "keeps it, axe finds nothing"
)
# [id, left, right, bottom] of the panels in sight.
PANELS = """[...document.querySelectorAll("main > section")]
  .filter((panel) => panel.checkVisibility())
  .map((panel) => [panel, panel.getBoundingClientRect()])
  .map(([{id}, {left, right, bottom}]) => [id, left, right, bottom])"""
# Where the pixels of the chosen robot are on the floor: the mean of x.
ROBOT_X = """(() => {
  const canvas = document.getElementById("floor"), {width, height} = canvas, xs = [];
  const pen = new OffscreenCanvas(width, height).getContext("2d", {willReadFrequently: true});
  pen.drawImage(canvas, 0, 0);
  const {data} = pen.getImageData(0, 0, width, height);
  for (let i = 0; i < data.length; i += 4) {
    if ([27, 106, 201].every((part, at) => data[i + at] === part)) xs.push((i / 4) % width);
  }
  return xs.reduce((sum, x) => sum + x, 0) / xs.length;
})()"""
# Widths of what reaches from side to side, and the tops of the buttons on the floor.
WIDE = """[document.documentElement.scrollWidth, document.body.scrollWidth,
  ...["header", "#notice"].map((css) => document.querySelector(css).offsetWidth)]"""
BUTTONS = "[...document.querySelectorAll('.toolbar button')].map((button) => button.offsetTop)"
# What a line of a name in the list ends with, where another line follows.
LINE_ENDS = """[...document.querySelectorAll("#topics-rows button")].flatMap((name) => {
  const ends = [], walker = document.createTreeWalker(name, NodeFilter.SHOW_TEXT);
  const range = document.createRange();
  let last = null;
  while (walker.nextNode()) [...walker.currentNode.data].forEach((letter, i) => {
    range.setStart(walker.currentNode, i);
    range.setEnd(walker.currentNode, i + 1);
    const {top} = range.getBoundingClientRect();
    if (last && top > last.top + 5) ends.push(last.letter);
    last = {top, letter};
  });
  return ends;
})"""
SELECTED = "[...document.querySelectorAll('[aria-selected=true]')].map((tab) => tab.textContent)"


@pytest.fixture
def wide(page):
    page.send("Emulation.setEmulatedMedia", features=[])
    yield page
    page.resize()


def in_sight(page):
    return [name for name, *_ in page.ask(PANELS)]


def test_both_are_in_sight_and_live_and_the_link_keeps_it(world, wide):
    page = wide
    page.driver.get(f"{world.address}#topics/odom")
    page.wait_for_text("#topics-echo", "---")
    assert in_sight(page) == ["topics"], "an old link shows one tab"
    page.driver.execute_script("document.getElementById('tab-topics').focus()")
    for key in (Key.TAB, Key.ENTER):
        for kind in ("keyDown", "keyUp"):
            page.keys(kind, key)
    (left, _, middle, bottom), (right, begin, end, _) = page.ask(PANELS)
    assert (left, right) == ("robot", "topics")
    assert 0 < middle <= begin < end <= 1280 and bottom <= 800
    assert page.ask(SELECTED) == ["Topics"]
    assert page.driver.current_url.endswith("/?beside=robot#topics/odom")
    page.driver.refresh()
    wait_for(lambda: page.all("#topics-echo"), "page")
    page.wait_for_text("#topics-echo", "---")
    assert in_sight(page) == ["robot", "topics"]
    ends = page.ask(LINE_ENDS)
    assert ends and set(ends) <= {"/", "_"}, "a line breaks after these"
    page.click("Drive from this page")
    page.wait_for_text("#session", "You drive")
    page.click("Follow")
    begin = wait_for(lambda: page.ask(ROBOT_X), "robot on the floor")
    Keys(page).drive(world, until=lambda: page.ask(ROBOT_X) > begin + 10)
    seen = page.text("#topics-echo")
    wait_for(lambda: page.text("#topics-echo") != seen, "messages while it drives")
    page.click("Stop")
    world.wait_for_rest()


def test_a_narrow_window_shows_the_chosen_tab_alone_and_a_wider_one_both_again(world, wide):
    page = wide
    page.driver.get(f"{world.address}?beside=robot#log")
    wait_for(lambda: in_sight(page) == ["robot", "log"], "both")
    page.resize(1199, 800)
    wait_for(lambda: in_sight(page) == ["log"], "one tab")
    assert not page.one("#beside").is_displayed()
    page.resize(1200, 800)
    wait_for(lambda: in_sight(page) == ["robot", "log"], "both")
    page.tab("Robot")
    assert in_sight(page) == ["robot"]
    page.click("Robot beside")
    assert in_sight(page) == ["robot", "log"], "the tab before comes back"
    page.click("Robot beside")
    assert in_sight(page) == ["log"]
    assert page.driver.current_url.endswith("/#log")
    page.driver.back()
    wait_for(lambda: in_sight(page) == ["robot", "log"], "both, by Back")


@pytest.mark.parametrize(("scheme", "size"), [("light", (1280, 800)), ("dark", (1920, 1080))])
def test_no_pair_of_tabs_has_a_fault_or_leaves_the_window(world, wide, scheme, size):
    page = wide
    page.send(
        "Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}]
    )
    page.resize(*size)
    page.driver.get(f"{world.address}?beside=robot#topics")
    page.wait_for_text("#me", "page")
    names = page.ask("[...document.querySelectorAll('[role=tabpanel]')].map((e) => e.id)")
    for name in names[1:]:
        page.press(f"#tab-{name}")
        assert in_sight(page) == ["robot", name]
        assert max(right for _, _, right, _ in page.ask(PANELS)) <= size[0], name
        assert violations(page) == [], name
        page.ask("document.getElementById('notice').textContent = 'A line for a person.'")
        assert page.ask(WIDE) == [size[0]] * 4, name
        assert len(set(page.ask(BUTTONS))) == 1, "one line"
