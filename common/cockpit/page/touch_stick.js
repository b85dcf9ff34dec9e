/** Two thumbs on glass: one holds LB, the other moves the stick. A mouse can do either. */

import { REST } from "./f710.js";

export class TouchStick {
  #pointers = new Map(); // button or stick -> the pointer that holds it
  #left = [0, 0];

  /** root: the element with buttons [data-button], #stick and #knob. onLost(why): a pointer was lost. */
  constructor(root, onChange, onLost) {
    this.onChange = onChange;
    this.onLost = onLost;
    this.stick = root.querySelector("#stick");
    this.knob = root.querySelector("#knob");
    this.buttons = [...root.querySelectorAll("[data-button]")];
    for (const target of [this.stick, ...this.buttons]) this.#listen(target);
  }

  get hands() {
    const held = this.buttons.filter((button) => this.#pointers.has(button));
    return { ...REST, left: this.#left, held: held.map((button) => button.dataset.button) };
  }

  /** Release everything. */
  clear() {
    this.#pointers.clear();
    this.#left = [0, 0];
    this.show(REST);
  }

  #listen(target) {
    const holds = (event) => this.#pointers.get(target) === event.pointerId;
    const move = (event) => {
      if (target === this.stick) this.#left = holds(event) ? this.#deflection(event) : [0, 0];
      this.onChange();
    };
    target.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      event.preventDefault();
      target.setPointerCapture(event.pointerId);
      this.#pointers.set(target, event.pointerId);
      move(event);
    });
    target.addEventListener("pointermove", (event) => holds(event) && move(event));
    target.addEventListener("pointerup", (event) => {
      if (!holds(event)) return;
      this.#pointers.delete(target);
      move(event);
    });
    // A lifted pointer loses its capture as well, but only after pointerup.
    target.onpointercancel = target.onlostpointercapture =
      (event) => holds(event) && this.onLost("the browser took the pointer");
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
  show({ held, left: stick }) {
    const [left, up] = stick;
    for (const button of this.buttons) {
      button.classList.toggle("held", held.includes(button.dataset.button));
    }
    this.knob.style.transform = `translate(${-left * 100}%, ${-up * 100}%)`;
  }
}
