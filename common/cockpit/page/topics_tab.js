/** The tab Topics: the rates of topics, the newest messages of one, and a form for it (topic_form.js). */

import { appendBelow, brief, byId, byName, element, offer, row, say, sayName } from "./dom.js";
import { neighbours } from "./graph_layout.js";
import { Publishing } from "./publishing.js";
import { FORMS, TopicForm } from "./topic_form.js";

const LISTED = 100; // of the matching names
const MOST_RATES = 40, LONGEST_RATES = 3000; // topics, and characters of their names, as the server accepts them
const LOOK_MS = 500; // between two checks of which topics are in sight
const ECHOED = 100; // messages that are kept
const SIGN_OF_COPY_MS = 2000;

export class TopicsTab {
  static title = "Topics";
  static panel = `
  <div class="wide">
    <div class="card row">
      <label>Show <select id="topics-kind"></select></label>
      <label class="grow">Search <input type="search" id="topics-search" placeholder="name or type" autocomplete="off"></label>
      <label><input type="checkbox" id="topics-measure" checked> Measure rates</label>
      <span id="topics-count" class="hint" role="status"></span>
      <details id="topics-new"><summary>New topic</summary><form class="row">
        <label>Name <input name="topic" required pattern="/?[A-Za-z]\\w*(/\\w+)*" placeholder="/chatter" autocomplete="off"></label>
        <label>Type <input name="type" required list="topics-types" placeholder="std_msgs/String" autocomplete="off"></label>
        <datalist id="topics-types"></datalist><button>Choose</button></form></details>
    </div>
    <div class="scroll" id="topics-scroll" role="region" tabindex="0" aria-label="Topics or services">
      <table><thead><tr><th>Name</th><th id="topics-type">Type</th><th>Publishers</th><th>Subscribers</th><th>Hz</th><th>bytes/s</th></tr></thead>
        <tbody id="topics-rows"></tbody></table></div>
  </div>
  <div class="panel">
    <div class="card"><h2 id="topics-title" aria-live="polite">Choose a name.</h2>
      <p id="topics-about" class="hint"></p>
      <p class="row" id="topics-plots" hidden><label>Plot <select id="topics-plot"></select></label></p>
      <details><summary>Definition</summary><pre id="topics-definition"></pre></details></div>${TopicForm.panel}${Publishing.panel}
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
  #newType = ""; // its type if nobody has it yet
  #rows = new Map(); // name -> its row
  #described = ""; // what the server was asked to describe last
  #values = {}; // of parameters: {name: text}
  #named = ""; // the parameters whose values were asked for

  constructor(link, watch, page) {
    this.link = link;
    this.watch = watch;
    this.page = page;
    link.on("hello", ({ role }) => {
      this.#drives = role === "driver";
      byId("topics-new").hidden = !this.#drives;
    });
    link.on("types", ({ types }) => byId("topics-types").replaceChildren(...types.map((type) => new Option(type))));
    this.form = new TopicForm(link, () => {
      this.#named = "";
      this.#list();
    });
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
    byId("topics-new").ontoggle = ({ target }) => target.open && link.send("describe", { what: "types", name: "" });
    byId("topics-new").onsubmit = (event) => {
      event.preventDefault();
      const { topic, type } = Object.fromEntries(new FormData(event.target));
      location.hash = `#topics/${String(topic).replace(/^\//, "")}?type=${type}`;
    };
    setInterval(() => this.#shown && this.watch({ rates: this.#inSight }), LOOK_MS);
  }

  get place() {
    const query = this.#isTopics ? this.#newType && `?type=${this.#newType}` : `?kind=${this.#kind}`;
    return `${this.#chosen ?? ""}${query}`;
  }

  go(path, query) {
    byId("topics-kind").value = query.get("kind") in FORMS ? query.get("kind") : "topics";
    this.#choose(/^\/[\w/]{1,199}$/.test(path) ? path : null, query.get("type") ?? ""); // as the server accepts it
  }

  show(on) {
    this.#shown = on;
    this.watch({ graph: on, rates: [], topic: on && this.#isTopics ? this.#chosen : null });
    if (on) this.#list();
  }

  connect() {
    this.form.connect();
    this.#described = this.#named = "";
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
      say(line.cells[1], type);
      counts.forEach((count, i) => say(line.cells[i + 2], String(count)));
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
    this.#type = this.#graph.topics.find(({ name }) => name === this.#chosen)?.type ?? this.#newType;
    say(byId("topics-about"), `${this.#type || "No such topic now"}. Publishers: ${names(before)}.`
      + ` Subscribers: ${names(after)}.`);
  }

  /** Ask for the values of all parameters, if their names have changed. */
  #askForValues() {
    const named = this.#graph.parameters.join();
    if (named !== this.#named && this.link.send("describe", { what: "values", name: "" })) this.#named = named;
  }

  #rowOf(name) {
    const button = element("button", { className: "link" });
    sayName(button, name);
    const line = row(button, "", "", "", "", "");
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

  #choose(name, newType = "") {
    this.#chosen = name;
    this.#newType = newType;
    this.#type = this.#described = "";
    byId("topics").dataset.kind = this.#kind;
    byId("topics-echo").replaceChildren();
    this.#pause(false);
    sayName(byId("topics-title"), name ?? "Choose a name.");
    for (const part of ["about", "definition"]) say(byId(`topics-${part}`), "");
    byId("topics-plots").hidden = true;
    this.form.hide();
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

  #showForm(form) {
    say(byId("topics-definition"), form.definition);
    byId("topics-plots").hidden = !form.numbers.length;
    offer(byId("topics-plot"), [["", "choose a field"], ...form.numbers.map((field) => [`/${field}`])]);
    const isNew = byId("topics-new").contains(document.activeElement);
    this.form.show(form, { kind: this.#kind, name: this.#chosen, type: this.#type }, this.#drives);
    if (isNew) byId("topics-form").querySelector("input, button").focus();
  }
}
