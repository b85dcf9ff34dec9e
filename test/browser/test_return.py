"""After a connection was lost, or time set back: what the tabs then say is so."""

# Tabs of their own beside those of the page, which a server of the test speaks to.
TAB = """const done = arguments[0], sent = [];
const handlers = {}, watch = (fields) => sent.push(["watch", fields]);
const link = {send(kind, fields) { sent.push([kind, fields]); return true; },
              on(kind, handler) { handlers[kind] = handler; }};
const hear = (kind, message) => handlers[kind]({kind, ...message});
const text = (id) => document.getElementById(id).textContent;
import('/page/%s').then((tabs) => { %s });"""


def run(page, script, module):
    return page.driver.execute_async_script(TAB % (module, script))


def test_an_open_recording_is_opened_anew_and_nothing_is_published(page):
    script = """const tab = new tabs.BagTab(link, watch, {look: () => ""});
    hear("hello", {});
    const before = sent.length;
    hear("bag", {path: "joy.bag", start: 0, end: 2, curves: {},
                    topics: [{name: "/joy", type: "sensor_msgs/Joy", count: 1}]});
    hear("bag_at", {position: 1, playing: true, topic: "/joy"});
    const playing = text("bag-state");
    hear("hello", {});
    const pause = document.getElementById("bag-pause").disabled;
    done([before, playing, sent.at(-1), text("bag-state"), pause]);"""
    before, playing, asked, state, pause = run(page, script, "bag_tab.js")
    assert (before, "Publishing /joy" in playing) == (0, True)
    assert (asked, state, pause) == (["bag_open", {"name": "joy.bag"}], "", True)


def test_the_doctor_is_asked_anew_and_may_be_asked_again(page):
    script = """const tab = new tabs.DoctorTab(link), asked = () => sent.length;
    const button = document.getElementById("doctor-run"), counts = [];
    hear("hello", {});
    counts.push(asked());
    tab.show(true);
    counts.push(asked());
    hear("doctor", {lines: [], running: true});
    const running = button.disabled;
    hear("hello", {});
    counts.push(asked());
    const returned = button.disabled;
    tab.show(false);
    hear("hello", {});
    done([...counts, asked(), running, returned]);"""
    assert run(page, script, "doctor_tab.js") == [0, 1, 2, 2, True, False]


def test_the_log_stays_where_its_tab_is_chosen_again(page):
    script = """const tab = new tabs.LogTab(link, watch), counts = [];
    const entry = {time: 0, level: "WARN", node: "/x", text: "a"};
    const lines = () => document.getElementById("log-lines").childElementCount;
    tab.show(true);
    hear("log", {entries: [entry]});
    tab.show(true);
    counts.push(lines());
    tab.show(false);
    tab.show(true);
    counts.push(lines());
    hear("log", {entries: [entry]});
    hear("hello", {});
    done([...counts, lines()]);"""
    assert run(page, script, "log_tab.js") == [1, 0, 0]


def test_curves_of_another_time_are_not_drawn(page):
    script = """import('/page/chart.js').then(({Chart}) => {
      let drawn = null;
      Chart.prototype.show = (curves) => (drawn = curves);
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
    both, set_back, later = run(page, script, "plot_tab.js")
    assert both == {"a": [[0, 1]], "b": [[0.5, 5]]}
    assert set_back == {"a": [[0, 2]], "b": [[1, 7]]}
    assert later == {"a": [[950, 3]], "b": []}  # of the last 30 s
