/** The tab Log: what all nodes log on /rosout. */

import { byId, offer, row, say } from "./dom.js";

const LEVELS = ["DEBUG", "INFO", "WARN", "ERROR", "FATAL"]; // a line of another level is always shown
const MOST = 1000; // lines that are kept, as many as by the server
const NOTHING = `No line yet. What nodes log with rospy.loginfo() and the like comes here, and of each node the last line
 before the cockpit was started. What is printed stays in its terminal; older lines are in ~/.ros/log.`;

const PANEL = `
  <div class="card row">
    <label>From level <select id="log-level"></select></label>
    <label class="grow">Filter <input type="search" id="log-filter" placeholder="node or text" autocomplete="off"></label>
    <span id="log-count" class="hint"></span>
  </div>
  <div class="card row">
    <label>Loggers of <select id="log-node"></select></label>
    <label>Logger <select id="log-logger"></select></label>
    <label>logs from <select id="log-logs"></select></label>
  </div>
  <div class="scroll" id="log-scroll" role="region" tabindex="0" aria-label="Messages of all nodes">
    <p id="log-empty" class="hint"></p>
    <table><tbody id="log-lines"></tbody></table></div>`;

export class LogTab {
  static title = "Log";
  static panel = PANEL;
  static watches = { log: false };

  #entries = [];
  #levels = {}; // logger of the chosen node -> its level

  constructor(link, watch) {
    this.watch = watch;
    this.link = link;
    this.lines = byId("log-lines");
    link.on("hello", () => this.#begin());
    link.on("log", ({ entries }) => this.#add(entries));
    offer(byId("log-level"), LEVELS.map((level) => [level]));
    byId("log-level").value = "INFO";
    link.on("graph", ({ services }) => this.#offerNodes(services));
    link.on("answer", ({ name, text }) => name === this.#service("get_loggers") && this.#showLoggers(text));
    offer(byId("log-logs"), [[""], ...LEVELS.map((level) => [level])]);
    byId("log-node").onchange = () => this.#ask();
    byId("log-logger").onchange = () => this.#showLogger();
    byId("log-logs").onchange = () => this.#setLevel();
    byId("log-level").onchange = byId("log-filter").oninput = () => this.#showAll();
  }

  /** Lines stay while another tab is shown: the server then sends those that came meanwhile. */
  show(on) {
    this.watch({ log: on, graph: on });
    if (on) this.#ask();
  }

  #service(name) {
    return `${byId("log-node").value}/${name}`;
  }

  /** Offer the nodes that have loggers. */
  #offerNodes(services) {
    const nodes = services.filter((name) => name.endsWith("/get_loggers")).map((name) => name.replace(/.get_loggers$/, ""));
    offer(byId("log-node"), [["", "choose a node"], ...nodes.map((node) => [node])]);
  }

  #ask() {
    this.#showLoggers("");
    if (byId("log-node").value) this.link.send("call", { service: this.#service("get_loggers"), values: {} });
  }

  /** text: the answer of get_loggers. */
  #showLoggers(text) {
    const found = [...text.matchAll(/name: "(.*)"\s+level: "(.*)"/g)];
    this.#levels = Object.fromEntries(found.map(([, name, level]) => [name, level.toUpperCase()]));
    offer(byId("log-logger"), Object.keys(this.#levels).map((name) => [name]));
    if (this.#levels.rosout) byId("log-logger").value = "rosout"; // that of rospy.loginfo() and the like
    this.#showLogger();
  }

  #showLogger() {
    byId("log-logs").value = this.#levels[byId("log-logger").value] ?? "";
  }

  #setLevel() {
    const [logger, level] = [byId("log-logger").value, byId("log-logs").value.toLowerCase()];
    this.link.send("call", { service: this.#service("set_logger_level"), values: { logger, level } });
    this.#levels[logger] = byId("log-logs").value;
  }

  /** Forget all lines: the server of a new connection sends its last ones. */
  #begin() {
    this.#entries = [];
    this.#showAll();
  }

  #passes({ level, node, text }) {
    const wanted = byId("log-filter").value.toLowerCase();
    const quiet = LEVELS.slice(0, LEVELS.indexOf(byId("log-level").value));
    return !quiet.includes(level) && `${node} ${text}`.toLowerCase().includes(wanted);
  }

  #add(entries) {
    this.#entries.push(...entries);
    this.#entries.splice(0, this.#entries.length - MOST);
    this.#append(entries.filter((entry) => this.#passes(entry)));
  }

  #showAll() {
    this.lines.replaceChildren();
    this.#append(this.#entries.filter((entry) => this.#passes(entry)));
  }

  #append(entries) {
    const scroll = byId("log-scroll");
    const atEnd = scroll.scrollHeight - scroll.scrollTop - scroll.clientHeight < 40;
    this.lines.append(...entries.map(({ time, level, node, text }) => {
      const line = row(new Date(time * 1000).toTimeString().slice(0, 8), level, node, text);
      line.className = level.toLowerCase();
      line.dataset.level = level;
      return line;
    }));
    while (this.lines.childElementCount > MOST) this.lines.firstChild.remove();
    if (atEnd) scroll.scrollTop = scroll.scrollHeight;
    const [seen, all] = [this.lines.childElementCount, this.#entries.length];
    say(byId("log-count"), `${seen} of ${all}`);
    byId("log-empty").hidden = seen > 0;
    say(byId("log-empty"), all ? `None of ${all} lines passes the filter and the level.` : NOTHING);
  }
}
