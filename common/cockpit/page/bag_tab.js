/** The tab Bag: a recording's curves and timeline, and its publication in a joystick's place. */

import { Chart } from "./chart.js";
import { byId, element, offer, row, say } from "./dom.js";
import { Track, written } from "./samples.js";

const EMPTY = "Open a recording to see its curves.";

export class BagTab {
  static title = "Bag";
  static panel = `
  <div class="card row">
    <label>Recording <select id="bag-name"></select></label>
    <button id="bag-open">Open</button>
    <span id="bag-about" role="status" aria-live="polite"></span>
    <button id="bag-record" disabled>Record all topics</button>
    <span id="bag-recorder" role="status"></span>
  </div>
  <div class="card chart"><div id="bag-chart" data-empty="${EMPTY}"></div></div>
  <div class="card">
    <label class="long">Position <output id="bag-at">0.0 s</output>
      <input type="range" id="bag-position" min="0" max="1" step="0.01" value="0"></label>
    <p class="hint">Drag across the chart to zoom. <button id="bag-zoom">Whole range</button> <output id="bag-pointed"></output></p>
    <div class="row">
      <label>Topic <select id="bag-topic"></select></label>
      <label>Rate <select id="bag-rate">
        <option value="0.25">¼</option><option value="0.5">½</option><option value="1" selected>1</option>
        <option value="2">2</option><option value="4">4</option></select></label>
      <label><input type="checkbox" id="bag-loop"> Loop</label>
      <button id="bag-play" class="primary" disabled>Publish</button>
      <button id="bag-pause" disabled>Pause</button>
      <span id="bag-state" role="status" aria-live="polite"></span>
    </div>
    <div class="legend" id="bag-curves" role="group" aria-label="Curves"></div>
  </div>
  <div class="card"><h2>Topics</h2>
    <table><thead><tr><th>Topic</th><th>Type</th><th>Messages</th></tr></thead><tbody id="bag-topics"></tbody></table>
  </div>`;
  static watches = { bag: false };

  #bag = null; // as the server described it
  #at = { playing: false, topic: "" }; // as the server says
  #refusal = ""; // why this page may not publish now
  #scrubbed = 0; // when the slider was last moved by hand
  #position = 0; // of the recording [s], which a zoomed slider may not show
  #records = false; // whether the server records for any page
  #tracks = {}; // name of a curve -> Track

  constructor(link, watch, page) {
    this.link = link;
    this.watch = watch;
    this.page = page;
    this.chart = new Chart(byId("bag-chart"), () => this.#showValues(), () => this.#alignSlider());
    link.on("bags", ({ names }) => {
      offer(byId("bag-name"), names.map((name) => [name]));
      if (names.length === 1 && !this.#bag) this.#ask();
    });
    link.on("recorder", ({ name, why }) => {
      this.#records = Boolean(name);
      say(byId("bag-record"), name ? "Stop recording" : "Record all topics");
      say(byId("bag-recorder"), name ? `Recording ${name}` : why);
    });
    link.on("bag", (bag) => this.#open(bag));
    link.on("bag_at", (at) => this.#moveTo(at));
    link.on("drives", ({ refusal }) => {
      this.#refusal = refusal;
      this.#report(this.#at);
    });
    link.on("hello", ({ role }) => {
      byId("bag-record").disabled = role !== "driver";
      this.#report({ playing: false });
      if (this.#bag) link.send("bag_open", { name: this.#bag.path }); // The server of a new connection does not know it.
    });
    byId("bag-open").onclick = () => this.#ask();
    byId("bag-record").onclick = () => link.send("record", { on: !this.#records });
    byId("bag-play").onclick = () => this.#play();
    byId("bag-pause").onclick = () => link.send("bag_pause");
    byId("bag-position").oninput = () => this.#seek(byId("bag-position").valueAsNumber);
    // A change while it plays takes effect at once.
    for (const id of ["bag-rate", "bag-loop", "bag-topic"]) byId(id).onchange = () => this.#at.playing && this.#play();
    byId("bag-zoom").onclick = () => this.chart.wholeRange();
  }

  show(on) {
    this.watch({ bag: on });
    if (on) requestAnimationFrame(() => this.#draw());
  }

  #seek(position) {
    this.#scrubbed = performance.now();
    this.chart.pointed = null;
    this.#showPosition(position);
    this.link.send("bag_seek", { position });
  }

  #ask() {
    this.link.send("bag_open", { name: byId("bag-name").value });
  }

  #play() {
    this.link.send("bag_play", {
      topic: byId("bag-topic").value,
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
    for (const label of byId("bag-curves").children) {
      const value = this.#tracks[label.dataset.curve].at(t);
      say(label.querySelector("output"), value === undefined ? "–" : written(value));
    }
  }

  #open(bag) {
    this.#bag = bag;
    const seconds = bag.end - bag.start;
    this.#position = Math.min(this.#position, seconds);
    const when = bag.start > 0 ? `, recorded ${new Date(bag.start * 1000).toLocaleString()}` : "";
    say(byId("bag-about"), `${bag.path}: ${seconds.toFixed(1)} s${when}`);
    byId("bag-position").max = seconds;
    this.#tracks = Object.fromEntries(Object.entries(bag.curves).map(([name, points]) => [name, new Track(points)]));
    byId("bag-topics").replaceChildren(...bag.topics.map(({ name, type, count }) => row(name, type, String(count))));
    const playable = bag.topics.filter(({ type }) => type === "sensor_msgs/Joy");
    offer(byId("bag-topic"), playable.map(({ name }) => [name]));
    byId("bag-curves").replaceChildren(...Object.keys(this.#tracks).map((name, i) => {
      const box = element("input", { type: "checkbox", checked: true });
      box.onchange = () => this.chart.setVisible(i, box.checked);
      return element("label", { "data-curve": name }, box, this.chart.sample(i), `${name} `, element("output"));
    }));
    this.#showValues();
    this.#report({ playing: false });
    this.#draw();
  }

  #draw() {
    if (!this.#bag) return;
    this.chart.show(this.#tracks, [0, Math.max(1, this.#bag.end - this.#bag.start)]);
    byId("bag-curves").querySelectorAll("input").forEach((box, i) => this.chart.setVisible(i, box.checked));
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

  #report(at) {
    this.#at = at;
    const { isOpen } = this.link;
    const isPlaying = isOpen && at.playing;
    const isNone = this.#bag && !byId("bag-topic").options.length;
    const refusal = isNone ? "This recording has no joystick topic to publish here." : this.#refusal;
    byId("bag-chart").dataset.empty = isNone
      ? `Only joystick topics have curves, and ${this.#bag.path} has none. In a shell: rosbag play ${this.#bag.path}`
      : EMPTY;
    byId("bag-open").disabled = byId("bag-position").disabled = !isOpen;
    byId("bag-play").disabled = !isOpen || !this.#bag || Boolean(refusal);
    byId("bag-pause").disabled = !isPlaying;
    const publishes = isPlaying ? `Publishing ${at.topic}. Pause stops the robot.` : refusal;
    say(byId("bag-state"), isOpen ? publishes : "Not connected.");
  }
}
