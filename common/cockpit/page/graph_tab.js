/** The tab Graph: the nodes and their topics, live. */

import { brief, byId, byName, element, say } from "./dom.js";
import { layout, neighbours } from "./graph_layout.js";

// Every node is connected to /rosout, which would hide the rest; draw_graph omits the same.
const DEBUG = ["node /rosout", "topic /rosout", "topic /rosout_agg", "topic /statistics"];
const READABLE = 0.7; // The picture shrinks to this scale by itself; then it scrolls.
const SVG = "http://www.w3.org/2000/svg";

function svg(tag, attributes = {}, ...children) {
  const made = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

export class GraphTab {
  static title = "Graph";
  static panel = `
  <div class="row">
    <button id="graph-in" aria-label="Zoom in">+</button>
    <button id="graph-out" aria-label="Zoom out">−</button>
    <button id="graph-fit">Fit</button>
    <label>Find <input type="search" id="graph-search" placeholder="name, then Enter" autocomplete="off"></label>
    <span id="graph-found" class="hint" role="status"></span>
    <label class="hint"><input type="checkbox" id="graph-all"> Show all: also /rosout, and topics without a publisher</label>
  </div>
  <div class="wide" id="graph-picture" role="region" tabindex="0" aria-label="Nodes and topics"></div>
  <div class="panel">
    <div class="card"><h2 id="graph-title" aria-live="polite"></h2>
      <div id="graph-details"><p class="hint">Choose a node or a topic.</p></div></div>
  </div>`;
  static watches = { graph: false };

  #chosen = null; // "node /a" or "topic /b"
  #drawn = "";
  #scale = () => Math.min(1, Math.max(READABLE, this.#fits[0])); // until a person chooses another scale
  #size = { width: 1, height: 1 }; // of the picture in its own units
  #graph = { nodes: [], topics: [], edges: [] };

  constructor(link, watch) {
    this.watch = watch;
    this.picture = byId("graph-picture");
    link.on("graph", (graph) => this.#draw((this.#graph = graph)));
    byId("graph-all").onchange = () => this.#draw(this.#graph);
    byId("graph-in").onclick = () => this.#zoom(1.25);
    byId("graph-out").onclick = () => this.#zoom(0.8);
    byId("graph-fit").onclick = () => this.#resize(() => Math.min(1, ...this.#fits));
    byId("graph-search").oninput = () => this.#find(false);
    byId("graph-search").addEventListener("keydown", ({ key }) => key === "Enter" && this.#find(true));
    new ResizeObserver(() => this.#resize()).observe(this.picture);
  }

  show(on) {
    if (on) this.#draw(this.#graph);
    this.watch({ graph: on });
  }

  #choose(item) {
    this.#chosen = item;
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
    return [this.picture.clientWidth / this.#size.width, this.picture.clientHeight / this.#size.height];
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
    const grown = (this.#size.width * now) / drawn.width.baseVal.value;
    for (const side of ["width", "height"]) drawn.setAttribute(side, this.#size[side] * now);
    const scrolled = (start, size) => (start + size / 2) * grown - size / 2;
    this.picture.scrollTo(scrolled(scrollLeft, clientWidth), scrolled(scrollTop, clientHeight));
  }

  /** The boxes that have all words of the search in their names; the others are dimmed. */
  #search() {
    const words = byId("graph-search").value.toLowerCase().split(/\s+/).filter(Boolean);
    const boxes = [...this.picture.querySelectorAll("[data-item]")];
    const isFound = ({ dataset: { item } }) => words.every((word) => item.toLowerCase().includes(word));
    for (const box of boxes) box.classList.toggle("other", !isFound(box));
    const found = words.length ? boxes.filter(isFound) : [];
    say(byId("graph-found"), words.length ? `${found.length} of ${boxes.length}` : "");
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
    const items = this.#items(graph);
    const wanted = JSON.stringify([items, graph.edges]);
    if (wanted === this.#drawn) return;
    this.#drawn = wanted;
    const focused = this.picture.querySelector(":focus")?.dataset.item;
    const { width, height, boxes, arrows } = layout(items, graph.edges);
    const scrolled = [this.picture.scrollLeft, this.picture.scrollTop];
    this.#size = { width, height };
    const tip = (id) => svg("marker", { id, viewBox: "0 0 8 8", refX: 7, refY: 4, orient: "auto",
      markerUnits: "userSpaceOnUse", markerWidth: 10, markerHeight: 10 }, svg("path", { d: "M0 0 L8 4 L0 8 Z" }));
    const picture = svg("svg", { width, height, viewBox: `0 0 ${width} ${height}`, role: "group" },
      svg("defs", {}, tip("tip"), tip("chosen-tip")),
      ...arrows.map(({ from, to, path }) =>
        svg("path", { d: path, class: "arrow", "data-from": from, "data-to": to })),
      ...items.map((item) => this.#box(item, boxes[item])));
    this.picture.replaceChildren(items.length ? picture : element("p", { className: "hint" }, "No node is running."));
    this.#resize();
    this.picture.scrollTo(...scrolled);
    this.#mark();
    this.#search();
    if (this.#chosen) this.#showDetails();
    if (focused) this.picture.querySelector(`[data-item="${CSS.escape(focused)}"]`)?.focus();
  }

  /** What is drawn: everything, or everything except /rosout and topics without a publisher. */
  #items({ nodes, topics, edges }) {
    const items = [...nodes.map(({ name }) => `node ${name}`), ...topics.map(({ name }) => `topic ${name}`)];
    if (byId("graph-all").checked) return items;
    const published = new Set(edges.map(({ to }) => to));
    return items.filter((item) =>
      !DEBUG.includes(item) && (item.startsWith("node ") || published.has(item)));
  }

  #box(item, { x, y, w, h }) {
    const [kind, name] = item.split(" ");
    const [cx, cy] = [x + w / 2, y + h / 2];
    const shape = kind === "node"
      ? svg("ellipse", { cx, cy, rx: w / 2, ry: h / 2 })
      : svg("rect", { x, y, width: w, height: h, rx: 3 });
    const box = svg("g", { class: kind, "data-item": item, role: "button", tabindex: 0, "aria-label": item },
      shape, svg("text", { x: cx, y: cy + 5 }, brief(name)), svg("title", {}, name));
    box.onclick = () => this.#choose(item);
    box.onkeydown = (event) => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      this.#choose(item);
    };
    return box;
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
    const button = (item) => element(
      "button", { className: "link", onclick: () => this.#choose(item), title: item }, brief(item.split(" ")[1]));
    return items.length ? items.sort(byName).map(button) : "–";
  }
}
