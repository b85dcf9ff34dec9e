"""The picture of nodes and topics: its size, arrows, their heads, Fit, zoom and Find."""

import pytest
from selenium.webdriver.common.keys import Keys

from tutorial_testing.cockpit.pixels import LEAST_CONTRAST, SCHEMES, colour, contrast, dress, seen
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
# Arrows whose head points away, and points of arrows that lie in a box at neither end of theirs.
BACKWARDS = """[...document.querySelectorAll("#graph .arrow")].filter((arrow) => {
  const end = arrow.getTotalLength(), x = (back) => arrow.getPointAtLength(end - back).x;
  return x(0) < x(6);
}).length"""
BEHIND = """[...document.querySelectorAll("#graph .arrow")].flatMap((arrow) => {
  const {from, to} = arrow.dataset, length = arrow.getTotalLength();
  const others = [...document.querySelectorAll("#graph [data-item]")]
    .filter((box) => ![from, to].includes(box.dataset.item)).map((box) => box.firstChild.getBBox());
  const points = Array.from({length: length / 4}, (_, i) => arrow.getPointAtLength(4 * i));
  return points.filter(({x, y}) => others.some((box) => x > box.x + 1 && x < box.x + box.width - 1
    && y > box.y + 1 && y < box.y + box.height - 1));
}).length"""
SIZES = """(() => {
  const picture = document.getElementById("graph-picture"), svg = picture.querySelector("svg");
  const {width, height} = svg.getBoundingClientRect();
  return [svg.viewBox.baseVal.width, svg.viewBox.baseVal.height, width, height,
          picture.clientWidth, picture.clientHeight];
})()"""


def graph(count):
    """Nodes and topics of names of many lengths; some arrows pass layers."""
    topics = [f"topic /robot_{n}/{'long_' * (n % 7)}topic" for n in range(count)]
    nodes = [f"node /node_{n}" for n in range(6)]
    edges = [{"from": nodes[n % 4], "to": topic} for n, topic in enumerate(topics)]
    edges += [{"from": t, "to": nodes[4 + n % 2]} for n, t in enumerate(topics) if n % 3 == 0]
    return [*nodes, *topics], [*edges, {"from": nodes[0], "to": topics[0]}]


@pytest.mark.parametrize(("count", "most"), [(61, 2000), (2000, 10_000)])
def test_a_large_graph_is_about_as_wide_as_high_and_fits(page, count, most):
    page.driver.execute_async_script(GRAPH, *graph(count))
    width, height, *_ = page.ask(SIZES)
    assert max(width, height) < most
    if count < 100:
        assert (page.ask(BACKWARDS), page.ask(BEHIND)) == (0, 0)
    page.click("Fit")
    page.press("#graph .topic")  # with which the picture gets less room

    def fitting():
        _, _, *shown, wide, high = page.ask(SIZES)
        return shown[0] <= wide and shown[1] <= high

    wait_for(fitting, "the whole picture")
    page.click("Zoom in")
    once = page.ask(SIZES)[2]
    page.click("Zoom in")
    assert page.ask(SIZES)[2] == pytest.approx(1.25 * once, rel=0.01)
    page.one("#graph-search").send_keys("robot_51/")
    page.wait_for_text("#graph-found", f"1 of {count + 6}")
    page.one("#graph-search").send_keys(Keys.ENTER)
    page.wait_for_text("#graph-title", "Topic /robot_51/")
    box, picture = (
        page.ask(f"document.querySelector('{css}').getBoundingClientRect().toJSON()")
        for css in ("#graph .topic.chosen", "#graph-picture")
    )
    assert picture["left"] <= box["left"] and box["right"] <= picture["right"]
    assert picture["top"] <= box["top"] and box["bottom"] <= picture["bottom"]
    assert box["height"] > 20  # it is large enough to be read
    assert "graph-details" not in page.ask(
        "[...document.querySelectorAll('[aria-live]')].map((one) => one.id)"
    )


@pytest.mark.parametrize("scheme", SCHEMES)
def test_arrows_stand_out_and_their_heads_are_chosen_with_them(page, scheme):
    def drawn(css, back):
        """The colour of an arrow so many units before its end: of its head, or of its line."""
        x, y = page.ask(f"""(() => {{
          const arrow = document.querySelector('{css}');
          const {{x, y}} = arrow.getPointAtLength(arrow.getTotalLength() - {back});
          const at = new DOMPoint(x, y).matrixTransform(arrow.getScreenCTM());
          return [at.x, at.y];
        }})()""")
        pixels, _ = seen(page)
        around = [pixels[int(x) + dx, int(y) + dy] for dx in (-1, 0, 1) for dy in (-1, 0, 1)]
        return max(around, key=lambda one: contrast(one, colour(page, "--floor")))

    dress(page, scheme)
    page.driver.execute_async_script(GRAPH, *graph(3))
    for back in (4, 20):
        shown = drawn("#graph .arrow", back)
        assert contrast(shown, colour(page, "--floor")) >= LEAST_CONTRAST
    page.one("#graph [data-item='node /node_0']").click()
    for back in (4, 20):
        shown, accent = drawn("#graph .arrow.chosen", back), colour(page, "--accent")
        assert max(abs(a - b) for a, b in zip(shown, accent)) < 60, back
    dress(page)
