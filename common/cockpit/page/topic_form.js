/** The form of the tab Topics: it publishes a message once or repeatedly, calls a service, or sets a parameter. */

import { byId, element, say } from "./dom.js";
import { Publishing } from "./publishing.js";

const LONGEST_VALUE = 2000; // characters of a field, as the server accepts it
export const FORMS = { // of each kind: what the server is asked to describe, and what the form does
  topics: { what: "message", title: "Publish a message", act: "Publish" },
  services: { what: "service", title: "Call this service", act: "Call" },
  parameters: { what: "parameter", title: "Set this parameter", act: "Set" },
};

export class TopicForm {
  static panel = `
    <form class="card" id="topics-form" hidden><h2 id="topics-do"></h2>
      <p class="hint" id="topics-hint">A number may be an expression of i, the number of the message: sin(i / 10)</p>
      <div id="topics-fields"></div>
      <p class="row"><button id="topics-send" class="primary"></button>
        <label id="topics-repeat">at <input type="number" id="topics-rate" min="0.1" max="50" step="any"
          placeholder="once"> Hz</label></p>
      <pre id="topics-answer" role="status"></pre></form>`;

  /** @type {any} */ #about = {}; // kind, name and type of what it publishes, calls or sets
  #sets = false; // whether the form of a parameter is the answer to Set

  /** onSet(): called when a parameter has been set. */
  constructor(link, onSet) {
    this.link = link;
    this.onSet = onSet;
    this.publishing = new Publishing(link);
    link.on("answer", ({ name, text }) => {
      if (name === this.#about.name) say(byId("topics-answer"), text || "(an empty answer)");
    });
    link.on("refused", ({ what, why }) => {
      if (what === "call") say(byId("topics-answer"), why);
      if (what === "publish" || why.endsWith(` on ${this.#about.name})`)) this.#refuse(why);
    });
    byId("topics-form").onsubmit = (event) => this.#send(event);
  }

  /** A publication ends with its connection. */
  connect() {
    this.publishing.end();
    this.#sets = false;
  }

  hide() {
    this.#about = {};
    byId("topics-form").hidden = true;
    say(byId("topics-answer"), "");
  }

  show({ definition, fields }, about, mayAct) {
    this.#about = about;
    const { what, title, act } = FORMS[about.kind];
    say(byId("topics-do"), title);
    say(byId("topics-send"), act);
    byId("topics-repeat").hidden = byId("topics-hint").hidden = what !== "message";
    byId("topics-send").disabled = !mayAct;
    byId("topics-send").title = mayAct ? "" : "This page may only look.";
    byId("topics-fields").replaceChildren(...fields.map(([name, type]) =>
      element("label", { className: "long" }, `${name} `, element("input", { name, placeholder: type, autocomplete: "off" }))));
    if (what === "parameter" && definition.length <= LONGEST_VALUE) byId("topics-fields").querySelector("input").value = definition;
    byId("topics-form").hidden = false;
    if (!this.#sets) return;
    this.#sets = false;
    this.onSet();
    say(byId("topics-answer"), `Set to ${definition}`);
  }

  #send(event) {
    event.preventDefault();
    this.#refuse("");
    const { kind, name, type } = this.#about;
    const values = Object.fromEntries([...new FormData(event.target)].filter(([, value]) => value !== ""));
    const period = 1 / byId("topics-rate").valueAsNumber || null;
    if (kind === "services") this.link.send("call", { service: name, values });
    else if (kind === "topics") this.publishing.begin({ topic: name, type, values, period });
    else {
      say(byId("topics-answer"), "");
      this.#sets = this.link.send("set", { parameter: name, values });
    }
  }

  /** Show a refusal beside the field that it names: "linear/x: ...". */
  #refuse(why) {
    byId("topics-wrong")?.remove();
    const inputs = [...byId("topics-fields").querySelectorAll("input")];
    for (const input of inputs) input.removeAttribute("aria-invalid");
    const wrong = inputs.find(({ name }) => why.startsWith(`${name}: `));
    if (!wrong) return;
    wrong.setAttribute("aria-invalid", "true");
    wrong.setAttribute("aria-describedby", "topics-wrong");
    wrong.parentElement.after(element("p", { id: "topics-wrong" }, why));
  }
}
