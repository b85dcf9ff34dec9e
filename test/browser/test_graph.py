"""The picture of nodes and topics: Fit, zoom and Find."""

import pytest
from selenium.webdriver.common.keys import Keys

from tutorial_testing.waiting import wait_for

# A Graph of its own, with a server that is this script: given topics, and hear() as in main.js.
GRAPH = """const [names, edges, done] = arguments, handlers = {};
document.getElementById("robot").hidden = true;
document.getElementById("graph").hidden = false;
import("/page/graph_tab.js").then(({GraphTab}) => {
  const link = {on: (kind, handler) => (handlers[kind] = handler)};
  new GraphTab(link, () => {});
  const of = (kind) => names.map((one) => one.split(" ")).filter((one) => one[0] === kind)
    .map(([, name]) => ({name}));
  handlers.graph({nodes: of("node"), topics: of("topic"), edges});
  requestAnimationFrame(() => done());
});"""
# Of the picture, and of the room for it.
SIZES = """(() => {
  const room = document.getElementById("graph-picture");
  const {width, height} = room.querySelector("svg").getBoundingClientRect();
  return [width, height, room.clientWidth, room.clientHeight];
})()"""


def graph(count):
    """Nodes, and topics of names of many lengths; some arrows pass layers."""
    topics = [f"topic /robot_{n}/{'long_' * (n % 7)}topic" for n in range(count)]
    nodes = [f"node /node_{n}" for n in range(6)]
    edges = [{"from": nodes[n % 4], "to": topic} for n, topic in enumerate(topics)]
    edges += [{"from": t, "to": nodes[4 + n % 2]} for n, t in enumerate(topics) if n % 3 == 0]
    return [*nodes, *topics], [*edges, {"from": nodes[0], "to": topics[0]}]


def test_large_graph_fits_and_is_zoomed_and_what_is_found_is_in_sight(page):
    page.driver.execute_async_script(GRAPH, *graph(61))
    page.click("Fit")
    page.press("#graph .topic")  # with which the picture gets less room

    def fitting():
        wide, high, most_wide, most_high = page.ask(SIZES)
        return wide <= most_wide and high <= most_high

    wait_for(fitting, "the whole picture")
    page.click("Zoom in")
    once = page.ask(SIZES)[0]
    page.click("Zoom in")
    assert page.ask(SIZES)[0] == pytest.approx(1.25 * once, rel=0.01)
    page.one("#graph-search").send_keys("robot_51/")
    page.wait_for_text("#graph-found", f"1 of {61 + 6}")
    page.one("#graph-search").send_keys(Keys.ENTER)
    page.wait_for_text("#graph-title", "Topic /robot_51/")
    box, around = (
        page.ask(f"document.querySelector('{css}').getBoundingClientRect().toJSON()")
        for css in ("#graph .topic.chosen", "#graph-picture")
    )
    assert around["left"] <= box["left"] and box["right"] <= around["right"]
    assert around["top"] <= box["top"] and box["bottom"] <= around["bottom"]
    assert box["height"] > 20  # it is large enough to be read
