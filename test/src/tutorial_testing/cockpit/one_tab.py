"""One tab of the cockpit's page whose server is the test."""

# A tab of its own beside that of the page. hear() is a message of the server; `sent` is what the
# tab asks for.
TAB = """const [given, done] = arguments, sent = [], handlers = {};
const watch = (fields) => sent.push(["watch", fields]);
const link = {isOpen: true, send(kind, fields) { return sent.push([kind, fields]); },
              on(kind, handler) { (handlers[kind] ??= []).push(handler); }};
const hear = (kind, message) => handlers[kind].forEach((one) => one({kind, ...message}));
const byId = (id) => document.getElementById(id);
import('/page/%s').then((tabs) => { %s });"""
# Four curves of 50 Hz for ten minutes, with a spike of one sample, in the page's own tab.
LONG_PLOT = """const tab = new tabs.PlotTab(link, watch);
hear("fields", {fields: given});
for (const box of document.querySelectorAll("#plot-fields input")) box.click();
byId("plot-window").value = 600;
document.querySelector("[role=tab][aria-controls=plot]").click();
const value = (t, i) => (i === 0 && Math.abs(t - 300) < 0.001 ? 5 : Math.sin(t / 20 + i));
const times = (from, to) =>
  Array.from({length: Math.round((to - from) * 50)}, (_, k) => from + k / 50);
const curve = (from, to, i) => times(from, to).map((t) => [t, value(t, i)]);
window.feed = (from, to) => hear("plot", {
  samples: Object.fromEntries(given.map((field, i) => [field, curve(from, to, i)])),
});
tab.show(true);
for (let t = 0; t < 600; t += 10) feed(t, t + 10);
setTimeout(() => done(true), 300);"""


def run(page, module, script, given):
    """Make a tab of this module; return what the script calls done() with."""
    return page.driver.execute_async_script(TAB % (module, script), given)
