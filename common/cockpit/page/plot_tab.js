/** The tab Plot: any numeric field of any topic over time or against another field, and whole arrays. */

import { Chart } from "./chart.js";
import { byId, element, offer, save, say } from "./dom.js";
import { FieldList, fieldsOf, FIRST } from "./field_list.js";
import { rowsAgainst, rowsOfArrays, Track, written } from "./samples.js";

const MOST_ROWS = 4000; // against another field
const KEEP_S = 600; // the longest window; shorter for a fast topic, see MOST in samples.js
const DRAW_MS = 100;
const SET_BACK_S = 1; // by this much or more

/** The index of the first of [[t, value], ...] since time was set back, as by a bag that loops, or -1. */
function setBack(points, last) {
  const times = [last, ...points.map(([t]) => t)];
  return points.findLastIndex(([t], i) => t < times[i] - SET_BACK_S);
}

/** A field without the parts that the list of fields lacks: indices, and the two numbers of a time. */
const plain = (field) => field.replaceAll(/\[\d+\]|\/n?secs$/g, "");

export class PlotTab {
  static title = "Plot";
  static panel = `
  <div class="wide">
    <div class="card row">
      <button id="plot-pause" aria-pressed="false">Pause</button>
      <button id="plot-zoom">Whole range</button>
      <button id="plot-clear">Clear</button>
      <label>Last <select id="plot-window">
        <option value="10">10 s</option><option value="30" selected>30 s</option>
        <option value="120">2 min</option><option value="600">10 min</option></select></label>
      <label>against <select id="plot-x"></select></label>
      <label hidden><input type="checkbox" id="plot-equal"> equal scales</label>
      <button id="plot-csv">Save CSV</button>
      <button id="plot-png">Save PNG</button>
    </div>
    <div class="card chart"><div id="plot-chart" data-empty="Choose fields from the list."></div></div>
    <p class="hint">Drag or turn the wheel to zoom; hold Shift to pan; Whole range undoes it. <output id="plot-at"></output></p>
    <p class="row" id="plot-missing" role="status"></p>
    <div class="legend" id="plot-values" role="group" aria-label="Values"></div>
  </div>
  <div class="panel">
    <div class="card">${FieldList.panel("plot")}</div>
  </div>`;
  static watches = { fields: [], field_list: false };

  #samples = {}; // field -> Track, times since #zero
  #other = null; // the horizontal axis if it is not time, as the chart has it
  #zero = null; // time of the first sample [s]
  #all = [];
  #fresh = false;
  #frozen = null; // the newest time that is shown while the plot is paused

  constructor(link, watch, page) {
    this.watch = watch;
    this.page = page;
    this.chart = new Chart(byId("plot-chart"), () => this.#showValues(this.chart.points));
    this.list = new FieldList("plot", {
      chosen: () => this.fields,
      offered: (isSearch) => [...this.#entries(isSearch), ...this.#all],
      choose: (field, on) => this.#choose(field, on),
      nothing: "No published topic has",
    });
    link.on("fields", ({ fields }) => {
      if (fields.join() === this.#all.join()) return; // The list is not rebuilt while it is in use.
      this.#all = fields;
      this.#list();
    });
    link.on("plot", ({ samples }) => this.#take(samples));
    byId("plot-window").onchange = byId("plot-equal").onchange = () => this.#showLast(byId("plot-window").value);
    byId("plot-x").onchange = () => {
      this.#against();
      this.#showLast(byId("plot-window").value);
    };
    byId("plot-pause").onclick = () => this.#pause(this.#frozen === null);
    byId("plot-zoom").onclick = () => this.#showLast(KEEP_S);
    byId("plot-clear").onclick = () => this.#clear();
    byId("plot-csv").onclick = () => this.#saveCsv();
    byId("plot-png").onclick = () => this.chart.picture().toBlob((blob) => save(blob, "plot.png"));
    setInterval(() => this.#draw(), DRAW_MS);
  }

  show(on) {
    this.#fresh = on;
    this.watch({ field_list: on, fields: this.fields });
  }

  get place() {
    const query = this.fields.map((field) => ["f", field]);
    if (query.length) query.push(["last", byId("plot-window").value]);
    if (byId("plot-x").value) query.push(["x", byId("plot-x").value]);
    return query.length ? `?${new URLSearchParams(query)}`.replaceAll("%2F", "/") : "";
  }

  go(_path, query) {
    const fields = fieldsOf(query);
    const tracks = fields.map((field) => [field, this.#samples[field] ?? new Track()]);
    this.#samples = Object.fromEntries(tracks);
    const last = Math.min(KEEP_S, Math.max(1, Math.round(Number(query.get("last")) || 30)));
    this.#list();
    byId("plot-x").value = fields.includes(query.get("x")) ? query.get("x") : "";
    this.#against();
    this.#showLast(last);
  }

  get fields() {
    return Object.keys(this.#samples);
  }

  #take(samples) {
    const known = Object.entries(samples).filter(([field]) => this.#samples[field]);
    const isArray = ([, [[, value]]]) => Array.isArray(value);
    for (const [field, points] of known.filter(isArray)) {
      const [before, now] = [this.#samples[field].entries, points.at(-1)[1]];
      if (this.#frozen === null) this.#samples[field].entries = now;
      if (before?.length !== now.length) this.#list();
    }
    const wanted = known.filter((one) => !isArray(one));
    const begins = wanted.map(([field, points]) => setBack(points, this.#samples[field].newest + this.#zero));
    if (begins.some((i) => i >= 0)) this.#clear(); // All earlier samples belong to another time.
    for (const [field, points] of wanted) {
      const track = this.#samples[field];
      for (const [t, value] of points.slice(Math.max(0, begins.shift()))) {
        this.#zero ??= t;
        track.push(t - this.#zero, value);
      }
      track.forget(track.newest - KEEP_S);
    }
    this.#fresh ||= this.#frozen === null;
  }

  get #newest() {
    return this.#frozen ?? Math.max(...Object.values(this.#samples).map(({ newest }) => newest), 0);
  }

  #draw() {
    if (byId("plot").hidden || !this.#fresh) return;
    const from = Math.max(0, this.#newest - Number(byId("plot-window").value));
    this.#other = this.#across(from);
    this.chart.show(this.#samples, [from, Math.max(this.#newest, from + 1)], this.#other);
    this.#fresh = false;
    this.#showValues(this.#other ? this.chart.points : []);
  }

  /** The horizontal axis and its rows if it is not time. */
  #across(from) {
    const all = Object.values(this.#samples);
    if (all.some(({ entries }) => entries?.length)) return { label: "index", rows: rowsOfArrays(all) };
    const label = byId("plot-x").value;
    if (!label) return null;
    const tracks = Object.entries(this.#samples).map(([field, track]) => (field === label ? new Track() : track));
    const rows = rowsAgainst(this.#samples[label], tracks, from, this.#newest, MOST_ROWS);
    return { label, rows, isEqual: byId("plot-equal").checked };
  }

  /** Two coordinates of one thing have one unit, so a circle is drawn as a circle. */
  #against() {
    const label = byId("plot-x").value;
    const others = this.fields.filter((field) => field !== label);
    const parent = (field) => field.replace(/[^/.]*$/, "");
    byId("plot-equal").checked = others.every((field) => parent(field) === parent(label));
    byId("plot-equal").parentElement.hidden = !label;
  }

  /** The values at the mouse (those of a point if one is drawn there), or the newest. */
  #showValues(points) {
    const { pointed } = this.chart;
    const t = pointed ?? this.#newest;
    const unit = this.#other ? ` of ${this.#other.label}` : " s";
    say(byId("plot-at"), pointed === null ? "" : `At ${t.toFixed(2)}${unit}:`);
    byId("plot-values").replaceChildren(...Object.entries(this.#samples).map(([field, track], i) => {
      const drawn = points.find(({ name, yval }) => name === field && !Number.isNaN(yval))?.yval;
      const across = field === this.#other?.label ? pointed : null;
      const value = drawn ?? across ?? track.at(this.#other ? this.#newest : t);
      const none = track.entries ? `${track.entries.length} entries` : "–";
      return element("span", { "data-field": field }, this.chart.sample(i), `${field} `,
        element("output", {}, value === undefined ? none : written(value)));
    }));
  }

  /** The entries of the chosen arrays. */
  #entries(isSearch) {
    return Object.entries(this.#samples).flatMap(([field, track]) =>
      track.entries?.slice(0, isSearch ? undefined : FIRST).map((_, i) => `${field}[${i}]`) ?? []);
  }

  #list() {
    this.list.list();
    this.#limit();
  }

  #limit() {
    offer(byId("plot-x"), [["", "time"], ...this.fields.map((field) => [field])]);
    this.list.limit();
    const known = new Set(this.#all.map(plain));
    const missing = known.size ? this.fields.filter((field) => !known.has(plain(field))) : []; // once the list is there
    say(byId("plot-missing"), missing.length
      ? `No published topic has ${missing.join(" or ")}: a curve begins once its topic is published.` : "");
  }

  #choose(field, on) {
    if (on) this.#samples[field] = new Track();
    else delete this.#samples[field];
    if (!this.fields.length) this.#zero = null;
    this.watch({ fields: this.fields });
    this.#fresh = true;
    this.#limit();
    this.#against();
    this.page.moved();
  }

  /** Show the last seconds, whatever the zoom was. */
  #showLast(seconds) {
    byId("plot-window").value = seconds;
    if (!byId("plot-window").value) byId("plot-window").append(new Option(`${seconds} s`, seconds, true, true));
    this.chart.wholeRange();
    this.#fresh = true;
    this.page.moved();
  }

  #pause(on) {
    this.#frozen = on ? this.#newest : null;
    byId("plot-pause").setAttribute("aria-pressed", String(on));
    say(byId("plot-pause"), on ? "Resume" : "Pause");
    this.#fresh = true;
  }

  #clear() {
    for (const track of Object.values(this.#samples)) track.clear();
    this.#zero = null;
    this.#frozen &&= 0;
    this.#fresh = true;
  }

  /** A row for each sample; the browser keeps the fields outside the page's own memory. */
  #saveCsv() {
    const fields = Object.entries(this.#samples).map(([field, { times, values }]) =>
      new Blob(times.map((t, i) => `${t + this.#zero},${field},${values[i]}\n`)));
    save(new Blob(["time,field,value\n", ...fields], { type: "text/csv" }), "plot.csv");
  }
}
