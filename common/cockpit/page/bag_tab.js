/** The tab Bag: curves of a recording, and topics of it that are played. */

import { Chart } from "./chart.js";
import { byId, element, offer, say } from "./dom.js";
import { FieldList, fieldsOf, FIRST } from "./field_list.js";
import { Track, written } from "./samples.js";
import { JOY, TopicsToPlay } from "./topics_to_play.js";

/** Names of fields, with the entries of arrays; fields: [[name, length or 0], ...]. */
export function namesOf(fields, most) {
  return fields.flatMap(([name, length]) =>
    (length ? Array.from({ length: Math.min(length, most) }, (_, i) => `${name}[${i}]`) : [name]));
}

/** The fields that are drawn at first: a joystick's axes, or a robot's place, or the first ones. */
export function firstFields({ topics, fields }) {
  const names = namesOf(fields, FIRST);
  const of = (kind, part) => {
    const topic = topics.find(({ type }) => type === kind)?.name;
    return names.filter((name) => name.startsWith(`${topic}/${part}`));
  };
  const choices = [of(JOY, "axes["), of("nav_msgs/Odometry", "pose/pose/position/").slice(0, 2), names.slice(0, 3)];
  return choices.find((choice) => choice.length) ?? [];
}

export class BagTab {
  static title = "Bag";
  static panel = `
  <div class="card row">
    <label>Recording <select id="bag-name"></select></label>
    <button id="bag-open">Open</button>
    <span id="bag-about" role="status" aria-live="polite"></span>
    <button id="bag-record" disabled>Record all topics</button>
    <span id="bag-recorder" role="status"></span> <span id="bag-seconds"></span>
  </div>
  <div class="card chart"><div id="bag-chart" data-empty="Open a recording, then choose fields from the list."></div></div>
  <div class="card">
    <label class="long">Position <output id="bag-at">0.0 s</output>
      <input type="range" id="bag-position" min="0" max="1" step="0.01" value="0"></label>
    <p class="hint">Drag across the chart to zoom. <button id="bag-zoom">Whole range</button> <output id="bag-pointed"></output></p>
    <div class="row">
      <label>Rate <select id="bag-rate">
        <option value="0.25">¼</option><option value="0.5">½</option><option value="1" selected>1</option>
        <option value="2">2</option><option value="4">4</option></select></label>
      <label><input type="checkbox" id="bag-loop"> Loop</label>
      <button id="bag-play" class="primary" disabled>Publish</button>
      <button id="bag-pause" disabled>Pause</button>
      <span id="bag-state" role="status" aria-live="polite"></span>
    </div>
    <div class="legend" id="bag-values" role="group" aria-label="Values"></div>
  </div>
  <div class="abreast">
    <div class="card">${FieldList.panel("bag")}</div>
    <div class="card"><h2>Topics to publish</h2>
      <table><thead><tr><th>Topic</th><th>Messages</th></tr></thead>
        <tbody id="bag-topics"></tbody></table></div>
  </div>`;
  static watches = { bag: false, bag_fields: [] };

  #bag = null; // as the server described it
  #fields = []; // that are drawn
  #wanted = null; // what the address names: { name, fields }
  #tracks = {}; // field -> Track, once it has arrived
  #at = { playing: false, topics: [] }; // as the server says
  #refusals = { joystick: "", other: "" }; // why this page may not publish now
  #scrubbed = 0; // when the slider was last moved by hand
  #position = 0; // of the recording [s], which a zoomed slider may not show
  #recorded = ""; // the file that is recorded for any page
  #stopped = ""; // the file that this page has recorded, until it is offered

  constructor(link, watch, page) {
    this.link = link;
    this.watch = watch;
    this.page = page;
    this.chart = new Chart(byId("bag-chart"), () => this.#showValues(), () => this.#alignSlider());
    this.list = new FieldList("bag", {
      chosen: () => this.#fields,
      offered: (isSearch) => namesOf(this.#bag?.fields ?? [], isSearch ? Infinity : FIRST),
      choose: (field, on) => this.#choose(on ? [...this.#fields, field] : this.#fields.filter((other) => other !== field)),
      nothing: "The recording has no",
    });
    this.topics = new TopicsToPlay(() => this.#report(this.#at));
    this.#listen(link);
    byId("bag-open").onclick = () => this.#ask();
    byId("bag-record").onclick = () => {
      this.#stopped = this.#recorded;
      link.send("record", { on: !this.#recorded });
    };
    byId("bag-play").onclick = () => this.#play();
    byId("bag-pause").onclick = () => link.send("bag_pause");
    byId("bag-position").oninput = () => this.#seek(byId("bag-position").valueAsNumber);
    for (const id of ["bag-rate", "bag-loop"]) byId(id).onchange = () => this.#at.playing && this.#play();
    byId("bag-zoom").onclick = () => this.chart.wholeRange();
  }

  #listen(link) {
    link.on("bags", ({ names }) => {
      offer(byId("bag-name"), names.map((name) => [name]));
      const isNew = names.includes(this.#stopped);
      if (isNew) byId("bag-name").value = this.#stopped;
      if (isNew) this.#stopped = "";
      if (isNew && !this.#at.playing || names.length === 1 && !this.#bag && !this.#wanted) this.#ask();
    });
    link.on("recorder", ({ name, why, seconds }) => {
      this.#recorded = name;
      say(byId("bag-record"), name ? "Stop recording" : "Record all topics");
      say(byId("bag-recorder"), name ? `Recording ${name}` : why);
      say(byId("bag-seconds"), name ? `${seconds} s` : "");
    });
    link.on("bag", (bag) => this.#open(bag));
    link.on("bag_curve", ({ field, points }) => {
      this.#tracks[field] = new Track(points);
      this.#draw();
    });
    link.on("bag_at", (at) => this.#moveTo(at));
    link.on("bag_busy", ({ nodes, refusal }) => {
      this.#refusals.other = refusal;
      this.topics.tick(nodes);
    });
    link.on("drives", ({ refusal }) => {
      this.#refusals.joystick = refusal;
      this.#report(this.#at);
    });
    link.on("hello", ({ role }) => {
      byId("bag-record").disabled = role !== "driver";
      this.#report({ playing: false, topics: [] });
      const name = this.#wanted?.name ?? this.#bag?.path;
      if (name) link.send("bag_open", { name }); // The server of a new connection does not know it.
    });
  }

  show(on) {
    this.watch({ bag: on, bag_fields: on ? this.#fields : [] });
    if (on) requestAnimationFrame(() => this.#draw());
  }

  get place() {
    if (!this.#bag) return "";
    const query = [["name", this.#bag.path], ...this.#fields.map((field) => ["f", field])];
    return `?${new URLSearchParams(query)}`.replaceAll("%2F", "/");
  }

  go(_path, query) {
    const [name, fields] = [query.get("name"), fieldsOf(query)];
    if (!name) return;
    if (name === this.#bag?.path) {
      this.#choose(fields);
      this.list.list();
      return;
    }
    this.#wanted = { name, fields };
    if (this.link.isOpen) this.#ask(name);
  }

  #seek(position) {
    this.#scrubbed = performance.now();
    this.chart.pointed = null;
    this.#showPosition(position);
    this.link.send("bag_seek", { position });
  }

  #ask(name = byId("bag-name").value) {
    this.link.send("bag_open", { name });
  }

  #play() {
    this.link.send("bag_play", {
      topics: this.topics.chosen,
      rate: Number(byId("bag-rate").value),
      loop: byId("bag-loop").checked,
      robot: this.page.look(),
    });
  }

  #showPosition(position) {
    this.#position = position;
    say(byId("bag-at"), `${position.toFixed(1)} s`);
    this.chart.cursor = position;
    this.#showValues();
  }

  /** Give the slider the chart's scale. */
  #alignSlider() {
    const { left, right, from, to } = this.chart.seen;
    const position = byId("bag-position");
    position.style.marginLeft = `${left}px`;
    position.style.width = `calc(100% - ${left + right}px)`;
    Object.assign(position, { min: from, max: to, value: this.#position });
  }

  /** The values of the curves at the mouse, or at the position. */
  #showValues() {
    const { pointed } = this.chart;
    const t = pointed ?? this.#position;
    say(byId("bag-pointed"), pointed === null ? "" : `At ${t.toFixed(2)} s:`);
    for (const label of byId("bag-values").children) {
      const value = this.#tracks[label.dataset.field]?.at(t);
      say(label.querySelector("output"), value === undefined ? "–" : written(value));
    }
  }

  #open(bag) {
    const isSame = bag.path === this.#bag?.path; // on a new connection
    const fields = bag.path === this.#wanted?.name ? this.#wanted.fields : isSame ? this.#fields : [];
    this.#bag = bag;
    this.#wanted = null;
    this.#tracks = {};
    byId("bag-name").value = bag.path;
    const seconds = bag.end - bag.start;
    this.#position = Math.min(this.#position, seconds);
    const when = bag.start > 0 ? `, recorded ${new Date(bag.start * 1000).toLocaleString()}` : "";
    say(byId("bag-about"), `${bag.path}: ${seconds.toFixed(1)} s${when}`);
    byId("bag-position").max = seconds;
    this.topics.show(bag.topics);
    this.#choose(fields.length ? fields : firstFields(bag));
    this.list.list();
  }

  #choose(fields) {
    this.#fields = fields;
    byId("bag-values").replaceChildren(...fields.map((field, i) =>
      element("span", { "data-field": field }, this.chart.sample(i), `${field} `, element("output"))));
    if (!byId("bag").hidden) this.watch({ bag_fields: fields });
    this.list.limit();
    this.#showValues();
    this.#draw();
    this.page.moved();
  }

  #draw() {
    if (!this.#bag) return;
    const tracks = Object.fromEntries(this.#fields.map((field) => [field, this.#tracks[field] ?? new Track()]));
    this.chart.show(tracks, [0, Math.max(1, this.#bag.end - this.#bag.start)]);
    this.#showValues();
  }

  /** Without a connection nothing can be opened or published, and what the server publishes is unknown. */
  connect() {
    this.#report(this.#at);
  }

  #moveTo({ position, ...at }) {
    if (performance.now() - this.#scrubbed > 500) {
      byId("bag-position").value = position;
      this.#showPosition(position);
    }
    this.#report(at);
  }

  /** Why the chosen topics may not be published now, or "". */
  get #refusal() {
    const { chosen, joystick } = this.topics;
    if (!this.#bag) return "";
    if (!chosen.length) return "Choose topics to publish.";
    const { joystick: why, other } = this.#refusals;
    if (other || !joystick || !why) return other;
    return chosen.length === 1 ? why : `${why} Without ${joystick} the others can be published.`;
  }

  #report(at) {
    this.#at = at;
    const { isOpen } = this.link;
    const isPlaying = isOpen && at.playing;
    const refusal = this.#refusal;
    byId("bag-open").disabled = byId("bag-position").disabled = !isOpen;
    byId("bag-play").disabled = !isOpen || !this.#bag || Boolean(refusal);
    byId("bag-pause").disabled = !isPlaying;
    const what = at.topics.length === 1 ? at.topics[0] : `${at.topics.length} topics`;
    const publishes = isPlaying ? `Publishing ${what}.${this.topics.mayMove ? " Pause stops the robot." : ""}` : refusal;
    say(byId("bag-state"), isOpen ? publishes : "Not connected.");
  }
}
