/** The keys that move the virtual gamepad: Shift is LB, arrows or WASD the left stick. */

import { REST } from "./f710.js";

const STICK = {
  ArrowUp: [0, 1], KeyW: [0, 1], ArrowDown: [0, -1], KeyS: [0, -1],
  ArrowLeft: [1, 0], KeyA: [1, 0], ArrowRight: [-1, 0], KeyD: [-1, 0],
};
const BUTTONS = { ShiftLeft: "LB", ShiftRight: "LB" };
const SHIFTS = Object.keys(BUTTONS);
const SAY_SHIFT = ["keydown", "keyup", "pointerdown", "pointermove", "pointerup", "wheel"];
const TYPED_INTO = "input:not([type=checkbox]), select, textarea";

export class Keys {
  #down = new Set();

  /** isOurs(): whether keys drive now. onChange(): after each change. */
  constructor(isOurs, onChange) {
    const drop = (codes) => {
      const count = this.#down.size;
      for (const code of codes) this.#down.delete(code);
      if (this.#down.size !== count) onChange();
    };
    // A menu or another program may have taken a key's release, but each event has the state of Shift.
    // While Cmd of a Mac is down, no release is reported.
    for (const kind of SAY_SHIFT) {
      addEventListener(kind, (event) => {
        if (event.metaKey) drop([...this.#down]);
        else if (event.shiftKey === false) drop(SHIFTS);
      }, { capture: true, passive: true });
    }
    // Before anybody else: while they drive, arrows do not choose tabs.
    addEventListener("keydown", (event) => {
      const ours = event.code in STICK || event.code in BUTTONS;
      if (!ours || !isOurs() || event.target.matches?.(TYPED_INTO)) return;
      event.preventDefault();
      event.stopPropagation();
      // A key that was already down when the page came back repeats, and has to be pressed anew.
      if (event.repeat || event.ctrlKey || event.altKey || event.metaKey) return;
      this.#down.add(event.code);
      onChange();
    }, { capture: true });
    addEventListener("keyup", (event) => {
      // Of two Shifts that are released Windows reports one.
      drop(event.code in BUTTONS ? SHIFTS : [event.code]);
    }, { capture: true });
  }

  /** Forget all keys: that one was released may not have been heard. */
  clear() {
    this.#down.clear();
  }

  get hands() {
    const codes = [...this.#down];
    const sum = (i) => {
      const total = codes.reduce((all, code) => all + (STICK[code]?.[i] ?? 0), 0);
      return Math.max(-1, Math.min(1, total));
    };
    const held = [...new Set(codes.map((code) => BUTTONS[code]).filter(Boolean))];
    return { ...REST, left: [sum(0), sum(1)], held };
  }
}
