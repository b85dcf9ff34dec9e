"""How the tabs handle rare messages, which the test sends in place of the server."""

from tutorial_testing.claims import claim

# A new tab beside the page's own. hear() delivers a message; `sent` has what the tab sends.
TAB = """const [done] = arguments, sent = [], handlers = {};
const watch = (fields) => sent.push(["watch", fields]);
const link = {isOpen: true, send(kind, fields) { return sent.push([kind, fields]); },
              on(kind, handler) { (handlers[kind] ??= []).push(handler); }};
const hear = (kind, message) => handlers[kind].forEach((one) => one({kind, ...message}));
const byId = (id) => document.getElementById(id);
import('/page/%s').then((tabs) => { %s });"""


def run(page, module, script):
    """Run a script with the classes of this module; return what it calls done() with."""
    return page.driver.execute_async_script(TAB % (module, script))


@claim("Tab Bag: the values ...", because="a new connection")
def test_new_connection_opens_the_recording_again_and_publishes_nothing(page):
    script = """const tab = new tabs.BagTab(link, watch, {look: () => "", moved() {}});
    const state = () => byId("bag-state").textContent;
    hear("hello", {});
    hear("bags", {names: ["joy.bag"]});
    hear("bag", {path: "joy.bag", start: 0, end: 2, fields: [["/joy/axes", 6]],
                 topics: [{name: "/joy", type: "sensor_msgs/Joy", count: 1}]});
    hear("bag_at", {position: 1, playing: true, topics: ["/joy"]});
    const playing = state();
    hear("hello", {});
    done([playing, sent.at(-1), state(), byId("bag-pause").disabled]);"""
    playing, asked, state, pause = run(page, "bag_tab.js", script)
    assert "Publishing /joy" in playing
    assert (asked, state, pause) == (["bag_open", {"name": "joy.bag"}], "", True)


@claim("Tab Log: latched ...", because="1,000 lines")
def test_log_keeps_1000_lines_on_a_change_of_tab_and_none_on_a_new_connection(page):
    script = """const tab = new tabs.LogTab(link, watch);
    const line = {time: 0, level: "WARN", node: "/x", text: "a"};
    const log = () => hear("log", {entries: Array(900).fill(line)});
    const counts = [log, log, () => tab.show(false), () => tab.show(true), () => hear("hello", {})]
      .map((step) => { step(); return byId("log-lines").childElementCount; });
    done(counts);"""
    assert run(page, "log_tab.js", script) == [900, 1000, 1000, 1000, 0]


@claim("A driver who is handed a robot looks at no other")
def test_a_driver_who_is_handed_a_robot_looks_at_no_other(page):
    script = """const tab = new tabs.RobotTab(link, watch, {notice() {}, moved() {}});
    const robots = {robot_1: {}, robot_2: {}};
    const choose = () => document.querySelector("#robots [data-robot=robot_1]").click();
    hear("hello", {id: 1, role: "driver", buttons: {D: [], X: []}});
    hear("robots", {robots});
    const session = {driver: 1, name: "x", robot: "robot_2", plays: false, armed: false, why: ""};
    hear("session", {...session, yours: false});
    const before = tab.look;
    hear("session", {...session, yours: true});
    const watched = sent.filter(([kind]) => kind === "watch").at(-1)[1];
    hear("robots", {robots});
    choose();
    const driving = [tab.look, tab.floor.look, watched.look];
    hear("session", {...session, driver: null, yours: false});
    choose();
    done([before, driving, tab.look]);"""
    assert run(page, "robot_tab.js", script) == ["robot_1", ["robot_2"] * 3, "robot_1"]
