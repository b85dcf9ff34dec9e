/** The cockpit's page: one connection, the tabs, and what the server is asked to send for them. */

import { BagTab } from "./bag_tab.js";
import { DiagnosticsTab } from "./diagnostics_tab.js";
import { byId, element, say } from "./dom.js";
import { DoctorTab } from "./doctor_tab.js";
import { FramesTab } from "./frames_tab.js";
import { GraphTab } from "./graph_tab.js";
import { Link } from "./connection.js";
import { LogTab } from "./log_tab.js";
import { PlotTab } from "./plot_tab.js";
import { RobotTab } from "./robot_tab.js";
import { Tabs } from "./tabs.js";
import { TopicsTab } from "./topics_tab.js";

/**
 * A tab has a title, a panel (its HTML) and watches (what the server is asked to send at first). It may have show(on),
 * called when it is chosen or left; connect(), called when the connection opens or is lost; and its own part of the
 * address: place, a text that begins with / or ?, and go(path, query), which shows what an address names.
 * The robots' places are always watched, as they show that the server runs.
 */
const TABS = [RobotTab, FramesTab, GraphTab, TopicsTab, BagTab, PlotTab, LogTab, DiagnosticsTab, DoctorTab];
const NOTICE_MS = 8000;
const BY_ITSELF = ["watch", "input", "release", "again", "publish_end"]; // sent without a person's action
const WORDS = { open: "Connected", lost: "Connection lost – trying again", gone: "No cockpit – trying again" };
const GONE = `The cockpit has exited, it waits for a ROS master (start roscore), or the network to it is down.
 Start it again, with the launch file or with ./tutorial cockpit: this page then reconnects. With --lan, open
 the new address that it prints.`;

const watched = Object.assign({}, ...TABS.map((Tab) => Tab.watches));
let noticeEnd = null;
let refusal = ""; // the line of the newest one

const link = new Link((state) => {
  byId("connection").dataset.state = state;
  say(byId("connection"), WORDS[state]);
  document.body.classList.toggle("old", state !== "open");
  for (const tab of Object.values(tabs)) tab.connect?.();
  if (state === "gone") notice(GONE, Infinity);
  else if (byId("notice").textContent === GONE) notice("");
  if (state === "open") link.send("watch", watched);
});

function watch(fields) {
  const before = JSON.stringify(watched);
  Object.assign(watched, fields);
  if (JSON.stringify(watched) !== before) link.send("watch", watched);
}

/** Show a line for a time [ms] or for good (Infinity), or none (""). */
function notice(text, duration = NOTICE_MS) {
  say(byId("notice"), text);
  clearTimeout(noticeEnd);
  if (duration < Infinity) noticeEnd = setTimeout(() => say(byId("notice"), ""), duration);
}

const tablist = document.querySelector("[role=tablist]");
const page = { notice, look: () => tabs.robot.look, moved: (_back) => {} };
/** @type {Object<string, any>} */
const tabs = {};
for (const Tab of TABS) {
  const id = Tab.title.toLowerCase();
  tablist.append(element("button", { role: "tab", id: `tab-${id}`, "aria-controls": id }, Tab.title));
  document.querySelector("main").append(element("section",
    { role: "tabpanel", id, "aria-labelledby": `tab-${id}`, tabIndex: -1, innerHTML: Tab.panel }));
  tabs[id] = new Tab(link, watch, page);
}
link.on("refused", ({ what, why }) => {
  if (what === "input") return; // The loss of the session has its own message.
  refusal = `Not possible: ${why}.`;
  notice(refusal);
});
link.on("sent", (kind) => { // A second refusal is shown again.
  if (!BY_ITSELF.includes(kind) && byId("notice").textContent === refusal) notice("");
});
const views = new Tabs(tablist, byId("beside"), {
  onChoose(names) {
    for (const [name, tab] of Object.entries(tabs)) if (!names.includes(name)) tab.show?.(false);
    for (const name of names) tabs[name].show?.(true);
  },
  go(name, path, query) {
    tabs.robot.goTo(new URLSearchParams(location.search).get("robot"));
    tabs[name].go?.(path, query);
  },
  placeOf: (name) => tabs[name].place ?? "",
  robot: () => tabs.robot.asked,
});
page.moved = (back) => views.moved(back);
link.connect();
