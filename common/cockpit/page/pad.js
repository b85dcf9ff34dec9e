/** A real gamepad, as the browser's Gamepad API shows it. */

import { handsOfGamepad, isAtRest, REST } from "./f710.js";

export class Pad {
  #index = null; // of the gamepad in use
  #wasAtRest = false; // since it was plugged in; until then a held stick moves nothing

  /** onLost(why): the gamepad was unplugged. */
  constructor(onLost) {
    this.onLost = onLost;
  }

  /** {hands, timestamp} of the first gamepad, or null. names: see handsOfGamepad(). */
  read(names) {
    const gamepad = [...(navigator.getGamepads?.() ?? [])].find((one) => one?.connected && one.axes.length >= 2);
    if (this.#index !== null && gamepad?.index !== this.#index) {
      this.#index = null;
      this.onLost("the gamepad was unplugged");
    }
    if (!gamepad) return null;
    if (this.#index === null) this.#wasAtRest = false;
    this.#index = gamepad.index;
    const hands = handsOfGamepad(gamepad, names);
    this.#wasAtRest ||= isAtRest(hands);
    return { hands: this.#wasAtRest ? hands : REST, timestamp: gamepad.timestamp ?? null };
  }
}
