/** The tab Diagnostics: what nodes report about themselves, as a tree by names, the newest change of a level first. */

import { byId, byName, element, row, say } from "./dom.js";

const LEVELS = ["OK", "WARN", "STALE", "ERROR"]; // the worst is last
const DEEPEST = 6; // parts of a name
const NOTHING = `No report yet. joy2twist, joy_node, the simulated robot (fake_turtlebot) and kobuki_node report once a
 second on /diagnostics. Your node can, too, with diagnostic_updater.`;

/**
 * The branches of the tree: Map of a part of a name -> {path, below: its branches; rank, changed: of the worst and the
 * newest change below; message, values: of a status}.
 */
function branchesOf(statuses) {
  const root = { path: "", below: new Map() };
  for (const [name, level, message, values, changed] of statuses) {
    const parts = name.split(/: |\//).filter(Boolean);
    parts.push(`${parts.splice(Math.min(parts.length, DEEPEST) - 1).join("/")} `); // A branch may have the same name.
    let branch = root;
    for (const part of parts) {
      const { path, below } = branch;
      branch = below.get(part) ?? { path: `${path}/${part}`, rank: 0, changed: 0, below: new Map() };
      below.set(part, branch);
      branch.rank = Math.max(branch.rank, LEVELS.indexOf(level));
      branch.changed = Math.max(branch.changed, changed);
    }
    Object.assign(branch, { message, values });
  }
  return root.below;
}

export class DiagnosticsTab {
  static title = "Diagnostics";
  static panel = `
  <p class="card" id="diagnostics-counts" role="status"></p>
  <div class="scroll" id="diagnostics-tree" role="region" tabindex="0" aria-label="Reports of nodes"></div>`;
  static watches = { diagnostics: false };

  #lines = new Map(); // path -> its <details>, which stays, as it may be open
  #began = 0; // when the server's clock was 0 [ms]

  constructor(link, watch) {
    this.watch = watch;
    link.on("hello", () => (this.#began = 0));
    link.on("diagnostics", ({ now, statuses }) => this.#show(now, statuses));
  }

  show(on) {
    this.watch({ diagnostics: on });
  }

  #show(now, statuses) {
    this.#began ||= Date.now() - 1000 * now;
    const direct = statuses.filter(([name]) => !name.startsWith("/diagnostics_agg/"));
    const levels = (direct.length ? direct : statuses).map(([, level]) => level);
    const counts = LEVELS.map((level) => `${levels.filter((other) => other === level).length} ${level}`);
    say(byId("diagnostics-counts"), levels.length ? counts.reverse().join(", ") : NOTHING);
    this.#draw(byId("diagnostics-tree"), branchesOf(statuses));
    for (const [path, line] of this.#lines) if (!line.isConnected) this.#lines.delete(path);
  }

  #draw(place, branches) {
    const sorted = [...branches].sort(([nameA, a], [nameB, b]) =>
      b.changed - a.changed || b.rank - a.rank || byName(nameA, nameB));
    const lines = sorted.map(([name, branch]) => this.#drawLine(name, branch));
    if (lines.length === place.children.length && lines.every((line, i) => line === place.children[i])) return;
    const focused = /** @type {HTMLElement} */ (document.activeElement);
    place.replaceChildren(...lines);
    focused?.focus({ preventScroll: true }); // An element that moves loses it.
  }

  #drawLine(name, { path, rank, changed, message = "", values = [], below }) {
    const line = this.#lines.get(path) ?? element("details", { open: !values.length },
      element("summary", {}, ...["b", "span", "span", "small"].flatMap((tag) => [element(tag), " "])),
      element("table", {}, element("tbody")), element("div"));
    this.#lines.set(path, line);
    const [summary, table, place] = line.children;
    line.dataset.level = LEVELS[rank];
    const time = new Date(this.#began + 1000 * changed).toTimeString().slice(0, 8);
    [LEVELS[rank], name, message, changed ? `since ${time}` : ""].forEach((text, i) => say(summary.children[i], text));
    const { rows } = table;
    if (rows.length !== values.length) table.tBodies[0].replaceChildren(...values.map(() => row("", "")));
    values.flat().forEach((text, i) => say(rows[i >> 1].cells[i % 2], text));
    this.#draw(place, below);
    return line;
  }
}
