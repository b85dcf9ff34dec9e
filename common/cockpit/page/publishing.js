/** What the form of the tab Topics publishes, and the signs of life that the server requires meanwhile. */

const SIGN_MS = 50; // between two signs, while this page publishes repeatedly or drives by its form

export class Publishing {
  #timer = 0; // of signs of life, or 0
  #moves = false; // whether this page drives by its form, as the server says
  #n = 0; // of the newest sign
  #beat = 0; // the newest of the server
  repeats = false; // whether a message is published repeatedly

  /** onRest(): called when publishing has ended. */
  constructor(link, onRest) {
    this.link = link;
    this.onRest = onRest;
    link.on("beat", ({ n }) => (this.#beat = n));
    link.on("session", ({ yours, topic }) => this.#drive(yours && Boolean(topic)));
    link.on("refused", ({ what }) => ["publish", "again"].includes(what) && this.rest());
    document.addEventListener("visibilitychange", () => this.rest());
  }

  /** fields: of the message "publish"; with a period [s] it repeats. Returns whether it was sent. */
  begin(fields) {
    const isSent = this.link.send("publish", fields);
    if (isSent && fields.period) {
      this.repeats = true;
      this.#sendSigns(1000 * fields.period);
    }
    return isSent;
  }

  /** Some signs make the server publish. period: between two messages [ms]; Infinity: no sign does. */
  #sendSigns(period = Infinity) {
    clearInterval(this.#timer);
    const steps = Math.ceil(period / SIGN_MS); // from one message to the next
    let step = 0;
    const sign = () => this.link.send("again",
      { n: ++this.#n, t: performance.now(), beat: this.#beat, due: ++step % steps === 0 });
    this.#timer = setInterval(sign, period < Infinity ? period / steps : SIGN_MS);
  }

  #drive(on) {
    if (on && !this.#timer) this.#sendSigns();
    if (!on && this.#moves) this.rest();
    this.#moves = on;
  }

  /** Stop publishing: a page that is hidden or not connected publishes and moves nothing. */
  rest() {
    if (!this.#timer) return;
    clearInterval(this.#timer);
    this.#timer = 0;
    this.repeats = false;
    this.link.send("publish_end");
    this.onRest();
  }
}
