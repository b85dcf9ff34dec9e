/**
 * The person at this page as a joystick: sends the server what hands do on keys, glass or a gamepad.
 *
 * The server decides whether that moves a robot. The page notices some losses of the operator earlier
 * (a hidden page, a lost pointer), and reports them.
 */

import { TouchStick } from "./touch_stick.js";
import { Keys } from "./keys.js";
import { Pad } from "./pad.js";
import { isAtRest, positions } from "./f710.js";

const PERIOD_MS = 50; // of inputs while nothing changes, and of the server's beats
const LOOK_MS = 10; // between two looks at gamepads; the browser reads them about every 16 ms
const RIGHT = 2, RIGHT_HELD = 2; // of a mouse, as event.button and in event.buttons

export class Driver {
  #n = 0;
  #beat = 0; // the newest of the server
  #sent = ""; // the newest input, without its numbers
  #sentAt = 0;
  #timer = null;
  #away = false; // the page is hidden, or without the keyboard

  /** onHands(): called when keys or thumbs did something. */
  constructor(link, glass, onHands) {
    this.link = link;
    this.mode = "D";
    this.names = null; // {D, X: names of the buttons of that mode}
    const changed = () => {
      onHands();
      this.#report();
    };
    const lost = (why) => this.release(why);
    this.keys = new Keys(() => this.isDriving, changed);
    this.glass = new TouchStick(glass, changed, lost);
    this.pad = new Pad(lost);
    link.on("hello", ({ buttons }) => {
      this.names = buttons;
      this.stop(); // A new connection does not drive.
    });
    link.on("beat", (beat) => (this.#beat = beat.n));
    this.#shunMenus();
    this.#noticeAbsence();
  }

  get isDriving() {
    return this.#timer !== null;
  }

  /** Send what hands do at every change and every period, as this page has the session. */
  start() {
    if (this.isDriving) return;
    this.#letGo();
    this.#beat = 0;
    this.#timer = setInterval(() => this.#report(), LOOK_MS);
  }

  stop() {
    clearInterval(this.#timer);
    this.#timer = null;
    this.#letGo();
  }

  /** Report that the operator was lost, and release everything. */
  release(why) {
    this.#letGo();
    if (this.isDriving) this.link.send("release", { why });
  }

  /**
   * An open menu takes the keys and their releases, although the window keeps the focus. So menus are
   * suppressed while this page drives, and those that still open are a loss: the list of a <select>,
   * and the right button, with which Firefox shows its menu whenever Shift is held.
   */
  #shunMenus() {
    addEventListener("contextmenu", (event) => this.isDriving && event.preventDefault(), { capture: true });
    // While another button is held, a pointermove reports the right one.
    for (const kind of ["pointerdown", "pointermove"]) {
      addEventListener(kind, (/** @type {any} */ { pointerType, button, buttons, target }) => {
        const isRight = pointerType === "mouse" && button === RIGHT && buttons & RIGHT_HELD;
        const isList = kind === "pointerdown" && target.closest?.("select");
        if (isRight || isList) this.release("a menu was opened");
      }, { capture: true });
    }
  }

  #noticeAbsence() {
    const leave = (why) => {
      if (!this.#away) this.release(why);
      this.#away = true;
    };
    addEventListener("blur", () => leave("the window lost the focus"));
    addEventListener("pagehide", () => leave("the page was left"));
    document.addEventListener("freeze", () => leave("the browser froze the page"));
    document.addEventListener("visibilitychange", () => {
      if (document.hidden) leave("the page was hidden");
      else this.#away = false;
    });
    for (const kind of ["focus", "pageshow", "pointerdown", "keydown"]) {
      addEventListener(kind, () => (this.#away = document.hidden), { capture: true });
    }
  }

  #letGo() {
    this.keys.clear();
    this.glass.clear();
    this.#sent = "";
  }

  /** Hands on keys and glass together (Shift may hold LB for a mouse on the stick), else on a gamepad. */
  #hands() {
    const pad = this.pad.read(this.names); // first: an unplugged one releases everything
    const [keys, glass] = [this.keys.hands, this.glass.hands];
    const left = glass.left.some(Boolean) ? glass.left : keys.left;
    const hands = { ...glass, left, held: [...new Set([...keys.held, ...glass.held])] };
    if (pad && isAtRest(hands)) return { source: "pad", hands: pad.hands, stamp: pad.timestamp };
    return { source: isAtRest(keys) ? "touch" : "keys", hands, stamp: null };
  }

  #report() {
    if (!this.isDriving || this.#away) return;
    const { source, hands, stamp } = this.#hands();
    this.glass.show(hands);
    const { axes, buttons } = positions(this.mode, this.names[this.mode], hands);
    const now = performance.now();
    const held = JSON.stringify([source, axes, buttons]);
    if (held === this.#sent && now - this.#sentAt < PERIOD_MS - LOOK_MS / 2) return;
    const message = { n: ++this.#n, t: now, beat: this.#beat, axes, buttons, pad: stamp, source };
    if (!this.link.send("input", message)) return;
    this.#sent = held;
    this.#sentAt = now;
  }
}
