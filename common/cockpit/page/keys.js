/** The keys that move the virtual gamepad: Shift is LB, arrows or WASD the left stick, 1 to 3 how far it goes. */

import { REST } from "./f710.js";

const STICK = {
  ArrowUp: [0, 1], KeyW: [0, 1], ArrowDown: [0, -1], KeyS: [0, -1],
  ArrowLeft: [1, 0], KeyA: [1, 0], ArrowRight: [-1, 0], KeyD: [-1, 0],
};
export const REACH = { Digit1: ["a fourth", 1 / 4], Digit2: ["half", 1 / 2], Digit3: ["whole", 1] }; // of the stick
const SHIFTS = ["ShiftLeft", "ShiftRight"];
const HAVE_SHIFT = ["keydown", "keyup", "pointerdown", "pointermove", "pointerup", "wheel"];
const TYPED_INTO = "input:not([type=checkbox]), select, textarea";

export class Keys {
  #down = new Set();
  reach = "Digit3"; // a key of REACH

  /** isOurs(): whether keys drive now. onChange(): called after a change. */
  constructor(isOurs, onChange) {
    const drop = (codes) => {
      const dropped = codes.filter((code) => this.#down.delete(code));
      if (dropped.length) onChange();
    };
    // A menu or another program may have taken a key's release, but every event has the state of
    // Shift. While Cmd is down on a Mac, no release is reported.
    for (const kind of HAVE_SHIFT) {
      addEventListener(kind, (/** @type {KeyboardEvent} */ event) => {
        if (event.metaKey) drop([...this.#down]);
        else if (event.shiftKey === false) drop(SHIFTS);
      }, { capture: true, passive: true });
    }
    // Captured, so that arrows do not choose tabs while driving.
    addEventListener("keydown", (/** @type {any} */ event) => {
      const isKnown = [STICK, REACH].some((keys) => event.code in keys) || SHIFTS.includes(event.code);
      if (!isKnown || !isOurs() || event.target.matches?.(TYPED_INTO)) return;
      event.preventDefault();
      event.stopPropagation();
      // A key that was down before the page returned only repeats, and must be pressed again.
      if (event.repeat || event.ctrlKey || event.altKey || event.metaKey) return;
      if (event.code in REACH) this.reach = event.code;
      else this.#down.add(event.code);
      onChange();
    }, { capture: true });
    // When both Shifts are released, Windows reports one.
    addEventListener("keyup", ({ code }) => drop(SHIFTS.includes(code) ? SHIFTS : [code]), { capture: true });
  }

  /** Forget all keys: a release may not have been reported. */
  clear() {
    this.#down.clear();
  }

  get hands() {
    const pushes = [...this.#down].map((code) => STICK[code] ?? [0, 0]);
    const [, reach] = REACH[this.reach];
    const sum = (i) => reach * Math.sign(pushes.reduce((total, push) => total + push[i], 0));
    const held = SHIFTS.some((code) => this.#down.has(code)) ? ["LB"] : [];
    return { ...REST, left: [sum(0), sum(1)], held };
  }
}
