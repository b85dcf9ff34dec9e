/** What this page publishes by forms: its list, and the signs of life that the server requires meanwhile. */

import { byId, element, row, say } from "./dom.js";

const SIGN_MS = 50; // between two signs, whatever is published

export class Publishing {
  static panel = `
    <div class="card" id="topics-running" hidden><h2 id="topics-running-title" aria-live="polite"></h2>
      <table><thead><tr><th>Topic</th><th>Sent</th><td></td></tr></thead>
        <tbody id="topics-running-rows"></tbody></table>
      <button id="topics-stop-all">Stop all</button></div>`;

  #kept = new Map(); // topic -> { period [s], line: its row, timer: of the signs that make the server publish }
  #signs = 0; // timer of the others
  #n = 0; // of the newest sign
  #beat = 0; // the newest of the server
  #mayRun = false; // whether anything was published

  constructor(link) {
    this.link = link;
    link.on("beat", ({ n }) => (this.#beat = n));
    link.on("running", ({ topics }) => this.#show(topics));
    byId("topics-stop-all").onclick = () => this.end();
    document.addEventListener("visibilitychange", () => this.end());
  }

  /** fields: of the message "publish"; with a period [s] it repeats. */
  begin(fields) {
    this.#mayRun = true;
    this.link.send("publish", fields);
  }

  /** Stop all: a page that is hidden or not connected publishes and moves nothing. */
  end() {
    if (!this.#mayRun) return;
    this.link.send("publish_end", { topic: null });
    this.#show([]);
  }

  /** topics: what the server publishes for this page; a motion that was published once has no period. */
  #show(topics) {
    if (document.hidden && topics.length) return this.end(); // They began while the page was being hidden.
    const hasFocus = byId("topics-running").contains(document.activeElement);
    for (const [topic, { period, line, timer }] of this.#kept) {
      if (topics.some((now) => now.topic === topic && now.period === period)) continue;
      clearInterval(timer);
      this.#kept.delete(topic);
      line.remove();
    }
    for (const { topic, type, period, count } of topics) {
      if (!this.#kept.has(topic)) this.#kept.set(topic, this.#start(topic, type, period));
      say(this.#kept.get(topic).line.cells[1], String(count));
    }
    if (!topics.length) clearInterval(this.#signs);
    this.#signs = topics.length && (this.#signs || setInterval(() => this.#sign(null), SIGN_MS));
    say(byId("topics-running-title"), `Publishing on ${topics.length} topic${topics.length === 1 ? "" : "s"}`);
    say(byId("tab-topics"), topics.length ? `Topics (${topics.length})` : "Topics");
    const hadFocus = hasFocus && !(topics.length && byId("topics-running").contains(document.activeElement));
    byId("topics-running").hidden = !topics.length;
    if (hadFocus) byId(topics.length ? "topics-stop-all" : "topics-send").focus();
  }

  #start(topic, type, period) {
    const stop = element("button", { "aria-label": `Stop ${topic}` }, "Stop");
    stop.onclick = () => this.link.send("publish_end", { topic });
    const rate = period ? `${+(1 / period).toFixed(2)} Hz` : "once";
    const line = row(element("span", {}, topic, element("br"), element("small", {}, `${type}, ${rate}`)), "", stop);
    byId("topics-running-rows").append(line);
    return { period, line, timer: period ? setInterval(() => this.#sign(topic), 1000 * period) : 0 };
  }

  /** due: the topic on which the server publishes now, or null. */
  #sign(due) {
    this.link.send("again", { n: ++this.#n, t: performance.now(), beat: this.#beat, due });
  }
}
