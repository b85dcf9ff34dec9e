"""The picture of nodes and topics: Fit, zoom and Find."""

import pytest
from selenium.webdriver.common.keys import Keys

from tutorial_testing.claims import claim
from tutorial_testing.waiting import wait_for

# A new GraphTab, to which this script sends a graph in place of the server.
GRAPH = """const [graph, done] = arguments, handlers = {};
document.getElementById("robot").hidden = true;
document.getElementById("graph").hidden = false;
import("/page/graph_tab.js").then(({GraphTab}) => {
  new GraphTab({on: (kind, handler) => (handlers[kind] = handler)}, () => {});
  handlers.graph(graph);
  requestAnimationFrame(() => done());
});"""
# The sizes of the picture and of the room for it.
SIZES = """(() => {
  const room = document.getElementById("graph-picture");
  const {width, height} = room.querySelector("svg").getBoundingClientRect();
  return [width, height, room.clientWidth, room.clientHeight];
})()"""
# Topics have names of many lengths; some arrows skip layers.
NODES = [f"/node_{n}" for n in range(6)]
TOPICS = [f"/robot_{n}/{'long_' * (n % 7)}topic" for n in range(61)]
EDGES = [(f"node {NODES[n % 4]}", f"topic {name}") for n, name in enumerate(TOPICS)]
EDGES += [(f"topic {name}", f"node {NODES[4 + n % 2]}") for n, name in enumerate(TOPICS[::3])]
LARGE = {
    "nodes": [{"name": name} for name in NODES],
    "topics": [{"name": name} for name in TOPICS],
    "edges": [{"from": one, "to": other} for one, other in EDGES],
}


@claim("Tab Graph: nodes, topics; Fit, zoom and Find")
def test_large_graph_fits_and_is_zoomed_and_what_is_found_is_in_sight(page):
    page.driver.execute_async_script(GRAPH, LARGE)
    page.click("Fit")
    page.press("#graph .topic")  # its details leave less room for the picture

    def fitting():
        wide, high, most_wide, most_high = page.ask(SIZES)
        return wide <= most_wide and high <= most_high

    wait_for(fitting, "the whole picture")
    page.click("Zoom in")
    once = page.ask(SIZES)[0]
    page.click("Zoom in")
    assert page.ask(SIZES)[0] == pytest.approx(1.25 * once, rel=0.01)
    page.one("#graph-search").send_keys("robot_51/")
    page.wait_for_text("#graph-found", "1 of 67")
    page.one("#graph-search").send_keys(Keys.ENTER)
    page.wait_for_text("#graph-title", "Topic /robot_51/")
    box, around = (
        page.ask(f"document.querySelector('{css}').getBoundingClientRect().toJSON()")
        for css in ("#graph .topic.chosen", "#graph-picture")
    )
    assert around["left"] <= box["left"] and box["right"] <= around["right"]
    assert around["top"] <= box["top"] and box["bottom"] <= around["bottom"]
    assert box["height"] > 20  # it is large enough to be read
