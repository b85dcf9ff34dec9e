/**
 * The Logitech F710 as /joy shows it, and what hands do on it.
 *
 * Hands are {left, right, dpad: [x, y] from -1 to 1, left and up positive as on /joy; triggers:
 * [LT, RT] from 0 (released) to 1; held: names of buttons}. gamepads.py and controls.py of the
 * package gamepad have the same in Python.
 */

export const REST = Object.freeze({
  left: [0, 0], right: [0, 0], dpad: [0, 0], triggers: [0, 0], held: [],
});
const DIGITAL = 0.5; // A trigger or the D-pad deflected this far is pressed.
const DEADZONE = 0.05; // of a stick, as in joy_node

// The Gamepad API's "standard" layout, https://w3c.github.io/gamepad/#remapping
const STANDARD = [
  "A", "B", "X", "Y", "LB", "RB", "LT", "RT", "BACK", "START", "LEFT", "RIGHT",
  "up", "down", "left", "right", "LOGITECH",
];

const digital = (v) => Number(v > DIGITAL) - Number(v < -DIGITAL);

/** The names of all buttons that are held, with the triggers that are pressed. */
export function heldBy({ held, triggers }) {
  return new Set([...held, ...["LT", "RT"].filter((_, i) => triggers[i] > DIGITAL)]);
}

/** {axes, buttons} as on /joy. mode: "D" or "X"; names: of that mode's buttons, in their order. */
export function positions(mode, names, hands) {
  const { left, right, triggers } = hands;
  const dpad = hands.dpad.map(digital);
  const [lt, rt] = triggers.map((v) => 1 - 2 * v);
  const axes = mode === "X" ? [...left, lt, ...right, rt, ...dpad] : [...left, ...right, ...dpad];
  const held = heldBy(hands);
  return {
    axes: axes.map((v) => Math.max(-1, Math.min(1, v)) + 0), // + 0: no -0
    buttons: names.map((name) => Number(held.has(name))),
  };
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

export function isAtRest({ left, right, dpad, triggers, held }) {
  return !held.length && [left, right, dpad, triggers].flat().every((v) => Math.abs(v) < 1e-6);
}

/** What hands do on a Gamepad of the browser. names: {D, X: names of the buttons of that mode}. */
export function handsOfGamepad({ mapping, axes, buttons }, names) {
  const pressed = buttons.map((button) => button.pressed);
  const ros = axes.map((v) => -v); // The browser's right and down are positive.
  // Without the standard mapping the kernel's order applies: an F710 has 8 axes at X, 6 at D.
  const mode = ros.length >= 8 ? "X" : "D";
  const hands = mapping === "standard"
    ? handsOfStandard(ros, buttons, pressed)
    : handsOf(mode, names[mode], [...ros, 0, 0, 0, 0, 0, 0], pressed);
  return {
    left: hands.left.map(outOfDeadzone),
    right: hands.right.map(outOfDeadzone),
    dpad: hands.dpad.map(digital),
    triggers: hands.triggers.map((v) => (v < DEADZONE ? 0 : Math.min(1, v))),
    held: hands.held,
  };
}

function handsOfStandard(ros, buttons, pressed) {
  const value = (name) => buttons[STANDARD.indexOf(name)]?.value ?? 0;
  const isButton = (name) => name === name.toUpperCase() && name !== "LT" && name !== "RT";
  return {
    left: ros.slice(0, 2),
    right: ros.slice(2, 4),
    dpad: [value("left") - value("right"), value("up") - value("down")],
    triggers: [value("LT"), value("RT")],
    held: STANDARD.filter((name, i) => pressed[i] && isButton(name)),
  };
}

function outOfDeadzone(v) {
  const size = Math.min(1, Math.abs(v));
  return size < DEADZONE ? 0 : (Math.sign(v) * (size - DEADZONE)) / (1 - DEADZONE);
}
