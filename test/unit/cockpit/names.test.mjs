// Where the names of robots are on the floor.
import assert from "node:assert/strict";
import { test } from "node:test";

import { overlap, placeNames } from "../../../common/cockpit/page/names.js";

test("the names of a class of thirty at one place cover neither a robot nor each other", () => {
  const robots = Array.from({ length: 30 }, () => ({ name: "x", x: 400, y: 300, radius: 9, width: 60 }));
  const boxes = placeNames(robots, { left: 0, top: 0, right: 800, bottom: 600 })
    .map(({ x, y }) => ({ left: x - 30, right: x + 30, top: y - 8, bottom: y + 8 }));
  boxes.push({ left: 391, right: 409, top: 291, bottom: 309 });
  assert.equal(boxes.length, 31);
  boxes.forEach((a, i) => boxes.slice(0, i).forEach((b) => assert.ok(!overlap(a, b))));
});
