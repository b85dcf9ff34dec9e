"""The picture of nodes and topics: Fit, zoom and Find; groups, keys, files, and what is hidden."""

import re
import subprocess

import pytest
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

from tutorial_testing.claims import claim
from tutorial_testing.cockpit.accessibility import violations
from tutorial_testing.waiting import wait_for

# A new GraphTab, to which this script sends a graph in place of the server.
GRAPH = """const [graph, done] = arguments, handlers = {};
document.getElementById("robot").hidden = true;
document.getElementById("graph").hidden = false;
import("/page/graph_tab.js").then(({GraphTab}) => {
  new GraphTab({on: (kind, handler) => (handlers[kind] = handler)}, () => {}, {moved() {}});
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


def room(robots):
    """Return the graph of a class: robots of the same nodes and topics, one joystick for all."""
    edges = []
    for n in range(1, robots + 1):
        way = [
            f"{kind} /robot_{n}/{name}"
            for kind, name in (
                ("topic", "joy"),
                ("node", "teleop"),
                ("topic", "cmd_vel"),
                ("node", "sim"),
            )
        ]
        edges += zip(["node /joy_node", *way], way)
    items = sorted({item for edge in edges for item in edge})
    named = lambda kind: [{"name": i.split()[1]} for i in items if i.startswith(kind)]  # noqa: E731
    edges = [{"from": one, "to": other} for one, other in edges]
    return {"nodes": named("node"), "topics": named("topic"), "edges": edges}


# What is drawn: [class, text or "", left, top, right, bottom] of each box and group.
DRAWN = """[...document.querySelectorAll("%s g:is(.node, .topic, .group)")].map((part) => {
  const {left, top, right, bottom} = part.firstElementChild.getBoundingClientRect();
  const text = part.querySelector("text");
  return [part.getAttribute("class").split(" ")[0], text.textContent, left, top, right, bottom];
})"""
FOCUSED = "document.activeElement.ariaLabel || document.activeElement.textContent"


def press(page, *keys):
    """Press keys, one after the other; return what has the focus then."""
    ActionChains(page.driver).send_keys(*keys).perform()
    return page.ask(FOCUSED)


@claim(
    "Tab Graph: groups of namespaces, boxes are one stop for Tab and arrows lead to the next one; "
    "a file in SVG, light and as it looks, and one in DOT, which dot draws"
)
def test_a_class_is_grouped_by_robot_walked_by_keys_and_saved(page, tmp_path):
    dark = [{"name": "prefers-color-scheme", "value": "dark"}]
    page.send("Emulation.setEmulatedMedia", features=dark)
    page.send("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(tmp_path))
    page.driver.execute_async_script(GRAPH, room(3))
    drawn = page.ask(DRAWN % "#graph")
    assert [text for kind, text, *_ in drawn if kind == "group"] == [
        f"/robot_{n}" for n in (1, 2, 3)
    ]
    for _, group, left, top, right, bottom in drawn[:3]:
        for kind, text, *box in drawn[3:]:
            inside = left < box[0] < box[2] < right and top < box[1] < box[3] < bottom
            assert inside == text.startswith(f"{group}/"), (group, kind, text)

    page.one("#graph-dot").send_keys(Keys.ENTER)
    assert press(page, Keys.TAB) == "Nodes and topics"
    assert press(page, Keys.TAB) == "node /joy_node"
    assert press(page, Keys.ARROW_RIGHT) == "topic /robot_1/joy"
    assert press(page, Keys.ARROW_DOWN, Keys.ARROW_RIGHT) == "node /robot_2/teleop"
    assert page.text("#graph-title") == ""
    press(page, Keys.ENTER)
    page.wait_for_text("#graph-title", "Node /robot_2/teleop")
    assert press(page, Keys.TAB) == "/robot_2/cmd_vel"  # the first button of its details
    ActionChains(page.driver).key_down(Keys.SHIFT).send_keys(Keys.TAB).key_up(Keys.SHIFT).perform()
    assert page.ask(FOCUSED) == "node /robot_2/teleop"

    page.one("#graph-svg").send_keys(Keys.ENTER)
    names = {text for _, text, *_ in drawn}
    dot = tmp_path / "graph.dot"
    wait_for(dot.exists, "DOT")
    done = subprocess.run(["dot", "-Tsvg", dot], check=True, capture_output=True, text=True)
    assert set(re.findall("<text.*?>(.*)</text>", done.stdout)) == names
    assert done.stdout.count('class="cluster"') == 3

    saved = tmp_path / "graph.svg"
    wait_for(saved.exists, "SVG")
    page.driver.get(saved.as_uri())
    again = page.ask(DRAWN % "svg")
    assert [part[:2] for part in again] == [part[:2] for part in drawn]
    scale = (again[3][4] - again[3][2]) / (drawn[3][4] - drawn[3][2])
    for before, now in zip(drawn, again):
        size = [(part[4] - part[2], part[5] - part[3]) for part in (before, now)]
        assert size[1] == pytest.approx([scale * side for side in size[0]], abs=1)
    style = "getComputedStyle(document.querySelector('%s')).fill"
    assert page.ask(style % "ellipse") == "rgb(255, 255, 255)", "light, though the page is dark"
    assert page.ask(style % "text") == "rgb(22, 32, 43)"
    assert page.ask(style % ".chosen ellipse") == "rgb(27, 106, 201)", "what is chosen stands out"


SUBSCRIBE = """import rospy
from std_msgs.msg import Empty
rospy.init_node("lonely", anonymous=True)
subscriber = rospy.Subscriber("/lonely", Empty)
rospy.spin()
"""


@claim("Tab Graph hides dead ends and debugging, as rqt_graph does; the address keeps that")
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_what_is_hidden_is_switched_by_keys_and_kept_by_the_address(world, shared_browser, scheme):
    page = shared_browser
    drawn = lambda: [text for _, text, *_ in page.ask(DRAWN % "#graph")]  # noqa: E731
    # A topic without a publisher, as other tests' publishers of /joy may not have exited yet.
    subscribe = ("/usr/bin/python3", "-c", SUBSCRIBE)
    with world.run(*subscribe), page.tab_of(360, 740, touch=True):
        features = [{"name": "prefers-color-scheme", "value": scheme}]
        page.send("Emulation.setEmulatedMedia", features=features)
        page.open(f"{world.address}#graph")
        wait_for(lambda: "/odom" in drawn(), "graph")
        assert "/tf" in drawn() and not {"/rosout", "/diagnostics", "/lonely"} & set(drawn())
        page.one("#graph-search").send_keys("")
        press(page, Keys.TAB, Keys.SPACE)
        wait_for(lambda: "/tf" not in drawn() and "/odom" in drawn(), "no dead sinks", seen=drawn)
        press(page, Keys.TAB, Keys.SPACE)
        wait_for(lambda: "/lonely" in drawn(), "dead sources", seen=drawn)
        press(page, Keys.TAB, Keys.SPACE)
        wait_for(lambda: {"/rosout"} < set(drawn()), "debugging", seen=drawn)
        assert page.driver.current_url == f"{world.address}#graph?switch=sinks,sources,debug"
        page.driver.refresh()
        wait_for(lambda: {"/rosout", "/lonely"} < set(drawn()), "the same", seen=drawn)
        assert "/tf" not in drawn()
        assert violations(page) == []
        assert page.ask("document.documentElement.scrollWidth") <= 360
