/**
 * The person at this page as a joystick: what hands do on keys, glass or a gamepad goes to the server.
 *
 * Whether that moves a robot is the server's to decide. This side knows some losses of the operator
 * earlier (a hidden page, a lost pointer), and reports them.
 */

import { Glass } from "./glass.js";
import { Keys } from "./keys.js";
import { Pad } from "./pad.js";
import { isAtRest, positions } from "./f710.js";

const LOOK_MS = 10; // how often gamepads are looked at; the browser itself does it every 16 ms or so
const RIGHT = 2, RIGHT_HELD = 2; // of a mouse, as event.button and in event.buttons

export class Driver {
  #n = 0;
  #beat = 0; // the newest one of the server's that came
  #sent = ""; // the newest input, without its numbers
  #sentAt = 0;
  #timer = null;
  #away = false; // the page is hidden, or has not the keyboard

  constructor(link, glass) {
    this.link = link;
    this.mode = "D";
    this.names = null; // {D, X: names of the buttons of that mode}
    this.periodMs = 50;
    this.onLost = () => {};
    const changed = () => this.#tell();
    const lost = (why) => this.release(why);
    this.keys = new Keys(() => this.isDriving, changed);
    this.glass = new Glass(glass, changed, lost);
    this.pad = new Pad(lost);
    link.on("hello", (hello) => {
      this.names = { D: hello.pad.D.buttons, X: hello.pad.X.buttons };
      this.periodMs = hello.beat_ms;
      this.stop(); // a new connection drives nothing
    });
    link.on("beat", (beat) => (this.#beat = beat.n));
    addEventListener("blur", () => this.#leave("the window lost the focus"));
    addEventListener("pagehide", () => this.#leave("the page was left"));
    document.addEventListener("freeze", () => this.#leave("the browser froze the page"));
    document.addEventListener("visibilitychange", () => {
      if (document.hidden) this.#leave("the page was hidden");
      else this.#away = false;
    });
    this.#shunMenus();
    for (const kind of ["focus", "pageshow", "pointerdown", "keydown"]) {
      addEventListener(kind, () => (this.#away = document.hidden), { capture: true });
    }
  }

  get isDriving() {
    return this.#timer !== null;
  }

  /** The seat is this page's: send what hands do, at every change and every period. */
  start() {
    if (this.isDriving) return;
    this.#letGo();
    this.#beat = 0;
    this.#timer = setInterval(() => this.#tell(), LOOK_MS);
  }

  stop() {
    clearInterval(this.#timer);
    this.#timer = null;
    this.#letGo();
  }

  /** The operator was lost: say so, and hold nothing any more. */
  release(why) {
    this.#letGo();
    if (!this.isDriving) return;
    this.link.send("release", { why });
    this.onLost(why);
  }

  /**
   * A menu takes the keys, and with them the word of their release; the window keeps the focus. So
   * while this page drives none is to open, and what opens one all the same is a loss: the list of a
   * <select>, and the right button, with which Firefox shows its menu whenever Shift is held.
   */
  #shunMenus() {
    const options = { capture: true };
    addEventListener("contextmenu", (event) => this.isDriving && event.preventDefault(), options);
    // While another button is held, the right one is reported by a pointermove.
    for (const kind of ["pointerdown", "pointermove"]) {
      addEventListener(kind, ({ pointerType, button, buttons }) => {
        if (pointerType === "mouse" && button === RIGHT && buttons & RIGHT_HELD) this.release("a menu was opened");
      }, options);
    }
    addEventListener("pointerdown", ({ target }) => {
      if (target.closest?.("select")) this.release("a menu was opened");
    }, options);
  }

  #leave(why) {
    if (!this.#away) this.release(why);
    this.#away = true;
  }

  #letGo() {
    this.keys.clear();
    this.glass.clear();
    this.#sent = "";
  }

  /** Hands on keys and glass together: Shift may hold LB for a mouse on the stick. */
  #ownHands() {
    const [keys, glass] = [this.keys.hands, this.glass.hands];
    const source = isAtRest(keys) ? "touch" : "keys";
    const left = glass.left.some(Boolean) ? glass.left : keys.left;
    return { source, hands: { ...glass, left, held: [...new Set([...keys.held, ...glass.held])] } };
  }

  #tell() {
    if (!this.isDriving || this.#away) return;
    let { source, hands } = this.#ownHands();
    const pad = this.pad.read(this.names);
    if (pad && isAtRest(hands)) ({ source, hands } = { source: "pad", hands: pad.hands });
    this.glass.show(hands);
    const { axes, buttons } = positions(this.mode, this.names[this.mode], hands);
    const now = performance.now();
    const held = JSON.stringify([source, axes, buttons]);
    if (held === this.#sent && now - this.#sentAt < this.periodMs - LOOK_MS / 2) return;
    const stamp = source === "pad" ? pad.timestamp : null;
    const message = { n: ++this.#n, t: now, beat: this.#beat, axes, buttons, pad: stamp, source };
    if (!this.link.send("input", message)) return;
    this.#sent = held;
    this.#sentAt = now;
  }
}
