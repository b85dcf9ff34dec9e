/** The tab Graph: the nodes and their topics, live. */

import { brief, byId, byName, element, matcher, save, say, sayName } from "./dom.js";
import { dotOf, groupsOf, itemsOf } from "./graph_items.js";
import { itemBeside, layout, neighbours } from "./graph_layout.js";
import { fileOf, pictureOf } from "./graph_picture.js";

const READABLE = 0.7; // The picture shrinks to this scale by itself; then it scrolls.

export class GraphTab {
  static title = "Graph";
  static panel = `
  <div class="row">
    <button id="graph-in" aria-label="Zoom in">+</button>
    <button id="graph-out" aria-label="Zoom out">−</button>
    <button id="graph-fit">Fit</button>
    <label>Find <input type="search" id="graph-search" placeholder="name, then Enter" autocomplete="off"></label>
    <span id="graph-found" class="hint" role="status"></span>
    <span role="group" class="row hint" id="graph-switches" aria-label="What is drawn">Hide:
      <label title="topics without a subscriber"><input type="checkbox" value="sinks"> Dead sinks</label>
      <label title="topics without a publisher"><input type="checkbox" value="sources" checked> Dead sources</label>
      <label title="such as /rosout, /clock, /diagnostics, rqt, RViz, rosbag record"><input type="checkbox" value="debug"
        checked> Debug</label> Group:
      <label><input type="checkbox" value="namespaces" checked> Namespaces</label></span>
    <button id="graph-svg">Save SVG</button>
    <button id="graph-dot">Save DOT</button>
  </div>
  <div class="wide" id="graph-picture" role="region" tabindex="0" aria-label="Nodes and topics"></div>
  <div class="panel">
    <div class="card"><h2 id="graph-title" aria-live="polite"></h2>
      <div id="graph-details"><p class="hint">Choose a node or a topic; arrow keys go to the next one.</p></div></div>
  </div>`;
  static watches = { graph: false };

  #chosen = null; // "node /a" or "topic /b"
  #drawn = "";
  #layout = layout([], []);
  #scale = () => Math.min(1, Math.max(READABLE, this.#fits[0])); // until a person chooses another scale
  #graph = { nodes: [], topics: [], edges: [] };

  constructor(link, watch, page) {
    this.watch = watch;
    this.picture = byId("graph-picture");
    link.on("graph", (graph) => this.#draw((this.#graph = graph)));
    this.switches = [...byId("graph-switches").querySelectorAll("input")];
    byId("graph-switches").onchange = () => {
      this.#draw(this.#graph);
      page.moved();
    };
    byId("graph-svg").onclick = () => save(fileOf(this.picture.querySelector("svg")), "graph.svg");
    byId("graph-dot").onclick = () => save(new Blob([dotOf(this.#layout)]), "graph.dot");
    this.picture.onclick = ({ target }) => {
      const box = target.closest("[data-item]");
      if (box) this.#choose(box.dataset.item);
    };
    this.picture.onkeydown = (event) => this.#press(event);
    byId("graph-in").onclick = () => this.#zoom(1.25);
    byId("graph-out").onclick = () => this.#zoom(0.8);
    byId("graph-fit").onclick = () => this.#resize(() => Math.min(1, ...this.#fits));
    byId("graph-search").oninput = () => this.#find(false);
    byId("graph-search").addEventListener("keydown", ({ key }) => key === "Enter" && this.#find(true));
    new ResizeObserver(() => this.#resize()).observe(this.picture);
  }

  get place() {
    const switched = this.switches.filter(({ checked, defaultChecked }) => checked !== defaultChecked);
    return switched.length ? `?switch=${switched.map(({ value }) => value)}` : "";
  }

  go(_path, query) {
    const switched = query.get("switch")?.split(",") ?? [];
    for (const box of this.switches) box.checked = box.defaultChecked !== switched.includes(box.value);
  }

  show(on) {
    if (on) this.#draw(this.#graph);
    this.watch({ graph: on });
  }

  #choose(item) {
    this.#chosen = item;
    this.#stopAt(item);
    say(byId("graph-title"), item.replace(/^./, (letter) => letter.toUpperCase()));
    this.#mark();
    this.#showDetails();
  }

  #mark() {
    for (const part of this.picture.querySelectorAll("[data-item], [data-from]")) {
      const { item, from, to } = part.dataset;
      const isChosen = this.#chosen !== null && [item, from, to].includes(this.#chosen);
      part.classList.toggle("chosen", isChosen);
      if (from) part.setAttribute("marker-end", isChosen ? "url(#chosen-tip)" : "url(#tip)");
    }
  }

  /** The scales at which the picture is as wide, and as high, as the space for it. */
  get #fits() {
    return [this.picture.clientWidth / this.#layout.width, this.picture.clientHeight / this.#layout.height];
  }

  #zoom(factor) {
    const scale = Math.max(0.02, this.#scale() * factor);
    this.#resize(() => scale);
  }

  /** Scale the picture around its visible middle. */
  #resize(scale = this.#scale) {
    this.#scale = scale;
    const drawn = this.picture.querySelector("svg");
    if (!drawn || !this.picture.clientWidth) return; // another tab is shown
    const { scrollLeft, scrollTop, clientWidth, clientHeight } = this.picture;
    const now = this.#scale();
    const grown = (this.#layout.width * now) / drawn.width.baseVal.value;
    for (const side of ["width", "height"]) drawn.setAttribute(side, this.#layout[side] * now);
    const scrolled = (start, size) => (start + size / 2) * grown - size / 2;
    this.picture.scrollTo(scrolled(scrollLeft, clientWidth), scrolled(scrollTop, clientHeight));
  }

  /** The boxes that match the search; the others are dimmed. */
  #search() {
    const search = byId("graph-search").value.trim();
    const matches = matcher(search);
    const isFound = ({ dataset: { item } }) => matches(item);
    const boxes = [...this.picture.querySelectorAll("[data-item]")];
    for (const box of boxes) box.classList.toggle("other", !isFound(box));
    const found = search ? boxes.filter(isFound) : [];
    say(byId("graph-found"), search ? `${found.length} of ${boxes.length}` : "");
    return found;
  }

  /** Show the first match, or choose the next one. */
  #find(next) {
    const found = this.#search();
    if (!found.length) return;
    const last = found.findIndex(({ dataset: { item } }) => item === this.#chosen);
    const box = found[next ? (last + 1) % found.length : 0];
    if (this.#scale() < READABLE) this.#resize(() => 1);
    box.scrollIntoView({ block: "center", inline: "center" });
    if (next) this.#choose(box.dataset.item);
  }

  #draw(graph) {
    if (byId("graph").hidden) return; // The tab Topics has asked for it.
    const on = this.switches.filter(({ checked }) => checked).map(({ value }) => value);
    const items = itemsOf(graph, on);
    const groups = on.includes("namespaces") ? groupsOf(items) : {};
    const wanted = JSON.stringify([items, graph.edges, groups]);
    if (wanted === this.#drawn) return;
    this.#drawn = wanted;
    const hasFocus = this.picture.querySelector(":focus") !== null;
    const stop = this.picture.querySelector("[tabindex='0']")?.dataset.item;
    const scrolled = [this.picture.scrollLeft, this.picture.scrollTop];
    this.#layout = layout(items, graph.edges, groups);
    const picture = pictureOf(this.#layout);
    this.picture.replaceChildren(items.length ? picture : element("p", { className: "hint" }, "No node is running."));
    byId("graph-svg").disabled = byId("graph-dot").disabled = !items.length;
    this.#resize();
    this.picture.scrollTo(...scrolled);
    this.#mark();
    this.#search();
    if (this.#chosen) this.#showDetails();
    const box = this.#stopAt(stop);
    if (hasFocus) box?.focus();
  }

  /** Let Tab reach the box of an item, or else the first one, and no other. */
  #stopAt(item = "") {
    const boxes = [...this.picture.querySelectorAll("[data-item]")];
    const stop = boxes.find((box) => box.dataset.item === item) ?? boxes[0];
    for (const box of boxes) box.setAttribute("tabindex", box === stop ? 0 : -1);
    return stop;
  }

  #press(event) {
    if (event.altKey || event.ctrlKey || event.metaKey) return; // such as Back
    const { item } = event.target.dataset;
    const next = item && itemBeside(this.#layout.boxes, item, event.key);
    if (next) this.#stopAt(next).focus();
    else if (item && ["Enter", " "].includes(event.key)) this.#choose(item);
    else return;
    event.preventDefault();
  }

  /** What is known of the chosen node or topic. */
  #showDetails() {
    const [kind, name] = this.#chosen.split(" ");
    const { nodes, topics, edges } = this.#graph;
    const { before, after } = neighbours(edges);
    const beside = (side, ...items) => items.flatMap((item) => side[item] ?? []);
    const [sources, targets] = [beside(before, this.#chosen), beside(after, this.#chosen)];
    const { machine, services } = nodes.find((node) => node.name === name) ?? {};
    const others = new Set([...beside(before, ...sources), ...beside(after, ...targets)]);
    others.delete(this.#chosen);
    const entries = kind === "topic" ? {
      Type: topics.find((topic) => topic.name === name)?.type || "–",
      Publishers: this.#links(sources),
      Subscribers: this.#links(targets),
      "Rate and messages": element("a", { href: `#topics${name}` }, "in the tab Topics"),
    } : {
      Machine: machine || "–",
      Publishes: this.#links(targets),
      "Subscribes to": this.#links(sources),
      "Connected to": this.#links([...others]),
      Services: services?.join(", ") || "–",
    };
    const parts = Object.entries(entries).map(([title, value]) =>
      element("div", {}, element("dt", {}, title), element("dd", {}, ...[value].flat())));
    byId("graph-details").replaceChildren(element("dl", { className: "details" }, ...parts));
  }

  /** Buttons that choose nodes or topics, or a dash. */
  #links(items) {
    const button = (item) => {
      const link = element("button", { className: "link", onclick: () => this.#choose(item), title: item });
      sayName(link, brief(item.split(" ")[1]));
      return link;
    };
    return items.length ? items.sort(byName).map(button) : "–";
  }
}
