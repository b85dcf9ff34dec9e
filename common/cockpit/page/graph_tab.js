/** The tab Graph: the nodes and their topics, live. */

import { byId, element, say } from "./dom.js";
import { layout } from "./graph_layout.js";

// Every node is connected to /rosout, which would hide the rest; as draw_graph has it.
const DEBUG = ["node /rosout", "topic /rosout", "topic /rosout_agg", "topic /statistics"];
const LEAST_SCALE = 0.7; // to which the picture shrinks before it is scrolled
const SVG = "http://www.w3.org/2000/svg";

function svg(tag, attributes = {}, ...children) {
  const made = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

const PANEL = `
  <label class="hint"><input type="checkbox" id="graph-all"> Show all: also /rosout, and topics without a publisher</label>
  <div class="wide" id="graph-picture" tabindex="0" aria-label="Nodes and topics"></div>
  <div class="panel">
    <div class="card" id="graph-details" aria-live="polite"><p class="hint">Choose a node or a topic.</p></div>
  </div>`;

export class GraphTab {
  static title = "Graph";
  static panel = PANEL;
  static watches = { graph: false, topic: null, node: null };

  #chosen = null; // "node /a" or "topic /b"
  #drawn = "";
  #graph = { nodes: [], topics: [], edges: [] };

  constructor(link, watch) {
    this.watch = watch;
    this.picture = byId("graph-picture");
    this.details = byId("graph-details");
    link.on("graph", (graph) => this.#draw(graph));
    byId("graph-all").onchange = () => this.#draw(this.#graph);
    link.on("topic", (topic) => this.#chosen === `topic ${topic.name}` && this.#showTopic(topic));
    link.on("node", (node) => this.#chosen === `node ${node.name}` && this.#showNode(node));
  }

  show(on) {
    this.watch({ graph: on, ...this.#asked(on ? this.#chosen : null) });
  }

  #asked(item) {
    const [kind, name] = item?.split(" ") ?? [];
    return { topic: null, node: null, ...(kind && { [kind]: name }) };
  }

  #choose(item) {
    this.#chosen = item;
    this.details.replaceChildren(element("p", { className: "hint" }, "…"));
    this.#mark();
    this.watch(this.#asked(item));
  }

  #mark() {
    for (const part of this.picture.querySelectorAll("[data-item], [data-from]")) {
      const { item, from, to } = part.dataset;
      part.classList.toggle("chosen", this.#chosen !== null && [item, from, to].includes(this.#chosen));
    }
  }

  #draw(graph) {
    this.#graph = graph;
    const items = this.#items(graph);
    const wanted = JSON.stringify([items, graph.edges]);
    if (wanted === this.#drawn) return;
    this.#drawn = wanted;
    const focused = document.activeElement?.dataset?.item;
    const { width, height, boxes, arrows } = layout(items, graph.edges);
    const tip = { id: "tip", viewBox: "0 0 8 8", refX: 7, refY: 4, markerUnits: "userSpaceOnUse",
      markerWidth: 10, markerHeight: 10, orient: "auto" };
    const picture = svg("svg", { width, height, viewBox: `0 0 ${width} ${height}`, role: "group" },
      svg("defs", {}, svg("marker", tip, svg("path", { d: "M0 0 L8 4 L0 8 Z" }))),
      ...arrows.map(({ from, to, path }) => svg("path", { d: path, class: "arrow", "data-from": from,
        "data-to": to, "marker-end": "url(#tip)" })),
      ...items.map((item) => this.#box(item, boxes[item])));
    picture.style.minWidth = `${width * LEAST_SCALE}px`;
    this.picture.replaceChildren(items.length ? picture : element("p", { className: "hint" }, "No node is running."));
    this.#mark();
    if (focused) this.picture.querySelector(`[data-item="${CSS.escape(focused)}"]`)?.focus();
  }

  /** What is drawn: all, or all but /rosout and topics without a publisher. */
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
      shape, svg("text", { x: cx, y: cy + 5 }, name));
    box.onclick = () => this.#choose(item);
    box.onkeydown = (event) => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      this.#choose(item);
    };
    return box;
  }

  #fill(kind, name, entries) {
    const list = entries.map(([title, key, value]) => element("div", {},
      element("dt", {}, title), element("dd", { "data-value": key }, ...[value].flat())));
    this.details.replaceChildren(
      element("h2", {}, `${kind} ${name}`), element("dl", { className: "details" }, ...list));
  }

  /** Buttons that choose other nodes or topics, or a dash. */
  #links(kind, names) {
    if (!names?.length) return "–";
    const choose = (name) => () => this.#choose(`${kind} ${name}`);
    return names.map((name) => element("button", { className: "link", onclick: choose(name) }, name));
  }

  #showTopic({ name, type, rate, publishers, subscribers, last }) {
    const old = this.details.querySelector("[data-value=last] pre");
    const isSame = this.details.querySelector("h2")?.textContent === `Topic ${name}`;
    const newest = last || "none yet";
    const perSecond = last && Number.isFinite(rate) ? `${rate.toFixed(1)} Hz` : "–";
    if (isSame && old) { // only what changes, so that a link keeps the keyboard
      say(this.details.querySelector("[data-value=rate]"), perSecond);
      say(old, newest);
      return;
    }
    this.#fill("Topic", name, [
      ["Type", "type", type], ["Rate", "rate", perSecond],
      ["Publishers", "publishers", this.#links("node", publishers)],
      ["Subscribers", "subscribers", this.#links("node", subscribers)],
      ["Last message", "last", element("pre", {}, newest)],
    ]);
  }

  #showNode({ name, machine, pid, speaks_to: speaksTo, publishes, subscribes, services }) {
    this.#fill("Node", name, [
      ["Machine", "machine", machine || "–"], ["Process", "pid", String(pid ?? "–")],
      ["Publishes", "publishes", this.#links("topic", publishes)],
      ["Subscribes to", "subscribes", this.#links("topic", subscribes)],
      ["Connected to", "speaks_to", this.#links("node", speaksTo)],
      ["Services", "services", services?.join(", ") || "–"],
    ]);
  }
}
