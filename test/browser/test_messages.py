"""What the tabs make of rare messages: the test is their server."""

import pytest

from tutorial_testing.cockpit.one_tab import LONG_PLOT, run
from tutorial_testing.waiting import wait_for

ROBOT_TAB = """const look = byId("look"), take = byId("take").cloneNode(), pad = {D: {}, X: {}};
byId("take").replaceWith(take);
byId("robots").replaceChildren();
const hello = (robots) => hear("hello", {id: 1, role: "driver", robots, pad});
const options = () => [...look.options].map((one) => one.text);
const choose = (name) => { look.value = name; look.dispatchEvent(new Event("change")); };
const drive = () => { take.click(); return sent.at(-1)[1].robot; };
const rowOf = (name) => document.querySelector(`#robots [data-robot=${name}]`);
const tab = new tabs.RobotTab(link, watch, {notice: () => {}});
take.disabled = false;
"""
TWO = ["robot_1", "robot_2"]


def run_robot_tab(page, script, robots=TWO):
    return run(page, "robot_tab.js", ROBOT_TAB + script, robots)


@pytest.mark.parametrize("robots", [[""], TWO])
def test_a_server_that_starts_again_may_know_the_robots_later(page, robots):
    script = """const begin = () => {
      hello([]);
      hear("names", {names: []});
      hear("names", {names: given});
    };
    begin();
    choose(given.at(-1));
    begin();
    done([look.options.length, look.value, tab.look]);"""
    assert run_robot_tab(page, script, robots) == [len(robots), robots[-1], robots[-1]]


def test_the_chosen_robot_stays_chosen_while_it_is_gone(page):
    script = """hello(given);
    choose("robot_2");
    hear("names", {names: ["robot_1"]});
    hear("robots", {robots: {robot_1: {}}});
    const gone = [options(), look.value, drive()];
    hear("names", {names: given});
    done([gone, [options(), look.value, drive()]]);"""
    gone, back = run_robot_tab(page, script)
    assert gone == [["robot_1", "robot_2 (gone)"], "robot_2", "robot_2"]
    assert back == [TWO, "robot_2", "robot_2"]


def test_a_row_of_the_table_stays_while_its_numbers_change(page):
    script = """hello(given);
    const move = (x) => hear("robots", {robots: {robot_1: {x, y: 0}, robot_2: {x, y: 1}}});
    move(1);
    const pressed = rowOf("robot_2");
    move(2);
    const same = [rowOf("robot_2") === pressed, pressed.cells[1].textContent];
    pressed.click();
    const hidden = [byId("class").hidden];
    hear("names", {names: ["robot_2"]});
    done([same, tab.look, [...hidden, byId("class").hidden]]);"""
    assert run_robot_tab(page, script) == [[True, "2.00, 1.00"], "robot_2", [False, True]]


def test_a_driver_who_is_handed_a_robot_looks_at_no_other(page):
    script = """hello(given);
    const seat = {driver: 1, name: "x", robot: "robot_2", how: "page", armed: false, why: ""};
    hear("seat", {...seat, yours: false});
    const before = tab.look;
    hear("seat", {...seat, yours: true});
    const watched = sent.filter(([kind]) => kind === "watch").at(-1)[1];
    hear("robots", {robots: {robot_1: {}, robot_2: {}}});
    rowOf("robot_1").click();
    const driving = [tab.look, tab.floor.look, watched.look];
    hear("seat", {...seat, driver: null, yours: false});
    rowOf("robot_1").click();
    done([before, driving, tab.look]);"""
    assert run_robot_tab(page, script) == ["robot_1", ["robot_2"] * 3, "robot_1"]


def test_a_new_connection_opens_the_recording_again_and_publishes_nothing(page):
    script = """const tab = new tabs.BagTab(link, watch, {look: () => ""});
    const state = () => byId("bag-state").textContent;
    hear("hello", {});
    const before = sent.length;
    hear("bags", {names: ["joy.bag", "other.bag"]});
    byId("bag-name").value = "other.bag";
    byId("bag-open").click();
    const opened = sent.at(-1)[1].name;
    hear("bag", {path: "joy.bag", start: 0, end: 2, curves: {},
                 topics: [{name: "/joy", type: "sensor_msgs/Joy", count: 1}]});
    hear("bag_at", {position: 1, playing: true, topic: "/joy"});
    const playing = state();
    hear("hello", {});
    done([before, opened, playing, sent.at(-1), state(), byId("bag-pause").disabled]);"""
    before, opened, playing, asked, state, pause = run(page, "bag_tab.js", script, TWO)
    assert (before, opened, "Publishing /joy" in playing) == (0, "other.bag", True)
    assert (asked, state, pause) == (["bag_open", {"name": "joy.bag"}], "", True)


def test_a_new_connection_asks_the_doctor_again_only_while_its_tab_is_shown(page):
    script = """const tab = new tabs.DoctorTab(link), counts = [], button = byId("doctor-run");
    const count = () => counts.push(sent.length);
    hear("hello", {});
    count();
    tab.show(true);
    count();
    hear("doctor", {lines: [], running: true});
    const running = button.disabled;
    hear("hello", {});
    count();
    const returned = button.disabled;
    tab.show(false);
    hear("hello", {});
    count();
    done([...counts, running, returned]);"""
    assert run(page, "doctor_tab.js", script, TWO) == [0, 1, 2, 2, True, False]


def test_the_log_stays_where_its_tab_is_chosen_again(page):
    script = """const tab = new tabs.LogTab(link, watch), counts = [];
    const log = (times) => hear("log", {entries: Array(times).fill(
      {time: 0, level: "WARN", node: "/x", text: "a"})});
    const count = () => counts.push(byId("log-lines").childElementCount);
    tab.show(true);
    log(1);
    tab.show(true);
    count();
    tab.show(false);
    tab.show(true);
    count();
    log(1);
    hear("hello", {});
    count();
    log(900);
    log(900);
    tab.show(false);
    tab.show(true);
    count();
    done(counts);"""
    assert run(page, "log_tab.js", script, TWO) == [1, 1, 0, 1000]


def test_a_line_of_its_own_level_and_one_of_a_long_name_are_shown(page):
    script = """byId("tab-log").click();
    byId("log-lines").replaceChildren();
    const tab = new tabs.LogTab(link, watch);
    byId("log-level").value = "FATAL";
    const line = (level, node) => ({time: 0, level, node, text: "a text of the usual length"});
    hear("log", {entries: [line("WARN", "/x"), line("3", "/x"), line("0", "/n".repeat(150))]});
    const lines = [...byId("log-lines").rows];
    const texts = lines.map((one) => one.cells[3].getBoundingClientRect());
    const wide = byId("log-scroll").scrollWidth - byId("log-scroll").clientWidth;
    done([lines.map((one) => one.dataset.level), texts.map(({width}) => width),
          texts.map(({right}) => right), wide, byId("log-count").textContent]);"""
    for size in ((360, 640), (1280, 800)):  # the last one is that of the other tests
        page.resize(*size)
        levels, widths, rights, overflow, count = run(page, "log_tab.js", script, TWO)
        assert (levels, count, overflow) == (["3", "0"], "2 of 3", 0)
        assert min(widths) > 170 and max(rights) <= size[0]


def points(t, value):
    return {"times": [t], "values": [value]}


def test_the_plot_forgets_samples_of_another_time(page):
    script = """import('/page/chart.js').then(({Chart}) => {
      let drawn = null;
      Chart.prototype.show = (curves) => (drawn = structuredClone(curves));
      const tab = new tabs.PlotTab(link, watch), shown = [];
      const next = (samples, then) => {
        hear("plot", {samples});
        drawn = null;
        const wait = () => {
          if (drawn === null) return setTimeout(wait, 20);
          shown.push(drawn);
          then();
        };
        wait();
      };
      hear("fields", {fields: ["a", "b"]});
      for (const box of document.querySelectorAll("#plot-fields input")) box.click();
      tab.show(true);
      next({a: [[100, 1]], b: [[100.5, 5]]}, () =>
        next({a: [[101, 1], [50, 2]], b: [[51, 7]]}, () =>
          next({a: [[1000, 3]]}, () => done(shown))));
    });"""
    both, set_back, later = run(page, "plot_tab.js", script, TWO)
    assert both == {"a": points(0, 1), "b": points(0.5, 5)}
    assert set_back == {"a": points(0, 2), "b": points(1, 7)}
    assert later["a"]["times"][-1] == 950


# Pixels of a colour in the upper fifth of the chart, above all that the sines reach.
ABOVE = """const canvas = document.querySelector("#plot-chart canvas");
const pen = canvas.getContext("2d");
const {data} = pen.getImageData(0, 0, canvas.width, canvas.height / 5);
let found = 0;
for (let at = 0; at < data.length; at += 4) {
  if (data[at + 3] > 100 && data[at + 2] > 150 && data[at] < 100) found += 1;
}
return found;"""


@pytest.fixture
def long_plot(page):
    page.tab("Plot")
    run(page, "plot_tab.js", LONG_PLOT, ["a", "b", "c", "d"])
    wait_for(lambda: page.all("#plot-chart canvas"), "chart")
    return page


def test_a_spike_of_one_sample_is_drawn_among_ten_minutes(long_plot):
    wait_for(lambda: long_plot.driver.execute_script(ABOVE) > 5, "spike")
