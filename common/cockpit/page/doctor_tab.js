/** The tab Doctor: the lines of ./tutorial doctor. */

import { byId, element, say } from "./dom.js";

const SIGNS = { ok: "✓", note: "i", wrong: "✗" };

export class DoctorTab {
  static title = "Doctor";
  static panel = `
  <div class="card row">
    <button id="doctor-run" class="primary">Run again</button>
    <span id="doctor-state" role="status" aria-live="polite"></span>
  </div>
  <ul id="doctor-lines" class="card"></ul>`;
  static watches = {};

  #asked = false;
  #running = false;
  #state = ""; // the newest verdict

  constructor(link) {
    this.link = link;
    link.on("hello", () => {
      this.#asked = false; // A run may have ended with its server.
      this.#report("", false);
      this.show(!byId("doctor").hidden);
    });
    link.on("doctor", (found) => this.#show(found));
    byId("doctor-run").onclick = () => this.#ask();
  }

  show(on) {
    if (on && !this.#asked) this.#ask();
  }

  #ask() {
    this.#asked = this.link.send("doctor");
    if (this.#asked) this.#report("Checking …", this.#running);
  }

  /** Without a connection the verdict is an old one. */
  connect() {
    this.#report(this.#state, this.#running);
  }

  #report(state, running) {
    [this.#state, this.#running] = [state, running];
    const { isOpen } = this.link;
    say(byId("doctor-state"), isOpen ? state : `Not connected. Before: ${state || "no result"}`);
    byId("doctor-run").disabled = running || !isOpen;
  }

  #show({ lines, running }) {
    const wrong = lines.filter(({ level }) => level === "wrong").length;
    this.#report(running ? "Checking …" : wrong ? `${wrong} wrong` : "No problem found", running);
    byId("doctor-lines").replaceChildren(...lines.map(({ level, subject, text }) =>
      element("li", { className: level },
        element("b", { className: "sign", "aria-label": level }, SIGNS[level]),
        element("b", { className: "subject" }, subject && `${subject}: `), text)));
  }
}
