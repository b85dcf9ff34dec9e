// Where the names of robots are on the floor.
// claim: Names of thirty robots cover nothing
import assert from "node:assert/strict";
import { test } from "node:test";

import { drawNames, overlap, placeNames } from "../../../common/cockpit/page/names.js";

test("the names of a class of thirty at one place cover neither a robot nor each other", () => {
  const robots = Array.from({ length: 30 }, () => ({ name: "x", x: 400, y: 300, radius: 9, width: 60 }));
  const boxes = placeNames(robots, { left: 0, top: 0, right: 800, bottom: 600 })
    .map(({ x, y }) => ({ left: x - 30, right: x + 30, top: y - 8, bottom: y + 8 }));
  boxes.push({ left: 391, right: 409, top: 291, bottom: 309 });
  assert.equal(boxes.length, 31);
  boxes.forEach((a, i) => boxes.slice(0, i).forEach((b) => assert.ok(!overlap(a, b))));
});

test("on a phone no line leads to a name but the chosen robot's, and names without a place are left out", () => {
  const drawn = (width) => {
    const done = { lineTo: 0, fillText: 0 };
    const count = (name) => () => (name in done ? done[name]++ : undefined);
    const canvas = { clientWidth: width, clientHeight: 600 };
    const pen = new Proxy({ canvas, measureText: () => ({ width: 60 }) }, { get: (known, name) => known[name] ?? count(name) });
    const robots = Array.from({ length: 30 }, (_, i) => ({ name: "x", x: 160, y: 300, radius: 9, isChosen: i === 0 }));
    drawNames({ pen, colour: () => "" }, robots, { left: 0, top: 0, right: width, bottom: 600 });
    return done;
  };
  assert.equal(drawn(800).fillText, 30);
  assert.ok(drawn(800).lineTo > 10);
  assert.equal(drawn(320).lineTo, 0);
  assert.ok(drawn(320).fillText < 12);
});
