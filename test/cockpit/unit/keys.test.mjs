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
for (const [name, [kind, event]] of Object.entries(CASES)) {
  test(name, () => {
    const handlers = [];
    globalThis.addEventListener = (of, handler) => handlers.push([of, handler]);
    const keys = new Keys(() => true, () => {});
    const hear = (of, fields) => handlers.filter(([one]) => one === of)
      .forEach(([, handler]) => handler({ target: {}, preventDefault() {}, stopPropagation() {}, ...fields }));
    for (const code of ["ShiftLeft", "ShiftRight", "ArrowUp"]) hear("keydown", { code, shiftKey: true });
    assert.deepEqual([keys.hands.held, keys.hands.left], [["LB"], [0, 1]]);
    hear(kind, event);
    assert.deepEqual(keys.hands.held, []);
  });
}
