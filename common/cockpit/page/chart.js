/** Curves over time, drawn by dygraphs: several series, each with times of its own. */

import { element } from "./dom.js";

// Distinct on light and dark backgrounds, and for most colour-blind readers.
const COLOURS = ["#2b83d6", "#d9700a", "#1f9e6e", "#c2438f", "#8a6fd1", "#a38712", "#d6403a", "#3fa9b5"];
// Where the colours begin again, lines are broken: lengths of strokes and gaps [px], and their name in CSS.
const STROKES = [null, [7, 3], [2, 3]];
const BORDERS = ["solid", "dashed", "dotted"];

let library = null;

/** Load dygraphs once it is needed; a phone that only drives does without. */
function loadLibrary() {
  library ??= new Promise((resolve) => {
    const script = document.createElement("script");
    script.onload = () => {
      // Its legend, which is not used, writes style attributes, which the page's policy forbids.
      const { Dygraph } = globalThis;
      Dygraph.PLUGINS = Dygraph.PLUGINS.filter((plugin) => plugin !== Dygraph.Plugins.Legend);
      resolve();
    };
    script.src = "/lib/dygraph.min.js";
    document.head.append(script);
  });
  return library;
}

export class Chart {
  #graph = null;
  #wanted = null; // what is to be shown once the library is there
  #labels = [];
  #cursor = null;
  #window = null; // [from, to], as the page itself has set it last

  /** root: the element. options: of dygraphs, beside those below. */
  constructor(root, options = {}) {
    this.root = root;
    this.options = options;
    new ResizeObserver(() => this.#graph?.resize()).observe(root);
  }

  colour(i) {
    return COLOURS[i % COLOURS.length];
  }

  #stroke(i) {
    return Math.floor(i / COLOURS.length) % STROKES.length;
  }

  /** An element that looks as the line of a series. */
  sample(i) {
    const made = element("i", { className: "sample" });
    made.style.borderTop = `4px ${BORDERS[this.#stroke(i)]} ${this.colour(i)}`;
    return made;
  }

  /** Whether a person chose what is shown. dygraphs calls it zoomed, too, when the page has set the window. */
  get isZoomed() {
    const [from, to] = this.#graph?.xAxisRange() ?? [];
    return Boolean(this.#graph?.isZoomed("x")) && !(from === this.#window?.[0] && to === this.#window?.[1]);
  }

  wholeRange() {
    this.#graph?.resetZoom();
  }

  /** series: {label: [[t, value], ...]}; window: [from, to] to be shown unless zoomed, or null. */
  show(series, window = null) {
    if (!this.root.clientWidth) return; // another tab is shown
    if (!globalThis.Dygraph) {
      if (!this.#wanted) loadLibrary().then(() => this.show(...this.#wanted));
      this.#wanted = [series, window];
      return;
    }
    const labels = Object.keys(series);
    const rows = merged(Object.values(series));
    if (!labels.length || !rows.length) {
      this.#graph?.destroy();
      this.#graph = null;
      return;
    }
    const same = JSON.stringify(labels) === JSON.stringify(this.#labels);
    const range = window && !this.isZoomed ? { dateWindow: window } : {};
    if (range.dateWindow) this.#window = [...window];
    if (this.#graph && same) {
      this.#graph.updateOptions({ file: rows, ...range });
      return;
    }
    this.#graph?.destroy();
    this.#labels = labels;
    this.#graph = new globalThis.Dygraph(this.root, rows, {
      labels: ["time [s]", ...labels],
      xlabel: "time [s]",
      colors: labels.map((_, i) => this.colour(i)),
      series: Object.fromEntries(labels.map((label, i) => [label, { strokePattern: STROKES[this.#stroke(i)] }])),
      connectSeparatedPoints: true,
      axisLineColor: "#8888",
      gridLineColor: "#8883",
      strokeWidth: 1.6,
      animatedZooms: false,
      underlayCallback: (pen, area, graph) => this.#drawCursor(pen, area, graph),
      ...range,
      ...this.options,
    });
  }

  setVisible(i, on) {
    this.#graph?.setVisibility(i, on);
  }

  /** A line at a time, or none (null). */
  set cursor(t) {
    if (t === this.#cursor) return;
    this.#cursor = t;
    this.#graph?.updateOptions({}); // draws anew
  }

  #drawCursor(pen, area, graph) {
    if (this.#cursor === null) return;
    const x = graph.toDomXCoord(this.#cursor);
    pen.fillStyle = "#e0433a";
    if (x >= area.x && x <= area.x + area.w) pen.fillRect(x - 1, area.y, 2, area.h);
  }

  /** The picture as it is seen, with axes and labels: a canvas. */
  picture() {
    const { clientWidth: width, clientHeight: height } = this.root;
    const ratio = devicePixelRatio || 1;
    const canvas = document.createElement("canvas");
    canvas.width = width * ratio;
    canvas.height = (height + 24) * ratio;
    const pen = canvas.getContext("2d");
    const style = getComputedStyle(document.body);
    pen.fillStyle = style.backgroundColor;
    pen.fillRect(0, 0, canvas.width, canvas.height);
    pen.scale(ratio, ratio);
    for (const layer of this.root.querySelectorAll("canvas")) pen.drawImage(layer, 0, 0, width, height);
    pen.font = "12px system-ui, sans-serif";
    pen.textBaseline = "middle";
    pen.textAlign = "center";
    pen.fillStyle = style.color;
    const corner = this.root.getBoundingClientRect();
    for (const label of this.root.querySelectorAll(".dygraph-axis-label, .dygraph-xlabel")) {
      const box = label.getBoundingClientRect();
      const [x, y] = [box.left + box.width / 2 - corner.left, box.top + box.height / 2 - corner.top];
      pen.fillText(label.textContent, x, y);
    }
    pen.textAlign = "left";
    let x = 8;
    this.#labels.forEach((label, i) => {
      pen.fillStyle = pen.strokeStyle = this.colour(i);
      pen.lineWidth = 3;
      pen.setLineDash(STROKES[this.#stroke(i)] ?? []);
      pen.beginPath();
      pen.moveTo(x, height + 12);
      pen.lineTo(x + 18, height + 12);
      pen.stroke();
      pen.fillText(label, x + 22, height + 12);
      x += pen.measureText(label).width + 38;
    });
    return canvas;
  }
}

/** Rows [t, value or null of each series] in the order of time, from [[[t, value], ...], ...]. */
export function merged(all) {
  const rows = new Map();
  all.forEach((points, i) => {
    for (const [t, value] of points) {
      if (!rows.has(t)) rows.set(t, [t, ...all.map(() => null)]);
      rows.get(t)[i + 1] = value;
    }
  });
  return [...rows.values()].sort((a, b) => a[0] - b[0]);
}
