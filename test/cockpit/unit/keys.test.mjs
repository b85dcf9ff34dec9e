// Keys whose release no keyup reports: each event has the state of Shift and of Cmd.
// claim: Keys, thumbs and a gamepad drive, and release stops; so does one that no keyup reports
import assert from "node:assert/strict";
import { test } from "node:test";

import { Keys } from "../../../common/cockpit/page/keys.js";

const CASES = {
  "Shift, before the mouse moves": ["pointermove", { shiftKey: false }],
  "one Shift of two, as Windows reports it": ["keyup", { code: "ShiftLeft" }],
  "all beside Cmd, as macOS reports it": ["keydown", { code: "MetaLeft", metaKey: true }],
};

/** [keys, hear]: keys, and what gives them an event. */
function keysOf(isOurs) {
  const handlers = [];
  globalThis.addEventListener = (of, handler) => handlers.push([of, handler]);
  const keys = new Keys(() => isOurs, () => {});
  const hear = (of, fields) => handlers.filter(([kind]) => kind === of)
    .forEach(([, handler]) => handler({ target: {}, preventDefault() {}, stopPropagation() {}, ...fields }));
  return [keys, hear];
}

for (const [name, [kind, event]] of Object.entries(CASES)) {
  test(name, () => {
    const [keys, hear] = keysOf(true);
    for (const code of ["ShiftLeft", "ShiftRight", "ArrowUp"]) hear("keydown", { code, shiftKey: true });
    assert.deepEqual([keys.hands.held, keys.hands.left], [["LB"], [0, 1]]);
    hear(kind, event);
    assert.deepEqual(keys.hands.held, []);
  });
}

test("1, 2 and 3 push the held stick a fourth, half and whole, while keys drive", () => {
  const [keys, hear] = keysOf(true);
  for (const code of ["ShiftLeft", "ArrowDown", "ArrowLeft"]) hear("keydown", { code, shiftKey: true });
  const pushes = ["Digit1", "Digit2", "Digit3"].map((code) => {
    hear("keydown", { code, shiftKey: true });
    return keys.hands.left;
  });
  assert.deepEqual(pushes, [[0.25, -0.25], [0.5, -0.5], [1, -1]]);
  assert.deepEqual(keys.hands.held, ["LB"]);
  hear("keydown", { code: "Digit1", altKey: true, shiftKey: true }); // a command of the browser
  assert.deepEqual(keys.hands.left, [1, -1]);
  const [others, type] = keysOf(false);
  type("keydown", { code: "Digit1" });
  assert.equal(others.reach, "Digit3");
});
