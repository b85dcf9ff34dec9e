/** Two thumbs on glass: one holds LB, the other moves the stick. A mouse may do either. */

import { REST } from "./f710.js";

export class Glass {
  #held = new Map(); // name of a button -> the pointer that holds it
  #thumb = null; // the pointer on the stick
  #left = [0, 0];

  /** root: the element with buttons [data-button], #stick and #knob. onLost(why): a pointer was lost. */
  constructor(root, onChange, onLost) {
    this.stick = root.querySelector("#stick");
    this.knob = root.querySelector("#knob");
    this.buttons = [...root.querySelectorAll("[data-button]")];
    this.onChange = onChange;
    this.onLost = onLost;
    for (const button of this.buttons) {
      const name = button.dataset.button;
      this.#listen(button, {
        down: (event) => this.#held.set(name, event.pointerId),
        move: () => {},
        up: () => this.#held.delete(name),
        holds: (event) => this.#held.get(name) === event.pointerId,
      });
    }
    this.#listen(this.stick, {
      down: (event) => {
        this.#thumb = event.pointerId;
        this.#left = this.#deflection(event);
      },
      move: (event) => (this.#left = this.#deflection(event)),
      up: () => {
        this.#thumb = null;
        this.#left = [0, 0];
      },
      holds: (event) => this.#thumb === event.pointerId,
    });
  }

  get hands() {
    return { ...REST, left: this.#left, held: [...this.#held.keys()] };
  }

  /** Let go of everything. */
  clear() {
    this.#held.clear();
    this.#thumb = null;
    this.#left = [0, 0];
    this.show(REST);
  }

  #listen(element, { down, move, up, holds }) {
    element.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      event.preventDefault();
      element.setPointerCapture(event.pointerId);
      down(event);
      this.onChange();
    });
    element.addEventListener("pointermove", (event) => {
      if (!holds(event)) return;
      move(event);
      this.onChange();
    });
    element.addEventListener("pointerup", (event) => {
      if (!holds(event)) return;
      up(event);
      this.onChange();
    });
    // Of a pointer that is lifted the capture is lost as well, but only after pointerup.
    for (const kind of ["pointercancel", "lostpointercapture"]) {
      element.addEventListener(kind, (event) => holds(event) && this.onLost("the browser took the pointer"));
    }
  }

  /** [left, up] of a pointer from the middle of the stick, at most 1 long. */
  #deflection(event) {
    const box = this.stick.getBoundingClientRect();
    const radius = box.width / 2;
    const left = (box.left + radius - event.clientX) / radius;
    const up = (box.top + radius - event.clientY) / radius;
    const length = Math.max(1, Math.hypot(left, up));
    return [left / length, up / length];
  }

  /** Draw what hands do here, on the keys or on a gamepad. */
  show({ held, left: [left, up] }) {
    for (const button of this.buttons) {
      button.classList.toggle("held", held.includes(button.dataset.button));
    }
    this.knob.style.transform = `translate(${-left * 100}%, ${-up * 100}%)`;
  }
}
