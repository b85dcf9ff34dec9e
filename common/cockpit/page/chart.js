/** Curves over time, drawn by dygraphs: several series, each with its own times. */

import { element } from "./dom.js";
import { mark, rowsOf } from "./samples.js";

const MOST_POINTS = 8000; // drawn at once; a frame with more takes too long
const MARK_PX = 30; // between two marks of the axis, as in dygraphs
const TIME = "time [s]"; // the axis across, unless another one is chosen
const RETRY_MS = 1000;

// Distinct on light and dark backgrounds, and for most colour-blind readers.
const COLOURS = ["#2b83d6", "#d9700a", "#1f9e6e", "#c2438f", "#8a6fd1", "#a38712", "#d6403a", "#3fa9b5"];
// When the colours repeat, lines are dashed: strokes and gaps [px], and their name in CSS.
const STROKES = [[null, "solid"], [[7, 3], "dashed"], [[2, 3], "dotted"]];

/** How the line of series i is drawn. */
function style(i) {
  const [pattern, border] = STROKES[Math.floor(i / COLOURS.length) % STROKES.length];
  return { colour: COLOURS[i % COLOURS.length], pattern, border };
}

/** The range of numbers, some of which may be null, with a small margin. */
function around(values) {
  let [least, most] = [Infinity, -Infinity];
  for (const value of values) {
    if (value === null) continue;
    if (value < least) least = value;
    if (value > most) most = value;
  }
  if (least > most) return [0, 1];
  const edge = (most - least) * 0.05 || 1;
  return [least - edge, most + edge];
}

/** The range with the same middle whose length is `length`. */
function centred([from, to], length) {
  return [(from + to - length) / 2, (from + to + length) / 2];
}

const page = /** @type {any} */ (globalThis); // which defines Dygraph

/** Load dygraphs when it is first needed, and retry until that succeeds; driving does not need it. */
async function loadLibrary() {
  for (let attempt = 0; !page.Dygraph; attempt++) {
    // A browser remembers by its address that a module failed to load.
    const loaded = import(`/lib/dygraph.min.js?${attempt}`);
    await loaded.catch(() => new Promise((resolve) => setTimeout(resolve, RETRY_MS)));
  }
  // Its legend is not used: it writes style attributes, which the page's policy forbids.
  const { Dygraph } = page;
  Dygraph.PLUGINS = Dygraph.PLUGINS.filter((plugin) => plugin !== Dygraph.Plugins.Legend);
}

export class Chart {
  #graph = null;
  #wanted = null; // what to show, once the library is loaded
  #library = null; // the promise of it
  #labels = []; // of the axis across, and of each series
  #cursor = null;
  pointed = null; // the time [s] at which the mouse points, or null
  points = []; // of the curves there: {name, yval}
  #window = []; // from, to: as the page has set it last
  #drawn = ""; // the part of the time for which samples were chosen

  /**
   * root: the element. onPoint(): the mouse points somewhere else. onRange(): another part of the
   * time is seen.
   */
  constructor(root, onPoint, onRange = () => {}) {
    this.root = root;
    this.onPoint = onPoint;
    this.onRange = onRange;
    new ResizeObserver(() => this.#graph?.resize()).observe(root);
    root.addEventListener("wheel", (event) => this.#turn(event), { passive: false });
  }

  /** An element that looks like the line of a series. */
  sample(i) {
    return element("i", { className: "sample", style: `border-top: 4px ${style(i).border} ${style(i).colour}` });
  }

  /** Whether a person chose the visible range. To dygraphs, a window that the page has set is zoomed, too. */
  get isZoomed() {
    return Boolean(this.#graph?.isZoomed("x")) && this.#graph.xAxisRange().join() !== this.#window.join();
  }

  wholeRange() {
    this.#point(null, []);
    this.#graph?.resetZoom();
  }

  /** The visible part, if there are curves: {left, right} [px] in the element, {from, to} [s]. */
  get seen() {
    const [{ x, w }, [from, to]] = [this.#graph.getArea(), this.#graph.xAxisRange()];
    return { left: x, right: this.root.clientWidth - x - w, from, to };
  }

  /** The wheel zooms at the mouse; with Shift, or sideways, it pans. */
  #turn(event) {
    if (!this.#graph) return;
    event.preventDefault();
    const [from, to] = this.#graph.xAxisRange();
    const { deltaX, deltaY, shiftKey, offsetX } = event;
    const aside = ((shiftKey ? deltaY : deltaX) / 1000) * (to - from);
    const factor = shiftKey ? 1 : Math.exp(deltaY / 400);
    const at = this.#graph.toDataXCoord(offsetX);
    this.#graph.updateOptions({ dateWindow: [from, to].map((t) => at + (t - at) * factor + aside) });
  }

  /** If both axes have one unit: ranges around the visible part in which a circle is drawn as a circle. */
  #equal(across, up) {
    const { w, h } = this.#graph?.getArea() ?? { w: this.root.clientWidth, h: this.root.clientHeight };
    const perPixel = Math.max((across[1] - across[0]) / w, (up[1] - up[0]) / h);
    return { dateWindow: centred(across, perPixel * w), valueRange: centred(up, perPixel * h) };
  }

  /**
   * tracks: {label: Track}; window: [from, to] [s] to be shown unless a person has zoomed.
   * other: {label, rows, isEqual} of another axis across than time, or null; isEqual: both have one unit.
   */
  show(tracks, window, other = null) {
    this.#wanted = [tracks, window, other];
    if (!this.root.clientWidth) return; // another tab is shown
    if (!page.Dygraph) {
      if (!this.#library) this.#library = loadLibrary().then(() => this.show(...this.#wanted));
      return;
    }
    const labels = [other?.label ?? TIME, ...Object.keys(tracks)];
    const [from, to] = this.isZoomed ? this.#graph.xAxisRange() : window;
    const columns = Math.min(this.root.clientWidth, MOST_POINTS / 2 / Math.max(1, labels.length - 1));
    const rows = other?.rows ?? rowsOf(Object.values(tracks), from, to, columns);
    const isSame = rows.length && JSON.stringify(labels) === JSON.stringify(this.#labels);
    if (other) window = around(rows.map(([x]) => x));
    let range = this.isZoomed ? {} : { dateWindow: window, valueRange: null };
    if (other?.isEqual && !this.isZoomed) range = this.#equal(window, around(rows.flatMap(([, ...ys]) => ys)));
    if (range.dateWindow) this.#window = [...range.dateWindow];
    this.#drawn = [from, to].join();
    if (this.#graph && isSame) {
      this.#graph.updateOptions({ file: rows, ...range });
      return;
    }
    this.#graph?.destroy();
    this.#graph = null; // also while the next one is made, which calls #look()
    this.#labels = labels;
    if (rows.length) this.#graph = this.#make(labels, rows, range);
    if (this.#graph) this.onRange();
  }

  /** If another part is visible, as after a zoom, choose its samples, or the other axis' range. */
  #look() {
    if (!this.#graph) return; // it is being made
    this.onRange();
    const other = this.#wanted[2];
    const [across, up] = [this.#graph.xAxisRange(), this.#graph.yAxisRange()];
    if (!other && across.join() !== this.#drawn) requestAnimationFrame(() => this.show(...this.#wanted));
    if (!other?.isEqual) return;
    const { w, h } = this.#graph.getArea();
    const height = ((across[1] - across[0]) / w) * h;
    if (Math.abs(height / (up[1] - up[0]) - 1) < 0.001) return;
    requestAnimationFrame(() => this.#graph?.updateOptions({ valueRange: centred(up, height) }));
  }

  #make(labels, rows, range) {
    const [across, ...series] = labels;
    return new page.Dygraph(this.root, rows, {
      labels,
      xlabel: across,
      colors: series.map((_, i) => style(i).colour),
      series: Object.fromEntries(series.map((name, i) => [name, { strokePattern: style(i).pattern }])),
      connectSeparatedPoints: across === TIME, // the series have times of their own
      axisLineColor: "#8888",
      gridLineColor: "#8883",
      strokeWidth: 1.6,
      animatedZooms: false,
      underlayCallback: (pen, area, graph) => this.#drawCursor(pen, area, graph),
      highlightCallback: (_, t, points) => this.#point(t, points),
      unhighlightCallback: () => this.#point(null, []),
      drawCallback: () => this.#look(),
      axes: { y: { axisLabelWidth: 96, axisLabelFormatter: (value, _, __, graph) => this.#mark(value, graph) } },
      ...range,
    });
  }

  #point(t, points) {
    this.pointed = t;
    this.points = points;
    this.onPoint();
  }

  #mark(value, graph) {
    const [low, high] = graph.yAxisRange();
    return mark(value, ((high - low) * MARK_PX) / Math.max(MARK_PX, this.root.clientHeight));
  }

  setVisible(i, on) {
    this.#graph?.setVisibility(i, on);
  }

  /** A line at a time [s]. */
  set cursor(t) {
    if (t === this.#cursor) return;
    this.#cursor = t;
    this.#graph?.updateOptions({}); // draws again
  }

  #drawCursor(pen, area, graph) {
    if (this.#cursor === null) return;
    const x = graph.toDomXCoord(this.#cursor);
    pen.fillStyle = "#e0433a";
    if (x >= area.x && x <= area.x + area.w) pen.fillRect(x - 1, area.y, 2, area.h);
  }

  /** A canvas with the picture, its axes and its labels. */
  picture() {
    const { clientWidth: width, clientHeight: height } = this.root;
    const ratio = devicePixelRatio || 1;
    const canvas = element("canvas", { width: width * ratio, height: (height + 24) * ratio });
    const pen = canvas.getContext("2d");
    const { backgroundColor, color } = getComputedStyle(document.body);
    pen.scale(ratio, ratio);
    pen.fillStyle = backgroundColor;
    pen.fillRect(0, 0, width, height + 24);
    for (const layer of this.root.querySelectorAll("canvas")) pen.drawImage(layer, 0, 0, width, height);
    Object.assign(pen, { font: "12px system-ui, sans-serif", fillStyle: color });
    Object.assign(pen, { textAlign: "center", textBaseline: "middle" });
    const corner = this.root.getBoundingClientRect();
    for (const label of this.root.querySelectorAll(".dygraph-axis-label, .dygraph-xlabel")) {
      const box = label.getBoundingClientRect();
      pen.fillText(label.textContent, box.x + box.width / 2 - corner.x, box.y + box.height / 2 - corner.y);
    }
    this.#drawLegend(pen, height + 12);
    return canvas;
  }

  #drawLegend(pen, y) {
    pen.textAlign = "left";
    pen.lineWidth = 3;
    let x = 8;
    this.#labels.slice(1).forEach((label, i) => {
      pen.fillStyle = pen.strokeStyle = style(i).colour;
      pen.setLineDash(style(i).pattern ?? []);
      pen.beginPath();
      pen.moveTo(x, y);
      pen.lineTo(x + 18, y);
      pen.stroke();
      pen.fillText(label, x + 22, y);
      x += pen.measureText(label).width + 38;
    });
  }
}
