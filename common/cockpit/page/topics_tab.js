/**
 * The tab Topics: the rates of topics, the newest messages of one, and forms that publish a message once or repeatedly,
 * call a service, or set a parameter.
 */

import { appendBelow, brief, byId, byName, element, offer, row, say } from "./dom.js";
import { neighbours } from "./graph_layout.js";
import { Publishing } from "./publishing.js";

const LISTED = 100; // of the matching names
const MOST_RATES = 40, LONGEST_RATES = 3000; // topics, and characters of their names, as the server accepts them
const LOOK_MS = 500; // between two checks of which topics are in sight
const ECHOED = 100; // messages that are kept
const SIGN_OF_COPY_MS = 2000;
const LONGEST_VALUE = 2000; // characters of a field, as the server accepts it
const FORMS = { // of each kind: what the server is asked to describe, and what the form does
  topics: { what: "message", title: "Publish a message", act: "Publish" },
  services: { what: "service", title: "Call this service", act: "Call" },
  parameters: { what: "parameter", title: "Set this parameter", act: "Set" },
};

export class TopicsTab {
  static title = "Topics";
  static panel = `
  <div class="wide">
    <div class="card row">
      <label>Show <select id="topics-kind"></select></label>
      <label class="grow">Search <input type="search" id="topics-search" placeholder="name or type" autocomplete="off"></label>
      <label><input type="checkbox" id="topics-measure" checked> Measure rates</label>
      <span id="topics-count" class="hint" role="status"></span>
    </div>
    <div class="scroll" id="topics-scroll" role="region" tabindex="0" aria-label="Topics or services">
      <table><thead><tr><th>Name</th><th id="topics-type">Type</th><th>Publishers</th><th>Subscribers</th><th>Hz</th><th>bytes/s</th></tr></thead>
        <tbody id="topics-rows"></tbody></table></div>
  </div>
  <div class="panel">
    <div class="card"><h2 id="topics-title" aria-live="polite">Choose a name.</h2>
      <p id="topics-about" class="hint"></p>
      <p class="row" id="topics-plots" hidden><label>Plot <select id="topics-plot"></select></label></p>
      <details><summary>Definition</summary><pre id="topics-definition"></pre></details></div>
    <form class="card" id="topics-form" hidden><h2 id="topics-do"></h2>
      <div id="topics-fields"></div>
      <p class="row"><button id="topics-send" class="primary"></button>
        <label id="topics-repeat">at <input type="number" id="topics-rate" min="0.1" max="50" step="any"
          placeholder="once"> Hz</label></p>
      <pre id="topics-answer" role="status"></pre></form>
    <div class="card" id="topics-echoes" hidden><h2>Messages <small>at most 12 in a second</small></h2>
      <div class="row"><button id="topics-pause" aria-pressed="false">Pause</button>
        <button id="topics-copy">Copy</button></div>
      <pre id="topics-echo" tabindex="0" role="region" aria-label="Messages"></pre></div>
  </div>`;
  static watches = { rates: [], topic: null };

  #shown = false;
  #paused = false; // messages
  #drives = false; // whether this page may publish and call
  #graph = { topics: [], services: [], parameters: [], edges: [] };
  #chosen = null; // the name
  #type = ""; // of the chosen topic
  #rows = new Map(); // name -> its row
  #described = ""; // what the server was asked to describe last
  #values = {}; // of parameters: {name: text}
  #named = ""; // the parameters whose values were asked for
  #sets = false; // whether the form of a parameter is the answer to Set

  constructor(link, watch, page) {
    this.link = link;
    this.watch = watch;
    this.page = page;
    link.on("hello", ({ role }) => (this.#drives = role === "driver"));
    this.publishing = new Publishing(link, () => say(byId("topics-send"), "Publish"));
    link.on("graph", (graph) => {
      this.#graph = graph;
      this.#list();
    });
    link.on("rates", ({ rates }) => this.#showRates(rates));
    link.on("topic", ({ name, echo }) => {
      if (name !== this.#chosen || this.#paused) return;
      appendBelow(byId("topics-echo"), echo.map(([, text]) => `${text}\n---\n`), ECHOED);
    });
    link.on("form", (form) => [this.#type, this.#chosen].includes(form.name) && this.#showForm(form));
    link.on("answer", ({ name, text }) => {
      if (name === this.#chosen) say(byId("topics-answer"), text || "(an empty answer)");
    });
    link.on("refused", ({ what, why }) => {
      if (what === "call") say(byId("topics-answer"), why);
    });
    link.on("values", ({ values }) => {
      this.#values = values;
      this.#list();
    });
    offer(byId("topics-kind"), Object.keys(FORMS).map((kind) => [kind]));
    byId("topics").dataset.kind = this.#kind;
    byId("topics-kind").onchange = () => {
      byId("topics-search").value = ""; // for names of another kind
      this.#choose(null);
    };
    byId("topics-search").oninput = () => this.#list();
    byId("topics-plot").onchange = () => (location.hash = `#plot?f=${this.#chosen}${byId("topics-plot").value}`);
    byId("topics-pause").onclick = () => this.#pause(!this.#paused);
    byId("topics-copy").onclick = () => {
      getSelection().selectAllChildren(byId("topics-echo"));
      const isDone = document.execCommand("copy"); // navigator.clipboard is missing over http from another machine
      say(byId("topics-copy"), isDone ? "Copied" : "Not copied");
      setTimeout(() => say(byId("topics-copy"), "Copy"), SIGN_OF_COPY_MS);
    };
    byId("topics-form").onsubmit = (event) => this.#send(event);
    setInterval(() => this.#shown && this.watch({ rates: this.#inSight }), LOOK_MS);
  }

  get place() {
    return `${this.#chosen ?? ""}${this.#isTopics ? "" : `?kind=${this.#kind}`}`;
  }

  go(path, query) {
    byId("topics-kind").value = query.get("kind") in FORMS ? query.get("kind") : "topics";
    this.#choose(/^\/[\w/]{1,199}$/.test(path) ? path : null); // as the server accepts it
  }

  show(on) {
    this.#shown = on;
    this.watch({ graph: on, rates: [], topic: on && this.#isTopics ? this.#chosen : null });
    if (!on) return this.#leave();
    this.#list();
  }

  connect() {
    this.publishing.rest();
    this.#described = this.#named = "";
    this.#sets = false;
    this.#describe();
  }

  get #kind() {
    return byId("topics-kind").value;
  }

  get #isTopics() {
    return this.#kind === "topics";
  }

  /** The topics whose rows are visible. */
  get #inSight() {
    if (!byId("topics-measure").checked || !this.#isTopics) return [];
    const { top, bottom } = byId("topics-scroll").getBoundingClientRect();
    const names = [...this.#rows].filter(([, line]) => {
      const box = line.getBoundingClientRect();
      return box.bottom > top && box.top < bottom && box.top < innerHeight;
    }).map(([name]) => name).slice(0, MOST_RATES);
    while (names.join().length > LONGEST_RATES) names.pop();
    return names;
  }

  #list() {
    if (!this.#shown) return;
    const { topics, edges } = this.#graph;
    const { before, after } = neighbours(edges);
    if (this.#kind === "parameters") this.#askForValues();
    const all = this.#isTopics ? topics
      : this.#graph[this.#kind].map((name) => ({ name, type: this.#kind === "parameters" ? this.#values[name] ?? "" : "" }));
    const words = byId("topics-search").value.toLowerCase().split(/\s+/).filter(Boolean);
    const found = all.filter(({ name, type }) => words.every((word) => `${name} ${type}`.toLowerCase().includes(word)));
    const listed = found.sort((a, b) => byName(a.name, b.name)).slice(0, LISTED);
    this.#rows = new Map(listed.map(({ name, type }) => {
      const line = this.#rows.get(name) ?? this.#rowOf(name);
      const counts = [before, after].map((nodes) => nodes[`topic ${name}`]?.length ?? 0);
      [type, ...counts].forEach((text, i) => say(line.cells[i + 1], String(text)));
      line.classList.toggle("chosen", name === this.#chosen);
      return [name, line];
    }));
    byId("topics-rows").replaceChildren(...this.#rows.values());
    const rest = found.length - listed.length;
    const more = rest ? `: the first ${LISTED} are listed` : found.length || !all.length ? "" : `: none has ${words.join(" ")}`;
    say(byId("topics-count"), `${found.length} of ${all.length}${more}`);
    say(byId("topics-type"), this.#kind === "parameters" ? "Value" : "Type");
    if (this.#chosen && this.#isTopics) this.#showTopic(before, after);
    this.#describe();
  }

  /** What is known about the chosen topic, updated once it exists. */
  #showTopic(before, after) {
    const names = (nodes) => nodes[`topic ${this.#chosen}`]?.map((node) => brief(node.slice(5))).join(", ") ?? "none";
    this.#type = this.#graph.topics.find(({ name }) => name === this.#chosen)?.type ?? "";
    say(byId("topics-about"), `${this.#type || "No such topic now"}. Publishers: ${names(before)}.`
      + ` Subscribers: ${names(after)}.`);
  }

  /** Ask for the values of all parameters, if their names have changed. */
  #askForValues() {
    const named = this.#graph.parameters.join();
    if (named !== this.#named && this.link.send("describe", { what: "values", name: "" })) this.#named = named;
  }

  #rowOf(name) {
    const line = row(element("button", { className: "link" }, name), "", "", "", "", "");
    line.onclick = () => this.#choose(name);
    return line;
  }

  #showRates(rates) {
    for (const [name, line] of this.#rows) {
      const [hertz, bytes] = rates[name] ?? [];
      say(line.cells[4], hertz === undefined ? "" : hertz.toFixed(hertz < 100 ? 2 : 0));
      say(line.cells[5], bytes === undefined ? "" : String(bytes));
    }
  }

  #choose(name) {
    this.#leave();
    this.#chosen = name;
    this.#type = this.#described = "";
    byId("topics").dataset.kind = this.#kind;
    byId("topics-echo").replaceChildren();
    this.#pause(false);
    say(byId("topics-title"), name ?? "Choose a name.");
    for (const part of ["about", "definition", "answer"]) say(byId(`topics-${part}`), "");
    for (const part of ["plots", "form"]) byId(`topics-${part}`).hidden = true;
    byId("topics-echoes").hidden = !this.#isTopics || !name;
    if (this.#shown) this.watch({ topic: this.#isTopics ? name : null });
    this.#list();
    this.page.moved(true);
  }

  #describe() {
    const { what } = FORMS[this.#kind];
    const name = this.#isTopics ? this.#type : this.#chosen;
    if (this.#shown && name && name !== this.#described && this.link.send("describe", { what, name })) {
      this.#described = name;
    }
  }

  #pause(on) {
    this.#paused = on;
    byId("topics-pause").setAttribute("aria-pressed", String(on));
    say(byId("topics-pause"), on ? "Resume" : "Pause");
  }

  #showForm({ definition, fields, numbers }) {
    say(byId("topics-definition"), definition);
    byId("topics-plots").hidden = !numbers.length;
    offer(byId("topics-plot"), [["", "choose a field"], ...numbers.map((field) => [`/${field}`])]);
    const { what, title, act } = FORMS[this.#kind];
    say(byId("topics-do"), title);
    say(byId("topics-send"), act);
    byId("topics-repeat").hidden = !this.#isTopics;
    byId("topics-send").disabled = !this.#drives;
    byId("topics-send").title = this.#drives ? "" : "This page may only look.";
    byId("topics-fields").replaceChildren(...fields.map(([name, type]) =>
      element("label", { className: "long" }, `${name} `, element("input", { name, placeholder: type, autocomplete: "off" }))));
    if (what === "parameter" && definition.length <= LONGEST_VALUE) byId("topics-fields").querySelector("input").value = definition;
    byId("topics-form").hidden = false;
    if (this.#sets) {
      this.#sets = false;
      this.#named = "";
      this.#list();
      say(byId("topics-answer"), `Set to ${definition}`);
    }
  }

  #send(event) {
    event.preventDefault();
    const values = Object.fromEntries([...new FormData(event.target)].filter(([, value]) => value !== ""));
    const period = 1 / byId("topics-rate").valueAsNumber || null;
    if (this.#kind === "services") this.link.send("call", { service: this.#chosen, values });
    else if (this.#kind === "parameters") {
      say(byId("topics-answer"), "");
      this.#sets = this.link.send("set", { parameter: this.#chosen, values });
    }
    else if (this.publishing.repeats) this.publishing.rest();
    else if (this.publishing.begin({ topic: this.#chosen, type: this.#type, values, period }) && period) {
      say(byId("topics-send"), "Stop publishing");
    }
  }

  /** For another tab or name: stop repeating a message; a motion continues, as Stop is above all tabs. */
  #leave() {
    if (this.publishing.repeats) this.publishing.rest();
  }
}
