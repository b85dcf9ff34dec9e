/** The tab Doctor: the lines of ./tutorial doctor. */

import { byId, element, say } from "./dom.js";

const SIGNS = { ok: "✓", note: "i", unknown: "?", wrong: "✗" };

const PANEL = `
  <div class="card row">
    <button id="doctor-run" class="primary">Run again</button>
    <span id="doctor-state" role="status" aria-live="polite"></span>
  </div>
  <ul id="doctor-lines" class="card"></ul>`;

export class DoctorTab {
  static title = "Doctor";
  static panel = PANEL;
  static watches = {};

  #asked = false;
  #shown = false;

  constructor(link) {
    this.link = link;
    link.on("hello", () => {
      this.#asked = false; // a run may have ended with its server
      byId("doctor-run").disabled = false;
      this.show(this.#shown);
    });
    link.on("doctor", (found) => this.#show(found));
    byId("doctor-run").onclick = () => this.#ask();
  }

  show(on) {
    this.#shown = on;
    if (on && !this.#asked) this.#ask();
  }

  #ask() {
    this.#asked = this.link.send("doctor");
    if (this.#asked) say(byId("doctor-state"), "Checking …");
  }

  #show({ lines, running }) {
    const wrong = lines.filter(({ level }) => level === "wrong").length;
    say(byId("doctor-state"), running ? "Checking …" : wrong ? `${wrong} wrong` : "No problem found");
    byId("doctor-run").disabled = running;
    byId("doctor-lines").replaceChildren(...lines.map(({ level, subject, text }) =>
      element("li", { className: level, "data-level": level },
        element("b", { className: "sign", "aria-label": level }, SIGNS[level] ?? "·"),
        element("b", { className: "subject" }, subject && `${subject}: `), text)));
  }
}
