/** The tab Frames: the tree of tf with what is wrong in it, and the transform between two frames. */

import { brief, byId, element, number, offer, row, say, sayName } from "./dom.js";

const FIXED = ["odom", "map"], BASE = ["base_footprint", "base_link"]; // of REP-105, chosen at first
const DEEPEST = 10; // A deeper frame is indented as far.

export class FramesTab {
  static title = "Frames";
  static panel = `
  <div class="wide">
    <p id="frames-about" class="hint" role="status"></p>
    <div class="scroll"><table role="treegrid" aria-label="Frames"><thead><tr>
      <th>Frame</th><th>Hz</th><th>Age</th><th>Published by</th></tr></thead><tbody id="frames-rows"></tbody></table></div>
  </div>
  <div class="panel"><div class="card"><h2>Transform</h2>
    <p class="row"><label>From <select id="frames-from"></select></label>
      <label>to <select id="frames-to"></select></label></p>
    <pre id="frames-transform"></pre>
    <p class="hint">The place of the second frame in the first one, as <code>rosrun tf tf_echo</code> prints it.</p>
  </div></div>`;
  static watches = { frames: null };

  #isShown = false;
  #rows = new Map(); // name of a frame -> its row
  #chosen = ["", ""]; // from, to; "": the robot's
  #pair = ["", ""]; // and with these

  constructor(link, watch, page) {
    this.watch = watch;
    this.page = page;
    this.selects = [byId("frames-from"), byId("frames-to")];
    this.selects.forEach((select, i) => (select.onchange = () => this.#choose(i, select.value)));
    byId("frames-rows").onkeydown = (event) => this.#move(event);
    link.on("frames", (tree) => this.#show(tree));
    link.on("transform", ({ text }) => say(byId("frames-transform"), text));
  }

  get place() {
    const [from, to] = this.#chosen;
    return from || to ? `?${new URLSearchParams({ from, to })}`.replaceAll("%2F", "/") : "";
  }

  go(_path, query) {
    this.#chosen = ["from", "to"].map((name) => query.get(name) ?? "");
  }

  show(on) {
    this.#isShown = on;
    this.#watchPair();
  }

  #choose(i, frame) {
    this.#chosen = [...this.#pair];
    this.#chosen[i] = frame;
    this.#watchPair();
    this.page.moved(true);
  }

  #watchPair() {
    const names = [...this.#rows.keys()], robot = this.page.look();
    const own = (ends) => ends.map((end) => (robot ? `${robot}/${end}` : end)).find((name) => this.#rows.has(name));
    const defaults = [own(FIXED) ?? names[0], own(BASE) ?? names[1]];
    this.#pair = this.#chosen.map((frame, i) => frame || defaults[i] || "");
    this.selects.forEach((select, i) => {
      offer(select, [...new Set([...names, this.#pair[i]])].map((name) => [name]));
      select.value = this.#pair[i];
    });
    if (!this.#pair.every(Boolean)) say(byId("frames-transform"), "");
    this.watch({ frames: this.#isShown ? this.#pair.filter(Boolean) : null });
  }

  #show({ rows, published, full }) {
    const lines = rows.map((frame) => this.#line(frame)), list = byId("frames-rows");
    if (lines.length !== list.rows.length || lines.some((line, i) => line !== list.rows[i])) {
      const focused = list.querySelector(":focus");
      list.replaceChildren(...lines);
      focused?.focus();
    }
    if (lines.length && !lines.some((line) => line.tabIndex === 0)) lines[0].tabIndex = 0;
    this.#rows = new Map(rows.map(({ frame }, i) => [frame, lines[i]]));
    const roots = rows.filter(({ depth }) => depth === 0).map(({ frame }) => frame);
    const wrong = rows.filter(({ problems }) => problems?.length).length;
    const nothing = published ? "No transform yet" : "No node publishes /tf: start a robot";
    say(byId("frames-about"), [
      rows.length ? `${rows.length} frames${full ? " and more" : ""}` : nothing,
      wrong ? `${wrong} with problems` : "",
      roots.length > 1 ? `${roots.length} trees without a connection: ${roots.join(", ")}` : "",
    ].filter(Boolean).join("; "));
    this.#watchPair();
  }

  /** The row of a frame, with its newest values. A root has only a name. */
  #line({ frame, depth, nodes, rate, age, static: isStatic, problems = [] }) {
    const line = this.#rows.get(frame) ?? this.#newLine(frame);
    line.setAttribute("aria-level", depth + 1);
    line.style.setProperty("--depth", Math.min(depth, DEEPEST));
    const [name, ...cells] = line.cells;
    const values = isStatic ? ["static", ""] : [number(rate, 1), `${number(age)} s`];
    const texts = nodes ? [...values, nodes.map(brief).join(", ")] : ["", "", ""];
    texts.forEach((text, i) => sayName(cells[i], text));
    say(name.lastChild, problems.join("; "));
    return line;
  }

  #newLine(frame) {
    const name = element("span"), line = row(name, "", "", "");
    sayName(name, frame);
    line.cells[0].append(element("strong", { className: "problem" }));
    line.onclick = () => this.#choose(1, frame);
    line.onfocus = () => {
      for (const other of byId("frames-rows").rows) other.tabIndex = other === line ? 0 : -1;
    };
    line.tabIndex = -1;
    return line;
  }

  #move(event) {
    const lines = [...byId("frames-rows").rows], now = lines.indexOf(event.target);
    const next = { ArrowDown: now + 1, ArrowUp: now - 1, Home: 0, End: lines.length - 1 }[event.key];
    if (event.key === "Enter") lines[now].click();
    if (next === undefined) return;
    event.preventDefault();
    lines[next]?.focus();
  }
}
