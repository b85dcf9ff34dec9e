/**
 * The Logitech F710 as /joy shows it, and what hands do on it (pure).
 *
 * Hands are {left, right, dpad: [x, y] from -1 to 1, left and up positive as on /joy; triggers:
 * [LT, RT] from 0 (released) to 1; held: names of buttons}. It is what gamepads.py and controls.py
 * of the package gamepad have in Python.
 */

export const REST = Object.freeze({
  left: [0, 0], right: [0, 0], dpad: [0, 0], triggers: [0, 0], held: [],
});
const DIGITAL = 0.5; // from this deflection on a trigger or the D-pad is pressed
const DEADZONE = 0.05; // of a stick, as joy_node has it

// The Gamepad API's "standard" layout, https://w3c.github.io/gamepad/#remapping
const STANDARD = [
  "A", "B", "X", "Y", "LB", "RB", "LT", "RT", "BACK", "START", "LEFT", "RIGHT",
  "up", "down", "left", "right", "LOGITECH",
];

/** {axes, buttons} as on /joy. mode: "D" or "X"; names: of that mode's buttons, in their order. */
export function positions(mode, names, hands) {
  const dpad = hands.dpad.map((v) => (v > DIGITAL) - (v < -DIGITAL));
  const [lt, rt] = hands.triggers;
  const held = new Set(hands.held);
  if (lt > DIGITAL) held.add("LT");
  if (rt > DIGITAL) held.add("RT");
  const axes =
    mode === "X"
      ? [...hands.left, 1 - 2 * lt, ...hands.right, 1 - 2 * rt, ...dpad]
      : [...hands.left, ...hands.right, ...dpad];
  return { axes: axes.map((v) => Math.max(-1, Math.min(1, v)) + 0), buttons: names.map((name) => Number(held.has(name))) };
}

/** What hands do, from {axes, buttons} of /joy; the opposite of positions(). */
export function handsOf(mode, names, axes, buttons) {
  const held = names.filter((_, i) => buttons[i]);
  const pressed = (name) => Number(held.includes(name));
  const [lx, ly, a = 0, b = 0, c = 0, d = 0, e = 0, f = 0] = axes;
  return mode === "X"
    ? { left: [lx, ly], right: [b, c], dpad: [e, f], triggers: [(1 - a) / 2, (1 - d) / 2], held }
    : { left: [lx, ly], right: [a, b], dpad: [c, d], triggers: [pressed("LT"), pressed("RT")], held };
}

export function isAtRest(hands) {
  const all = [...hands.left, ...hands.right, ...hands.dpad, ...hands.triggers];
  return hands.held.length === 0 && all.every((v) => Math.abs(v) < 1e-6);
}

/** What hands do on a Gamepad of the browser. names: {D, X: names of the buttons of that mode}. */
export function handsOfGamepad(gamepad, names) {
  const values = gamepad.buttons.map((button) => button.value);
  const pressed = gamepad.buttons.map((button) => button.pressed);
  const ros = gamepad.axes.map((v) => -v); // there right and down are positive
  let hands;
  if (gamepad.mapping === "standard") {
    const value = (name) => values[STANDARD.indexOf(name)] ?? 0;
    hands = {
      left: ros.slice(0, 2),
      right: ros.slice(2, 4),
      dpad: [value("left") - value("right"), value("up") - value("down")],
      triggers: [value("LT"), value("RT")],
      held: STANDARD.filter((name, i) => pressed[i] && name === name.toUpperCase()),
    };
    hands.held = hands.held.filter((name) => name !== "LT" && name !== "RT"); // they are above
  } else {
    // As the kernel numbers them: 8 axes are an F710 at X, 6 one at D.
    const mode = ros.length >= 8 ? "X" : "D";
    hands = handsOf(mode, names[mode], [...ros, 0, 0, 0, 0, 0, 0], pressed);
  }
  return {
    left: hands.left.map(outOfDeadzone),
    right: hands.right.map(outOfDeadzone),
    dpad: hands.dpad.map((v) => (v > DIGITAL) - (v < -DIGITAL)),
    triggers: hands.triggers.map((v) => (v < DEADZONE ? 0 : Math.min(1, v))),
    held: hands.held,
  };
}

function outOfDeadzone(v) {
  const size = Math.min(1, Math.abs(v));
  return size < DEADZONE ? 0 : (Math.sign(v) * (size - DEADZONE)) / (1 - DEADZONE);
}
