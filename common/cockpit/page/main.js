/** The cockpit's page: one connection, six tabs, and what is to be asked of the server for them. */

import { BagTab } from "./bag_tab.js";
import { byId, say } from "./dom.js";
import { DoctorTab } from "./doctor_tab.js";
import { GraphTab } from "./graph_tab.js";
import { Link } from "./link.js";
import { LogTab } from "./log_tab.js";
import { PlotTab } from "./plot_tab.js";
import { RobotTab } from "./robot_tab.js";
import { makeTabs } from "./tabs.js";

const NOTICE_MS = 8000;
const WORDS = { open: "Connected", lost: "Connection lost – trying again", gone: "No cockpit – trying again" };
const GONE = `The cockpit has exited, or the network to it is down. Start it again, with the launch file or with
 ./tutorial cockpit: this page then reconnects. With --lan, open the new address that it prints.`;

// What the server is asked to send. The robots' places are always watched: they tell that it is there.
const watched = {
  robots: true, look: null, graph: false, topic: null, node: null, fields: [], field_list: false,
  log: false, bag: false,
};
let noticeEnd = null;

const link = new Link((state) => {
  byId("connection").dataset.state = state;
  say(byId("connection"), WORDS[state]);
  robot.connect(state === "open");
  if (state === "gone") notice(GONE, Infinity);
  else if (byId("notice").textContent === GONE) notice("");
  if (state === "open") link.send("watch", watched); // with it all is told anew, who drives, too
});

function watch(fields) {
  const before = JSON.stringify(watched);
  Object.assign(watched, fields);
  if (JSON.stringify(watched) !== before) link.send("watch", watched);
}

/** Show a line for a while [ms] or without end (Infinity), or none (""). */
function notice(text, duration = NOTICE_MS) {
  byId("notice").hidden = !text;
  say(byId("notice"), text);
  clearTimeout(noticeEnd);
  if (duration < Infinity) noticeEnd = setTimeout(() => (byId("notice").hidden = true), duration);
}

const robot = new RobotTab(link, watch, notice);
const tabs = {
  graph: new GraphTab(link, watch),
  bag: new BagTab(link, watch, () => robot.look),
  plot: new PlotTab(link, watch),
  log: new LogTab(link, watch),
  doctor: new DoctorTab(link),
};
link.on("refused", ({ what, why }) => {
  if (what !== "input") notice(`${what}: ${why}`); // of the seat's loss the page is told otherwise
});
makeTabs(document.querySelector("[role=tablist]"), (name) => {
  for (const [other, tab] of Object.entries(tabs)) if (other !== name) tab.show(false);
  tabs[name]?.show(true);
});
link.connect();
