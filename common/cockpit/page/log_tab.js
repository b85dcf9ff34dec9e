/** The tab Log: what all nodes log on /rosout. */

import { appendBelow, byId, matcher, offer, row, save, say } from "./dom.js";

const LEVELS = ["DEBUG", "INFO", "WARN", "ERROR", "FATAL"]; // A line of another level is always shown.
const OPTIONS = LEVELS.map((level) => `<option>${level}</option>`).join("");
const MOST = 1000; // lines that are kept, as many as the server keeps
const NOTHING = `No line yet. What nodes log with rospy.loginfo() and the like comes here, and of each node the last line
 before the cockpit was started. What is printed stays in its terminal; older lines are in ~/.ros/log.`;

/** "talker.cpp:12 main()" of "~/ws/src/talker.cpp:12(int main(int, char**))". */
export function briefPlace(place) {
  const [, line = "", signature = ""] = /([^/]*:\d+)\((.*)\)$/s.exec(place) ?? [];
  const name = /([\w:~.]+)\(/.exec(signature)?.[1] ?? signature;
  return /^\w/.test(name) ? `${line} ${name}()` : line; // not <module>, a Python file itself
}

function lineOf({ time, level, node, place, text }) {
  const line = row(new Date(time * 1000).toTimeString().slice(0, 8), level, node, briefPlace(place), text);
  Object.assign(line.dataset, { time: time.toFixed(3), level });
  line.title = place;
  return line;
}

export class LogTab {
  static title = "Log";
  static panel = `
  <div class="card row">
    <label>From level <select id="log-level">${OPTIONS}</select></label>
    <label class="grow">Filter <input type="search" id="log-filter" placeholder="words; -word excludes" autocomplete="off"></label>
    <span id="log-count" class="hint"></span>
    <button id="log-pause" aria-pressed="false">Pause</button>
    <button id="log-save">Save</button>
  </div>
  <div class="card row">
    <label>Loggers of <select id="log-node"></select></label>
    <label>Logger <select id="log-logger"></select></label>
    <label>logs from <select id="log-logs"><option></option>${OPTIONS}</select></label>
  </div>
  <div class="scroll" id="log-scroll" role="region" tabindex="0" aria-label="Messages of all nodes">
    <p id="log-empty" class="hint"></p>
    <table><tbody id="log-lines"></tbody></table></div>`;
  static watches = { log: false };

  #levels = {}; // logger of the chosen node -> its level
  #isPaused = false;
  #waiting = []; // lines that arrived during a pause

  constructor(link, watch) {
    this.watch = watch;
    this.link = link;
    this.lines = byId("log-lines");
    link.on("hello", () => this.#show(this.#waiting = [])); // After a new connection the server sends its last lines.
    link.on("log", ({ entries }) => this.#receive(entries.map(lineOf)));
    byId("log-level").value = "INFO";
    link.on("graph", ({ services }) => {
      const nodes = services.flatMap((name) => /^(.*)\/get_loggers$/.exec(name)?.slice(1) ?? []);
      offer(byId("log-node"), [["", "choose a node"], ...nodes.map((node) => [node])]);
    });
    link.on("answer", ({ name, text }) => name === this.#service("get_loggers") && this.#showLoggers(text));
    byId("log-node").onchange = () => this.#ask();
    byId("log-logger").onchange = () => this.#showLogger();
    byId("log-logs").onchange = () => this.#setLevel();
    byId("log-level").onchange = byId("log-filter").oninput = () => this.#show([...this.lines.rows]);
    byId("log-pause").onclick = () => this.#pause();
    byId("log-save").onclick = () => this.#save();
  }

  /** Lines stay while another tab is shown; afterwards the server sends those that are missing. */
  show(on) {
    this.watch({ log: on, graph: on });
    if (on) this.#ask();
  }

  #service(name) {
    return `${byId("log-node").value}/${name}`;
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
    if (this.#levels.rosout) byId("log-logger").value = "rosout"; // the logger of rospy.loginfo() and the like
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

  #pause() {
    this.#isPaused = !this.#isPaused;
    byId("log-pause").setAttribute("aria-pressed", String(this.#isPaused));
    say(byId("log-pause"), this.#isPaused ? "Resume" : "Pause");
    this.#receive([]);
  }

  /** Save the lines that are shown, as in rosout.log. */
  #save() {
    const lines = [...this.lines.rows].filter(({ hidden }) => !hidden).map(({ dataset: { time, level }, title, cells }) =>
      `${time} ${level} ${cells[2].textContent} [${title}] ${cells[4].textContent}\n`);
    save(new Blob(lines), "rosout.log");
  }

  /** Show new lines, or let them wait while the tab is paused. */
  #receive(lines) {
    this.#waiting = [...this.#waiting, ...lines].slice(-MOST);
    this.#append(this.#isPaused ? [] : this.#waiting.splice(0));
  }

  /** Show these lines only. */
  #show(lines) {
    this.lines.replaceChildren();
    this.#append(lines);
  }

  #append(lines) {
    const matches = matcher(byId("log-filter").value);
    const quiet = LEVELS.slice(0, LEVELS.indexOf(byId("log-level").value));
    for (const line of lines) {
      const { dataset: { level }, title, cells } = line;
      line.hidden = quiet.includes(level) || !matches(`${cells[2].textContent} ${title} ${cells[4].textContent}`);
    }
    appendBelow(this.lines, lines, MOST, byId("log-scroll"));
    const all = this.lines.childElementCount;
    const seen = this.lines.querySelectorAll("tr:not([hidden])").length;
    say(byId("log-count"), `${seen} of ${all}${this.#isPaused ? `, ${this.#waiting.length} new` : ""}`);
    byId("log-empty").hidden = seen > 0;
    say(byId("log-empty"), all ? `None of ${all} lines matches the filter and the level.` : NOTHING);
  }
}
